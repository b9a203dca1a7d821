// Numbers in messages. The judge shares no code with the stages that make meshes, not even this.
#pragma once

#include <cstdio>
#include <string>

namespace gaussmesh::verify {

/// A number as a person would write it, with up to six significant digits.
inline std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace gaussmesh::verify

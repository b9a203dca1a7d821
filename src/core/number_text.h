// Numbers in messages.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace gaussmesh {

/// A number as a person would write it, with up to `digits` significant digits.
inline std::string number_text(double value, int digits = 6) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// `1 atom`, `2 atoms`: a number and what it counts.
inline std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace gaussmesh

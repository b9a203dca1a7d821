// How messages name places.
#pragma once

#include <cmath>
#include <string>

#include "core/lattice.h"
#include "core/number_text.h"

namespace gaussmesh {

/// `(x, y, z)` in A, to six decimals.
inline std::string place_text(const Vec3& place) {
  std::string text;
  for (const double x : place) {
    text += text.empty() ? "(" : ", ";
    text += number_text(std::round(x * 1e6) / 1e6 + 0.0, 13);  // + 0.0: no "-0"
  }
  text += ")";
  return text;
}

}  // namespace gaussmesh

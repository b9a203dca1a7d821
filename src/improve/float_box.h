// Boxes of single precision, of places or of directions.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

namespace gaussmesh {

struct FloatBox {
  std::array<float, 3> lo{kFar, kFar, kFar}, hi{-kFar, -kFar, -kFar};  ///< at first it holds nothing

  void add(const FloatBox& other) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], other.lo[k]);
      hi[k] = std::max(hi[k], other.hi[k]);
    }
  }

  bool meets(const FloatBox& other) const {
    return lo[0] <= other.hi[0] && other.lo[0] <= hi[0] && lo[1] <= other.hi[1] && other.lo[1] <= hi[1] &&
           lo[2] <= other.hi[2] && other.lo[2] <= hi[2];
  }

 private:
  static constexpr float kFar = std::numeric_limits<float>::max();
};

}  // namespace gaussmesh

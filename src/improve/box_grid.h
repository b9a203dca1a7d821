// Boxes by the cubes of a grid.
#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/hash.h"
#include "core/vectors.h"

namespace gaussmesh {

inline bool boxes_meet(const Box& a, const Box& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.hi[k] < b.lo[k] || b.hi[k] < a.lo[k]) return false;
  }
  return true;
}

/// Numbers of boxes, to be found by where they are.
class BoxGrid {
 public:
  using Cube = std::array<std::int64_t, 3>;

  /// @param edge   A, of the cubes: not much less than that of the boxes
  /// @param shift  a corner of cubes
  explicit BoxGrid(double edge, const Vec3& shift = {}) : edge_(edge), per_edge_(1.0 / edge), shift_(shift) {}

  /// The cube that holds a point: low faces belong to it, high ones do not.
  Cube cube_of(const Vec3& p) const {
    Cube cube;
    for (int k = 0; k < 3; ++k) {
      std::int64_t& i = cube[k] = static_cast<std::int64_t>((p[k] - shift_[k]) * per_edge_);  // or one beside
      while (p[k] < plane(k, i)) --i;
      while (p[k] >= plane(k, i + 1)) ++i;
    }
    return cube;
  }
  Box box_of(const Cube& cube) const {
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = plane(k, cube[k]);
      box.hi[k] = plane(k, cube[k] + 1);
    }
    return box;
  }

  /// The numbers kept in a cube.
  std::vector<std::uint32_t>& numbers_in(const Cube& cube) { return numbers_[cube]; }

  /// Keeps the number of a box in all cubes that it reaches into.
  void add(const Box& box, std::uint32_t number) {
    visit_cubes(box, [&](const Cube& cube) { numbers_[cube].push_back(number); });
  }

  /// Asks a grid that does not change as long as this lives. Fast where small boxes follow each other in one cube.
  class Reader {
   public:
    explicit Reader(const BoxGrid& grid) : grid_(grid) {}

    /// Calls visit(number) for those in cubes that a box reaches into: one that is in several, more than once.
    template <typename Visit>
    void visit(const Box& box, const Visit& visit) {
      grid_.visit_cubes(box, [&](const Cube& cube) {
        if (!last_ || cube != last_cube_) {
          const auto it = grid_.numbers_.find(cube);
          last_ = it != grid_.numbers_.end() ? it->second : std::span<const std::uint32_t>();
          last_cube_ = cube;
        }
        for (const std::uint32_t number : *last_) visit(number);
      });
    }

   private:
    const BoxGrid& grid_;
    Cube last_cube_{};
    std::optional<std::span<const std::uint32_t>> last_;  ///< what is in it; none: not looked up
  };

 private:
  double plane(int axis, std::int64_t i) const { return shift_[axis] + static_cast<double>(i) * edge_; }

  template <typename Visit>
  void visit_cubes(const Box& box, const Visit& visit) const {
    const Cube lo = cube_of(box.lo), hi = cube_of(box.hi);
    for (Cube c = lo; c[0] <= hi[0]; ++c[0]) {
      for (c[1] = lo[1]; c[1] <= hi[1]; ++c[1]) {
        for (c[2] = lo[2]; c[2] <= hi[2]; ++c[2]) visit(c);
      }
    }
  }

  double edge_, per_edge_;
  Vec3 shift_;
  std::unordered_map<Cube, std::vector<std::uint32_t>, IndexHash> numbers_;
};

}  // namespace gaussmesh

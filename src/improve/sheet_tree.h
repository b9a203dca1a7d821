// Triangles that come and move, by where they are and where they face.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "improve/float_box.h"

namespace gaussmesh {

/// Triangles are of one sheet of the surface where their mean normals have a larger scalar product: the cosine, times
/// the lengths, which are less than 1 where the normals of the corners differ.
inline constexpr float kSameSheet = 0.4f;

inline bool are_of_one_sheet(const Normal& m, const Normal& n) {
  return m[0] * n[0] + m[1] * n[1] + m[2] * n[2] > kSameSheet;
}

/// An octree of triangles. Each is in the cell that its middle is in and that is about as wide as it, so that triangles
/// of very different sizes can be at one place. A cell knows what places and normals there are in each of its eighths.
class SheetTree {
 public:
  struct Item {
    FloatBox box;     ///< holds the triangle; A, from a corner of the cube
    Normal normal{};  ///< mean of the field's at the corners, not of unit length
  };

  /// @param width  of the cube that the triangles are in (A, > 0); one beyond it is found too, but more slowly
  explicit SheetTree(float width) : width_(width) { cells_.emplace_back(); }

  /// @return the number of the new item: 0, 1, ...
  std::uint32_t add(const Item& item);

  void change(std::uint32_t number, const Item& item);

  /// Calls visit(number) for each item that meets the box of the query and is of another sheet, until it says true.
  /// A query with a normal of zero is of no sheet.
  /// @return whether it did
  template <typename Visit>
  bool visit(const Item& query, const Visit& visit) const {
    std::array<std::int32_t, kMostOpen> open;  // cells yet to be looked at
    int count = 1;
    open[0] = 0;
    while (count > 0) {
      const Cell& cell = cells_[static_cast<std::size_t>(open[--count])];
      for (std::int32_t n = cell.first; n >= 0; n = entries_[static_cast<std::size_t>(n)].next) {
        const Item& item = entries_[static_cast<std::size_t>(n)].item;
        if (query.box.meets(item.box) && !are_of_one_sheet(query.normal, item.normal) &&
            visit(static_cast<std::uint32_t>(n))) {
          return true;
        }
      }
      std::array<std::int32_t, 8> may_meet;
      cell.find_eighths(query, may_meet);
      for (std::size_t e = 0; e < 8; ++e) {
        if (may_meet[e]) open[static_cast<std::size_t>(count++)] = cell.eighth[e];
      }
    }
    return false;
  }

 private:
  static constexpr int kMostLevels = 20;
  static constexpr std::size_t kMostOpen = 7 * kMostLevels + 8;

  struct Cell {
    std::array<std::array<float, 8>, 3> lo, hi;                ///< by axis and eighth: where its triangles are
    std::array<std::array<float, 8>, 3> normal_lo, normal_hi;  ///< and between what their normals are
    std::array<std::int32_t, 8> eighth;                        ///< cells; negative: none yet
    std::int32_t first = -1;                                   ///< of its own entries; negative: none

    Cell();
    void add(std::size_t e, const Item& item);

    /// By eighth: 1 where an item of it may be what the query asks for, else 0.
    void find_eighths(const Item& query, std::array<std::int32_t, 8>& may_meet) const {
      const FloatBox& box = query.box;
      const Normal& n = query.normal;
      for (std::size_t e = 0; e < 8; ++e) {
        float least = 0.0f;  // scalar product of the normals
        std::int32_t meets = 1;
        for (int k = 0; k < 3; ++k) {
          meets &= std::int32_t{box.lo[k] <= hi[k][e]} & std::int32_t{lo[k][e] <= box.hi[k]};
          least += std::min(n[k] * normal_lo[k][e], n[k] * normal_hi[k][e]);
        }
        may_meet[e] = meets & std::int32_t{least <= kSameSheet};
      }
    }
  };

  struct Entry {
    Item item;
    std::int32_t cell = -1, previous = -1, next = -1;  ///< entries of the same cell; negative: none
  };

  /// The cell for an item, made if there is none, after letting those above it know of the item.
  std::int32_t find_cell(const Item& item);
  void link(std::int32_t number, std::int32_t cell);
  void unlink(std::int32_t number);

  float width_;
  std::vector<Cell> cells_;  ///< the first is the cube
  std::vector<Entry> entries_;
};

}  // namespace gaussmesh

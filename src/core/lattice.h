// Where things are: fixed-point coordinates, boxes, and the lattice that cells, faces and edges live on.
//
// Every vertex coordinate is a whole number of units of 1e-9 A, and so is every lattice plane. A vertex on a plane
// is on it exactly, in memory and in the nine decimals that are written: the nearest double of n / 10^9 is both
// what to_angstrom() gives and what a reader makes of the decimals.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/hash.h"

namespace gaussmesh {

using Coord = std::int64_t;  ///< a coordinate in units of 1e-9 A
using CoordPoint = std::array<Coord, 3>;
using Vec3 = std::array<double, 3>;

inline constexpr double kUnitsPerAngstrom = 1e9;

/// The correctly rounded double of a coordinate (A). Exact to within half an ulp below 9e6 A.
inline double to_angstrom(Coord c) { return static_cast<double>(c) / kUnitsPerAngstrom; }
inline Vec3 to_angstrom(const CoordPoint& p) { return {to_angstrom(p[0]), to_angstrom(p[1]), to_angstrom(p[2])}; }

/// A closed axis-parallel box; an edge or a face is a box that is flat along one or two axes.
struct Box {
  Vec3 lo{};
  Vec3 hi{};
};

/// The axes of a plane across `axis`: (first, second, axis) is right-handed.
inline constexpr int first_axis(int axis) { return (axis + 1) % 3; }
inline constexpr int second_axis(int axis) { return (axis + 2) % 3; }

/// Number of the slab, of `count` of width 1 from 0 on, that holds `x`; the first or the last one for what lies beyond.
template <typename Real>
int slab_of(Real x, int count) {
  return x <= Real{0} ? 0 : x >= static_cast<Real>(count - 1) ? count - 1 : static_cast<int>(x);
}

/// How often a cell of the asked-for spacing may be halved.
inline constexpr int kMaxLevel = 16;
inline constexpr std::int64_t kFinePerCell = std::int64_t{1} << kMaxLevel;

/// Cells of level 0 near the surface are numbered from -kMostCellNumber to kMostCellNumber along each axis: that leaves
/// room in 32 bits.
inline constexpr double kMostCellNumber = 2.0e9;

/// Position on the finest lattice: cells of level 0 begin at multiples of kFinePerCell.
using FineIndex = std::array<std::int64_t, 3>;

/// The planes that everything is cut along: plane n of an axis is at offset + n * step.
struct Lattice {
  Coord step = 0;       ///< distance of the finest planes
  CoordPoint offset{};  ///< generic, so that symmetric molecules give no exact zeros

  Coord plane(int axis, std::int64_t n) const { return offset[axis] + n * step; }
  CoordPoint point(const FineIndex& n) const { return {plane(0, n[0]), plane(1, n[1]), plane(2, n[2])}; }
  double cell_size() const { return to_angstrom(step * kFinePerCell); }
};

/// Fine planes across a cell of the given level.
inline constexpr std::int64_t fine_size(int level) { return kFinePerCell >> level; }

/// The largest multiple of `size`, a power of two, that is not above n.
inline constexpr std::int64_t round_down(std::int64_t n, std::int64_t size) { return n & -size; }

/// The box from lattice point `lo` to lattice point `hi`.
inline Box lattice_box(const Lattice& lattice, const FineIndex& lo, const FineIndex& hi) {
  return {to_angstrom(lattice.point(lo)), to_angstrom(lattice.point(hi))};
}

inline FineIndex moved(FineIndex n, int axis, std::int64_t by) {
  n[axis] += by;
  return n;
}

/// One cell: a cube of the lattice at one level of subdivision.
struct CellKey {
  FineIndex lo{};
  int level = 0;
  bool operator==(const CellKey& other) const {  // without a call of memcmp(), which costs more than the rest
    return lo[0] == other.lo[0] && lo[1] == other.lo[1] && lo[2] == other.lo[2] && level == other.level;
  }
};

inline FineIndex cell_hi(const CellKey& cell) {
  const std::int64_t size = fine_size(cell.level);
  return {cell.lo[0] + size, cell.lo[1] + size, cell.lo[2] + size};
}

/// A hash for what begins at corners of the lattice of some level, such as its cells: those in one cell of the level
/// above are at neighbouring slots of a table, as they are asked for one after the other, and tables may be larger than
/// caches.
/// @tparam kinds  how many things begin at one corner
template <unsigned kinds>
std::size_t lattice_hash(const FineIndex& lo, int level, unsigned kind) {
  const int shift = kMaxLevel - level;
  std::uint64_t around = static_cast<std::uint64_t>(level);
  std::size_t part = 0;
  for (const std::int64_t v : lo) {
    around = add_to_hash(around, v >> (shift + 1));
    part = 2 * part + static_cast<std::size_t>(v >> shift & 1);
  }
  return 8 * kinds * spread_hash(around) + kinds * part + kind;
}

struct CellKeyHash {
  std::size_t operator()(const CellKey& key) const { return lattice_hash<1>(key.lo, key.level, 0); }
};

inline Box cell_box(const Lattice& lattice, const CellKey& cell) {
  return lattice_box(lattice, cell.lo, cell_hi(cell));
}

/// One of the eight halves along all axes of a cell: bit k of `child` chooses the upper half along axis k.
inline CellKey child_cell(const CellKey& cell, int child) {
  CellKey result{cell.lo, cell.level + 1};
  for (int a = 0; a < 3; ++a) result.lo[a] += (child >> a & 1) * fine_size(result.level);
  return result;
}

}  // namespace gaussmesh

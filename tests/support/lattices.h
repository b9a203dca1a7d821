// A lattice to place edges and faces on, and coordinates near given places.
#pragma once

#include <cmath>

#include "core/lattice.h"

namespace gaussmesh::testing {

inline Coord to_coord(double x) { return std::llround(x * kUnitsPerAngstrom); }
inline CoordPoint to_coord(const Vec3& p) { return {to_coord(p[0]), to_coord(p[1]), to_coord(p[2])}; }

/// Cells of about `spacing`, offset as the pipeline does it: by no simple fraction.
inline Lattice lattice_of(double spacing) {
  Lattice lattice;
  lattice.step = std::max<Coord>(2, std::llround(spacing * kUnitsPerAngstrom / static_cast<double>(kFinePerCell)));
  const double cell = static_cast<double>(lattice.step * kFinePerCell);
  lattice.offset = {std::llround(0.37193 * cell), std::llround(0.41421 * cell), std::llround(0.23607 * cell)};
  return lattice;
}

/// The cell of a level that a point is in.
inline CellKey cell_at(const Lattice& lattice, const Vec3& p, int level = 0) {
  CellKey key{{}, level};
  const std::int64_t size = fine_size(level);
  for (int k = 0; k < 3; ++k) {
    const double n = std::floor((p[k] - to_angstrom(lattice.offset[k])) / to_angstrom(lattice.step * size));
    key.lo[k] = static_cast<std::int64_t>(n) * size;
  }
  return key;
}

}  // namespace gaussmesh::testing

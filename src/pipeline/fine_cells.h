// The cells that are split because the trace is to be finer at given places.
#pragma once

#include <span>

#include "core/key_index.h"
#include "core/lattice.h"

namespace gaussmesh {

/// A place where the cells of the trace are to be smaller than the spacing.
struct FinePlace {
  Vec3 at{};      ///< A
  int level = 0;  ///< how often cells are to be halved there
};

/// Looks up which cells those are. Cost: some tens of entries of a table for each place.
class FineCells {
 public:
  FineCells(const Lattice& lattice, std::span<const FinePlace> places);

  /// Whether the cell is larger than the cells that there are to be at some place, and nearer to it than one of those
  /// is wide.
  bool must_be_split(const CellKey& cell) const { return cells_.contains(cell); }

 private:
  void add(const FineIndex& around, int level);

  KeyIndex<CellKey, CellKeyHash> cells_;
};

}  // namespace gaussmesh

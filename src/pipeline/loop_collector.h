// The loops round ONE cell, whatever the sizes of its neighbours.
#pragma once

#include <span>
#include <vector>

#include "patch/patch_triangulator.h"
#include "pipeline/split_lattice.h"

namespace gaussmesh {

/// Gathers the curves on the faces of cells and closes them into loops. Keeps buffers: one for each thread.
class LoopCollector {
 public:
  LoopCollector(const Lattice& lattice, const CellStore& store, const SplitLattice& split,
                const TracedVertices& vertices)
      : lattice_(lattice), store_(store), split_(split), vertices_(vertices) {}

  /// @param hint         a brick near the cell
  /// @param empty_faces  as in LeafCell: those that need not be looked at
  /// @return the loops, counter-clockwise round the surface seen from the solvent; valid until the next call
  /// @throws LatticeDegenerate if curves do not close
  std::span<const Loop> collect(const CellKey& key, std::uint32_t hint, unsigned empty_faces = 0);

 private:
  void collect_links(int axis, const FineIndex& lo, int level, std::uint32_t hint, bool high_side);
  void collect_parts(int axis, const FineIndex& lo, int level, std::uint32_t hint, bool high_side);
  void build_loops(const CoordPoint& lo, const CoordPoint& hi);
  Loop& add_loop();

  const Lattice& lattice_;
  const CellStore& store_;
  const SplitLattice& split_;
  const TracedVertices& vertices_;
  std::vector<Link> links_;
  std::vector<bool> used_;
  std::vector<Loop> loops_;  ///< those of the last call first; others keep their buffers
  std::size_t loop_count_ = 0;
};

}  // namespace gaussmesh

// The loops round ONE cell, whatever the sizes of its neighbours.
#pragma once

#include <span>
#include <vector>

#include "patch/patch_triangulator.h"
#include "pipeline/split_lattice.h"

namespace gaussmesh {

/// The points of the vertices that links name, by number: on edges of level 0, in smaller cells, and inside faces of
/// level 0.
class VertexPoints {
 public:
  VertexPoints(const CellStore& store, const SplitLattice& split) : store_(store), split_(split) {}

  const SurfacePoint& operator[](std::uint32_t vertex) const {
    if (vertex < store_.root_vertices()) return store_.root(vertex);
    if (vertex < split_.next_vertex()) return split_.points()[vertex - store_.root_vertices()];
    return face_point(vertex);
  }

 private:
  const SurfacePoint& face_point(std::uint32_t vertex) const;

  const CellStore& store_;
  const SplitLattice& split_;
};

/// Gathers the curves on the faces of cells and closes them into loops. Keeps buffers: one for each thread.
class LoopCollector {
 public:
  LoopCollector(const Lattice& lattice, const CellStore& store, const SplitLattice& split)
      : lattice_(lattice), store_(store), split_(split), points_(store, split) {}

  /// @param hint  a brick near the cell
  /// @return      the loops, counter-clockwise round the surface seen from the solvent; valid until the next call
  /// @throws LatticeDegenerate if curves do not close
  std::span<const Loop> collect(const CellKey& key, std::uint32_t hint);

  /// The links that the loops of the last call are made of.
  std::span<const Link> links() const { return links_; }

 private:
  void collect_links(int axis, const FineIndex& lo, int level, std::uint32_t hint, bool high_side);
  void collect_parts(int axis, const FineIndex& lo, int level, std::uint32_t hint, bool high_side);
  void build_loops(const CoordPoint& lo, const CoordPoint& hi);

  const Lattice& lattice_;
  const CellStore& store_;
  const SplitLattice& split_;
  VertexPoints points_;
  std::vector<Link> links_;
  std::vector<bool> used_;
  std::vector<Loop> loops_;
};

}  // namespace gaussmesh

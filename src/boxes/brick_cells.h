// The cells of ONE brick that the surface may cross, each with its atoms and its certificate.
#pragma once

#include <functional>
#include <vector>

#include "boxes/cell_prover.h"
#include "boxes/find_bricks.h"

namespace gaussmesh {

/// Goes through the cells of level 0 of a brick. Keeps buffers: one for each thread.
class BrickWalker {
 public:
  /// What is known of a cell that is not excluded; the references live as long as the call.
  struct Cell {
    FineIndex lo;
    const NearAtoms& atoms;
    const LocalModel& model;
    CellCertificate certificate;
  };
  using Visitor = std::function<void(const Cell&)>;

  BrickWalker(const GaussianField& field, const Lattice& lattice);

  /// Calls `visit` for each cell that is not proven free of surface, in a fixed order.
  void walk(const BrickIndex& brick, const Visitor& visit);

  /// Boxes looked at so far: [0..2] cubes of 4, 2 and 1 cells, then sub-boxes of cells, halving.
  std::vector<std::size_t> boxes_by_level() const;

 private:
  void descend(const FineIndex& lo, int log_cells, const Visitor& visit);

  const GaussianField& field_;
  const Lattice& lattice_;
  CellProver prover_;
  NearAtoms stack_[4];          ///< atoms near the boxes on the way down, by size
  std::size_t boxes_[3]{};
};

/// How often a cell is halved in search of a common axis.
inline constexpr int kProofDepth = 4;

}  // namespace gaussmesh

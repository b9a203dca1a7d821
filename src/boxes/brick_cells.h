// The cells of ONE brick that the surface may cross, each with its atoms and its certificate.
#pragma once

#include <functional>
#include <vector>

#include "boxes/brick_tables.h"
#include "boxes/cell_prover.h"

namespace gaussmesh {

/// Goes through the cells of level 0 of a brick. Keeps buffers: one for each thread.
class BrickWalker {
 public:
  /// What is known of a cell that is not excluded; the references live as long as the call.
  struct Cell {
    FineIndex lo{};
    const NearAtoms& atoms;  ///< collected for a box around the cell, with kTruncation
    const LazyModel& model;  ///< of the cell, with kProofTruncation
    CellCertificate certificate;
    const BrickTables& tables;      ///< of the brick
    std::array<int, 3> in_brick{};  ///< i, j, k: where it is in the brick
  };
  using Visitor = std::function<void(const Cell&)>;

  BrickWalker(const GaussianField& field, const Lattice& lattice);

  /// Calls `visit` for each cell that is not proven free of surface, in a fixed order.
  void walk(const BrickIndex& brick, const Visitor& visit);

  /// Boxes looked at so far: cells, then sub-boxes of cells, halving.
  const std::vector<std::size_t>& boxes_by_level() const { return prover_.boxes_by_depth(); }

 private:
  /// The octant and the block are given by their first cells.
  void walk_block(const FineIndex& origin, const std::array<int, 3>& octant, const std::array<int, 3>& first,
                  const Visitor& visit);
  Box box_of(const std::array<int, 3>& first, int cells) const;

  const GaussianField& field_;
  const Lattice& lattice_;
  CellProver prover_;
  NearAtoms brick_atoms_, octant_atoms_, proof_atoms_;
  bool octant_loaded_ = false;
  BrickTables::Planes planes_{};
  BrickTables tables_;
};

/// How often a cell is halved in search of a common axis.
inline constexpr int kProofDepth = 4;

}  // namespace gaussmesh

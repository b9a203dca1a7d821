#include "boxes/brick_cells.h"

namespace gaussmesh {
namespace {

/// Cells come in blocks that share a list of atoms for proofs, and these in octants of the brick that share one for
/// roots: making lists for smaller boxes costs more than the atoms that it saves.
constexpr int kBlockCells = 2;
constexpr int kOctantCells = kBrickCells / 2;

}  // namespace

BrickWalker::BrickWalker(const GaussianField& field, const Lattice& lattice)
    : field_(field), lattice_(lattice), prover_(field.decay()) {}

void BrickWalker::walk(const BrickIndex& brick, const Visitor& visit) {
  const FineIndex origin = brick_origin(brick);
  const std::int64_t size = kBrickCells * kFinePerCell;
  const Box box = lattice_box(lattice_, origin, {origin[0] + size, origin[1] + size, origin[2] + size});
  field_.collect_near(box, brick_atoms_);
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < BrickTables::kPlanes; ++i) {
      planes_[axis][i] = to_angstrom(lattice_.plane(axis, origin[axis] + (i - 1) * kFinePerCell));
    }
  }
  proof_atoms_.restrict_from(brick_atoms_, box, field_.decay(), kProofTruncation);
  tables_.build(proof_atoms_, field_.decay(), planes_);
  for (int octant = 0; octant < 8; ++octant) {
    const std::array<int, 3> first{(octant & 1) * kOctantCells, (octant >> 1 & 1) * kOctantCells,
                                   (octant >> 2) * kOctantCells};
    octant_loaded_ = false;
    for (int block = 0; block < 8; ++block) {
      walk_block(origin, first,
                 {first[0] + (block & 1) * kBlockCells, first[1] + (block >> 1 & 1) * kBlockCells,
                  first[2] + (block >> 2) * kBlockCells},
                 visit);
    }
  }
}

Box BrickWalker::box_of(const std::array<int, 3>& first, int cells) const {
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = planes_[k][1 + first[k]];
    box.hi[k] = planes_[k][1 + first[k] + cells];
  }
  return box;
}

void BrickWalker::walk_block(const FineIndex& origin, const std::array<int, 3>& octant, const std::array<int, 3>& first,
                             const Visitor& visit) {
  bool block_loaded = false;
  for (int part = 0; part < kBlockCells * kBlockCells * kBlockCells; ++part) {
    const int i = first[0] + (part & 1), j = first[1] + (part >> 1 & 1), k = first[2] + (part >> 2);
    if (!tables_.may_cross(i, j, k)) continue;
    if (!octant_loaded_) {
      octant_atoms_.restrict_from(brick_atoms_, box_of(octant, kOctantCells), field_.decay(), kTruncation);
    }
    if (!block_loaded) {
      proof_atoms_.restrict_from(octant_atoms_, box_of(first, kBlockCells), field_.decay(), kProofTruncation);
    }
    octant_loaded_ = block_loaded = true;
    const LazyModel model(proof_atoms_, field_.decay(), box_of({i, j, k}, 1));
    const KnownOfCell known{tables_.is_crossed(i, j, k), tables_.directions(i, j, k, 7),
                            tables_.steepest_axis(i, j, k)};
    const CellCertificate certificate = prover_.certify(proof_atoms_, model, kProofDepth, known);
    if (certificate.kind == CellCertificate::Kind::kExcluded) continue;
    visit({{origin[0] + i * kFinePerCell, origin[1] + j * kFinePerCell, origin[2] + k * kFinePerCell},
           octant_atoms_,
           model,
           certificate,
           tables_,
           {i, j, k}});
  }
}

}  // namespace gaussmesh

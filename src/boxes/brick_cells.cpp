#include "boxes/brick_cells.h"

namespace gaussmesh {
namespace {

/// Cells come in blocks that share a list of atoms: making one for each cell costs more than the atoms that it saves.
constexpr int kBlockCells = 2;
constexpr int kBlocks = kBrickCells / kBlockCells;

}  // namespace

BrickWalker::BrickWalker(const GaussianField& field, const Lattice& lattice)
    : field_(field), lattice_(lattice), prover_(field.decay(), kProofDepth) {}

void BrickWalker::walk(const BrickIndex& brick, const Visitor& visit) {
  const FineIndex origin = brick_origin(brick);
  const std::int64_t size = kBrickCells * kFinePerCell;
  field_.collect_near(lattice_box(lattice_, origin, {origin[0] + size, origin[1] + size, origin[2] + size}),
                      brick_atoms_);
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i <= kBrickCells; ++i) {
      planes_[axis][i] = to_angstrom(lattice_.plane(axis, origin[axis] + i * kFinePerCell));
    }
  }
  tables_.build(brick_atoms_, field_.decay(), planes_);
  for (int block = 0; block < kBlocks * kBlocks * kBlocks; ++block) {
    walk_block(origin, {block % kBlocks * kBlockCells, block / kBlocks % kBlocks * kBlockCells,
                        block / (kBlocks * kBlocks) * kBlockCells}, visit);
  }
}

void BrickWalker::walk_block(const FineIndex& origin, const std::array<int, 3>& first, const Visitor& visit) {
  bool atoms_loaded = false;
  for (int part = 0; part < kBlockCells * kBlockCells * kBlockCells; ++part) {
    const int i = first[0] + (part & 1), j = first[1] + (part >> 1 & 1), k = first[2] + (part >> 2);
    if (!tables_.may_cross(i, j, k)) continue;
    if (!atoms_loaded) {
      const Box block{{planes_[0][first[0]], planes_[1][first[1]], planes_[2][first[2]]},
                      {planes_[0][first[0] + kBlockCells], planes_[1][first[1] + kBlockCells],
                       planes_[2][first[2] + kBlockCells]}};
      block_atoms_.restrict_from(brick_atoms_, block, field_.decay(), kTruncation);
      proof_atoms_.restrict_from(block_atoms_, block, field_.decay(), kProofTruncation);
      atoms_loaded = true;
    }
    const Box box{{planes_[0][i], planes_[1][j], planes_[2][k]}, {planes_[0][i + 1], planes_[1][j + 1], planes_[2][k + 1]}};
    const LocalModel model(proof_atoms_, field_.decay(), box);
    const CellCertificate certificate = prover_.certify(proof_atoms_, model);
    if (certificate.kind == CellCertificate::Kind::kExcluded) continue;
    visit({{origin[0] + i * kFinePerCell, origin[1] + j * kFinePerCell, origin[2] + k * kFinePerCell},
           i + kBrickCells * (j + kBrickCells * k),
           block_atoms_,
           model,
           certificate,
           tables_.corner(i, j, k),
           {tables_.corner(i + 1, j, k), tables_.corner(i, j + 1, k), tables_.corner(i, j, k + 1)}});
  }
}

}  // namespace gaussmesh

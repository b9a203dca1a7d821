#include "boxes/brick_cells.h"

namespace gaussmesh {
namespace {

constexpr int kLogBrickCells = 3;
static_assert(1 << kLogBrickCells == kBrickCells);

/// Up to this size of box times d the moments of the atoms say more than their distances (1/A): there the exponents
/// 2 d u.t of atoms about 1.5 A apart stay near one. A matter of cost only.
constexpr double kModelReach = 0.9;

}  // namespace

BrickWalker::BrickWalker(const GaussianField& field, const Lattice& lattice)
    : field_(field), lattice_(lattice), prover_(field.decay(), kProofDepth) {}

void BrickWalker::walk(const BrickIndex& brick, const Visitor& visit) {
  const FineIndex lo = brick_origin(brick);
  const std::int64_t size = kBrickCells * kFinePerCell;
  field_.collect_near(lattice_box(lattice_, lo, {lo[0] + size, lo[1] + size, lo[2] + size}), stack_[kLogBrickCells]);
  for (int child = 0; child < 8; ++child) {
    const std::int64_t half = size / 2;
    descend({lo[0] + (child & 1) * half, lo[1] + (child >> 1 & 1) * half, lo[2] + (child >> 2 & 1) * half},
            kLogBrickCells - 1, visit);
  }
}

void BrickWalker::descend(const FineIndex& lo, int log_cells, const Visitor& visit) {
  const std::int64_t size = kFinePerCell << log_cells;
  const Box box = lattice_box(lattice_, lo, {lo[0] + size, lo[1] + size, lo[2] + size});
  NearAtoms& atoms = stack_[log_cells];
  atoms.restrict_from(stack_[log_cells + 1], box, field_.decay(), kTruncation);
  ++boxes_[2 - log_cells];
  const bool model_pays = field_.decay() * (box.hi[0] - box.lo[0]) < kModelReach;
  if (!model_pays) {
    const CrudeBounds crude = crude_bounds(atoms, box, field_.decay());
    if (crude.inside || crude.upper < 1.0) return;
  }
  if (log_cells == 0) {
    const LocalModel model(atoms, field_.decay(), box);
    const CellCertificate certificate = prover_.certify(atoms, model);
    if (certificate.kind != CellCertificate::Kind::kExcluded) visit({lo, atoms, model, certificate});
    return;
  }
  if (model_pays) {
    const Range value = LocalModel(atoms, field_.decay(), box).over_all().value();
    if (value.hi < 0.0 || value.lo > 0.0) return;
  }
  const std::int64_t half = size / 2;
  for (int child = 0; child < 8; ++child) {
    descend({lo[0] + (child & 1) * half, lo[1] + (child >> 1 & 1) * half, lo[2] + (child >> 2 & 1) * half},
            log_cells - 1, visit);
  }
}

std::vector<std::size_t> BrickWalker::boxes_by_level() const {
  std::vector<std::size_t> result(boxes_, boxes_ + 3);
  const std::vector<std::size_t>& parts = prover_.boxes_by_depth();
  result.insert(result.end(), parts.begin() + 1, parts.end());  // entry 0 counts the cells again
  return result;
}

}  // namespace gaussmesh

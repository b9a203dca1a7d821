#include "pipeline/split_lattice.h"

#include <algorithm>

#include "core/parallel.h"
#include "core/sort_and_unite.h"
#include "field/local_atoms.h"
#include "gaussmesh/error.h"

namespace gaussmesh {
namespace {

/// How far the proof for a part of a cell looks: down to what the proof of the whole cell looked at, and once at
/// least. It gives up the sooner the smaller the parts are, since each is split in its turn.
int proof_depth(int level) { return std::max(1, kProofDepth - level); }

/// The cell of a lower level that contains a cell.
CellKey cell_around(const CellKey& cell, int level) {
  CellKey result{{}, level};
  for (int k = 0; k < 3; ++k) result.lo[k] = round_down(cell.lo[k], fine_size(level));
  return result;
}

/// Axes along which the components of a cell are cut.
unsigned fold_axes_of(const FoldCell& cell) {
  unsigned axes = 0;
  for (const FoldComponent& c : cell.components) axes |= c.fold_axis ? 1u << *c.fold_axis : 0u;
  return axes;
}

}  // namespace

void mark_folds(const FoldCellMap& folds, CellStore& store) {
  for (const auto& [key, cell] : folds) {
    if (key.level > 0) continue;
    const unsigned axes = fold_axes_of(cell);
    const auto add_axes = [&](CellFace& face) { face.fold_axes = (face.fold_axes | axes) & 7u; };
    const auto place = store.find(key.lo);
    for (int axis = 0; axis < 3; ++axis) {
      add_axes(store.cell(*place).face[axis]);
      const auto next = store.find(moved(key.lo, axis, kFinePerCell), place->brick);
      if (next) add_axes(store.cell(*next).face[axis]);
    }
  }
}

SplitLattice::SplitLattice(const GaussianField& field, const Lattice& lattice, const CellStore& store,
                           const FoldCellMap& folds, TracedVertices& vertices)
    : field_(field), lattice_(lattice), store_(store), vertices_(vertices) {
  for (const auto& [key, cell] : folds) {
    for (int level = 0; level <= key.level; ++level) {
      const auto [number, is_new] = folds_.insert(cell_around(key, level));
      if (is_new) fold_marks_.emplace_back();
      if (level == key.level) fold_marks_[number] = {true, fold_axes_of(cell)};
    }
  }
}

void SplitLattice::split(std::span<const CellKey> cells, int threads) {
  std::vector<Branch> branches(cells.size());
  parallel_for_workers(cells.size(), threads, 1, [&] {
    return [&, prover = CellProver(field_.decay()), atoms = LocalAtoms(field_)](std::size_t i) mutable {
      const LeafCell cell = find_cell(cells[i]);
      if (cell.direction.sign != 0) {
        split_certified(cell, branches[i]);
      } else {
        atoms.move_to(cell_box(lattice_, cells[i]));
        split_one(cells[i], atoms, prover, branches[i]);
      }
    };
  });
  newly_split_.clear();
  changed_cells_.clear();
  const std::size_t first_cell = cells_.size();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Branch& branch = branches[i];
    take_from_leaves(cells[i]);
    for (const CellKey& key : branch.split) {
      split_.insert(key);
      cell_of_.push_back(static_cast<std::uint32_t>(cells_.size()));
      drop_faces(key);
    }
    newly_split_.insert(newly_split_.end(), branch.split.begin(), branch.split.end());
    uncertified_.insert(uncertified_.end(), branch.uncertified.begin(), branch.uncertified.end());
    branch.leaves.shrink_to_fit();
    changed_cells_.push_back(static_cast<std::uint32_t>(cells_.size()));
    cells_.push_back({cells[i], std::move(branch.leaves)});
  }
  for (const CellKey& key : newly_split_) mark_changed_beside(key);
  sort_and_unite(changed_cells_);
  if (uncertified_.empty()) find_curves(first_cell, threads);
}

LeafCell SplitLattice::find_cell(const CellKey& key) const {
  if (key.level == 0) {
    const SurfaceCell& cell = store_.cell(*store_.find(key.lo));
    return {key, cell.direction, cell.single_axes()};
  }
  const std::vector<LeafCell>& leaves = cells_[cell_of_[*find_split_around(key)]].leaves;
  return *std::find_if(leaves.begin(), leaves.end(), [&](const LeafCell& leaf) { return leaf.key == key; });
}

void SplitLattice::take_from_leaves(const CellKey& key) {
  if (key.level == 0) return;
  const std::uint32_t parent = cell_of_[*find_split_around(key)];
  std::erase_if(cells_[parent].leaves, [&](const LeafCell& leaf) { return leaf.key == key; });
  changed_cells_.push_back(parent);
}

/// Smaller cells take the faces of a split one over.
void SplitLattice::drop_faces(const CellKey& key) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const std::int64_t by : {std::int64_t{0}, fine_size(key.level)}) {
      const auto face = faces_.find(LatticeKey(moved(key.lo, axis, by), axis, key.level));
      if (!face) continue;
      vertices_.drop(face_links_[*face].vertices);
      face_links_[*face] = {};
    }
  }
}

std::array<CellKey, 6> SplitLattice::cells_beside(const CellKey& key) {
  std::array<CellKey, 6> beside;
  for (int axis = 0; axis < 3; ++axis) {
    beside[2 * axis] = {moved(key.lo, axis, -fine_size(key.level)), key.level};
    beside[2 * axis + 1] = {moved(key.lo, axis, fine_size(key.level)), key.level};
  }
  return beside;
}

/// The smallest split cell that is larger than the one asked for and contains it, by its number in split_.
std::optional<std::uint32_t> SplitLattice::find_split_around(const CellKey& key) const {
  std::optional<std::uint32_t> around;
  for (int level = key.level - 1; level >= 0 && !around; --level) around = split_.find(cell_around(key, level));
  return around;
}

/// The cells that share faces with a split one see its curves, unless they are smaller.
void SplitLattice::mark_changed_beside(const CellKey& key) {
  for (const CellKey& beside : cells_beside(key)) {
    if (split_.contains(beside)) continue;
    if (const auto around = find_split_around(beside)) changed_cells_.push_back(cell_of_[*around]);
  }
}

std::vector<CellStore::Place> SplitLattice::changed_places() const {
  std::vector<CellStore::Place> places;
  for (const CellKey& key : newly_split_) {
    if (key.level == 0) places.push_back(*store_.find(key.lo));
    for (const CellKey& beside : cells_beside(key)) {
      if (split_.contains(beside) || find_split_around(beside)) continue;
      if (const auto place = store_.find(cell_around(beside, 0).lo)) places.push_back(*place);
    }
  }
  sort_and_unite(places);
  return places;
}

void SplitLattice::mark_cells(CellStore& store) const {
  const auto take_over = [&](const CellStore::Place& place, int axis) {
    SurfaceCell& owner = store.cell(place);
    if (owner.face[axis].is_divided) return;
    owner.face[axis].is_divided = true;
    for (const Link& link : store.face_links(place, axis)) {
      if (link.from >= store.root_vertices()) vertices_.drop({link.from, 1});
    }
  };
  for (const CellKey& key : newly_split_) {
    if (key.level > 0) continue;
    const auto place = store.find(key.lo);
    store.cell(*place).split = true;
    for (int axis = 0; axis < 3; ++axis) {
      take_over(*place, axis);
      if (const auto next = store.find(moved(key.lo, axis, kFinePerCell), place->brick)) take_over(*next, axis);
    }
  }
}

bool SplitLattice::is_fold_cell(const CellKey& key) const {
  const auto number = folds_.find(key);
  return number && fold_marks_[*number].is_fold_cell;
}

unsigned SplitLattice::fold_axes(const LatticeKey& face) const {
  unsigned axes = 0;
  if (folds_.size() == 0) return axes;
  for (const std::int64_t by : {std::int64_t{0}, -fine_size(face.level)}) {
    const CellKey beside{moved(face.lo(), face.axis, by), face.level};
    for (int level = 0; level <= face.level; ++level) {
      const CellKey key = cell_around(beside, level);
      const auto number = folds_.find(key);
      if (!number) break;
      if (fold_marks_[*number].axes != 0 && !split_.contains(key)) axes |= fold_marks_[*number].axes;
    }
  }
  return axes;
}

/// What is proven of a cell holds for its children too.
void SplitLattice::split_certified(const LeafCell& cell, Branch& branch) {
  branch.split.push_back(cell.key);
  for (int c = 0; c < 8; ++c) {
    branch.leaves.push_back({child_cell(cell.key, c), cell.direction, cell.single_axes, true});
  }
}

/// Where no axis was found for a cell, atoms that its list leaves out are often the reason: its parts take them.
void SplitLattice::split_one(const CellKey& key, LocalAtoms& around, CellProver& prover, Branch& branch) const {
  branch.split.push_back(key);
  for (int c = 0; c < 8; ++c) {
    const CellKey child = child_cell(key, c);
    const Box box = cell_box(lattice_, child);
    const NearAtoms& near = around.within(Reach::kFine);
    const CellCertificate certificate =
        prover.certify(near, LocalModel(near, field_.decay(), box), proof_depth(child.level));
    if (certificate.kind == CellCertificate::Kind::kExcluded) continue;
    const bool certified = certificate.kind == CellCertificate::Kind::kMonotone;
    if (certified) {
      branch.leaves.push_back({child, certificate.direction, certificate.single_axes});
    } else if (is_fold_cell(child)) {
      branch.leaves.push_back({child, {}, 0});
    } else if (child.level < kMaxLevel) {
      LocalAtoms atoms(field_);
      atoms.move_to(box, &around);
      split_one(child, atoms, prover, branch);
    } else {
      Vec3 middle;
      for (int k = 0; k < 3; ++k) middle[k] = 0.5 * (box.lo[k] + box.hi[k]);
      branch.uncertified.push_back({middle, box.hi[0] - box.lo[0]});
      return;  // one place is enough
    }
  }
}

}  // namespace gaussmesh

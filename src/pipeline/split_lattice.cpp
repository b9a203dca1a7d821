#include "pipeline/split_lattice.h"

#include <algorithm>
#include <bit>

#include "core/parallel.h"
#include "core/sort_and_unite.h"
#include "field/local_atoms.h"
#include "gaussmesh/error.h"

namespace gaussmesh {
namespace {

/// The coarsest level that has a lattice plane at fine index n.
int level_of_plane(std::int64_t n) {
  return n == 0 ? 0 : std::max(0, kMaxLevel - std::countr_zero(static_cast<std::uint64_t>(n)));
}

std::int64_t round_down(std::int64_t n, std::int64_t size) {
  return n >= 0 ? n / size * size : -((-n + size - 1) / size * size);
}

/// Down to this level cells are not smaller than the parts that proofs look at in cells of level 0, and their edges
/// and faces take as many atoms; in smaller ones, near singular places, atoms left out may decide.
constexpr int kLastPlainLevel = 3;

/// Split cells whose edges and faces are looked at together: most of them turn out to have no surface, and are not
/// kept.
constexpr std::size_t kCellsAtOnce = 512;

/// Leaves whose edges or faces a thread takes at a time.
constexpr int kTasksAtOnce = 16;

/// How far the proof for a part of a cell looks: down to what the proof of the whole cell looked at, and once at
/// least. It gives up the sooner the smaller the parts are, since each is split in its turn.
int proof_depth(int level) { return std::max(1, kProofDepth - level); }

Reach proof_reach(int level) { return level <= kLastPlainLevel ? Reach::kProof : Reach::kFine; }
Reach root_reach(int level) { return level <= kLastPlainLevel ? Reach::kPlain : Reach::kFine; }

/// The cell of a lower level that contains a cell.
CellKey cell_around(const CellKey& cell, int level) {
  CellKey result{{}, level};
  for (int k = 0; k < 3; ++k) result.lo[k] = round_down(cell.lo[k], fine_size(level));
  return result;
}

/// Axes along which the components of a cell are cut.
unsigned fold_axes_of(const FoldCell& cell) {
  unsigned axes = 0;
  for (const FoldComponent& c : cell.components) axes |= c.fold_axis >= 0 ? 1u << c.fold_axis : 0u;
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

void SplitLattice::split(std::span<const CellKey> cells, int threads) {
  std::vector<Branch> branches(cells.size());
  parallel_for_workers(cells.size(), threads, 1, [&] {
    return
        [&, prover = CellProver(field_.decay()), atoms = LocalAtoms(field_)](std::size_t i) mutable {
          atoms.move_to(cell_box(lattice_, cells[i]));
          const LeafCell cell = find_cell(cells[i]);
          if (cell.direction.sign != 0) {
            split_certified(cell, atoms, prover, branches[i]);
          } else {
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
  if (!uncertified_.empty()) return;
  for (std::size_t first = first_cell; first < cells_.size(); first += kCellsAtOnce) {
    const std::size_t count = std::min(kCellsAtOnce, cells_.size() - first);
    const auto some = std::span<const SplitCell>(cells_).subspan(first, count);
    find_edge_roots(some, threads);
    trace_faces(some, threads);
  }
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

unsigned SplitLattice::fold_axes(const LatticeKey& face) const {
  unsigned axes = 0;
  if (folds_.empty()) return axes;
  for (const std::int64_t by : {std::int64_t{0}, -fine_size(face.level)}) {
    const CellKey beside{moved(face.lo(), face.axis, by), face.level};
    for (int level = 0; level <= face.level; ++level) {
      const CellKey key = cell_around(beside, level);
      const auto it = folds_.find(key);
      if (it != folds_.end() && !split_.contains(key)) axes |= fold_axes_of(it->second);
    }
  }
  return axes;
}

/// What is proven of a cell holds for its children too.
void SplitLattice::split_certified(const LeafCell& cell, LocalAtoms& around, CellProver& prover,
                                   Branch& branch) const {
  branch.split.push_back(cell.key);
  for (int c = 0; c < 8; ++c) {
    const CellKey child = child_cell(cell.key, c);
    const NearAtoms& near = around.within(proof_reach(child.level));
    const CellCertificate own = prover.certify(near, LocalModel(near, field_.decay(), cell_box(lattice_, child)), 0);
    if (own.kind == CellCertificate::Kind::kExcluded) continue;
    const bool is_proven = own.kind == CellCertificate::Kind::kMonotone;
    branch.leaves.push_back({child, is_proven ? own.direction : cell.direction,
                             own.single_axes | unsigned{cell.single_axes}});
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
    } else if (folds_.contains(child)) {
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

SplitLattice::LatticeKey SplitLattice::whole_edge(int axis, const FineIndex& lo) const {
  const int level = std::max(level_of_plane(lo[first_axis(axis)]), level_of_plane(lo[second_axis(axis)]));
  return LatticeKey(moved(lo, axis, round_down(lo[axis], fine_size(level)) - lo[axis]), axis, level);
}

template <typename Visit>
SplitLattice::Wanted SplitLattice::list_wanted(std::span<const SplitCell> cells, const LatticeKeys& found, int threads,
                                               const Visit& visit) {
  struct Asked {
    LatticeKey key;
    std::uint32_t leaf;  ///< that asked for it first
    bool is_found;
    std::uint8_t known;
  };
  std::vector<std::vector<Asked>> by_cell(cells.size());
  parallel_for_workers(cells.size(), threads, kTasksAtOnce, [&] {
    return [&, keys = LatticeKeys()](std::size_t i) mutable {
      keys.clear();
      std::vector<Asked>& asked = by_cell[i];
      for (std::uint32_t leaf = 0; leaf < cells[i].leaves.size(); ++leaf) {
        visit(cells[i].leaves[leaf], [&](const LatticeKey& key, unsigned known) {
          const auto [number, is_new] = keys.insert(key);
          if (is_new) asked.push_back({key, leaf, found.contains(key), 0});
          asked[number].known |= static_cast<std::uint8_t>(known);
        });
      }
    };
  });
  Wanted all;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const Asked& asked : by_cell[i]) {
      if (asked.is_found) continue;
      const auto [number, is_new] = all.keys.insert(asked.key);
      if (is_new) all.known.push_back(0);
      all.known[number] |= asked.known;
      if (!is_new) continue;
      const CellKey& leaf = cells[i].leaves[asked.leaf].key;
      if (all.tasks.empty() || !(all.tasks.back().leaf == leaf)) {
        all.tasks.push_back({cells[i].key, leaf, number, number});
      }
      all.tasks.back().last = number + 1;
    }
  }
  return all;
}

void SplitLattice::find_edge_roots(std::span<const SplitCell> cells, int threads) {
  const Wanted edges = list_wanted(cells, edges_, threads, [&](const LeafCell& leaf, const auto& ask) {
    const std::int64_t size = fine_size(leaf.key.level);
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 4; ++corner) {
        const FineIndex lo = moved(moved(leaf.key.lo, first_axis(axis), (corner & 1) * size), second_axis(axis),
                                   (corner >> 1) * size);
        const LatticeKey edge = whole_edge(axis, lo);
        if (edge.level > 0) ask(edge, edge.level == leaf.key.level ? leaf.single_axes >> axis & 1u : 0u);
      }
    }
  });
  std::vector<std::vector<EdgeRoot>> found(edges.keys.size());
  parallel_for_workers(edges.tasks.size(), threads, kTasksAtOnce, [&] {
    return [&, atoms = LocalAtoms(field_), around = CellKey{{}, -1},
            finder = EdgeRootFinder(field_, lattice_)](std::size_t t) mutable {
      const Task& task = edges.tasks[t];
      if (!(task.cell == around)) atoms.move_to(cell_box(lattice_, around = task.cell));
      const LocalModel in_leaf(atoms.within(proof_reach(task.leaf.level)), field_.decay(),
                               cell_box(lattice_, task.leaf));
      for (std::uint32_t i = task.first; i < task.last; ++i) {
        const LatticeKey& edge = edges.keys[i];
        const FineIndex end = moved(edge.lo(), edge.axis, fine_size(edge.level));
        const auto find = [&](const LocalModel& model) {
          const auto roots = finder.find(atoms.within(root_reach(edge.level)), model, edge.axis,
                                         lattice_.point(edge.lo()), lattice_.plane(edge.axis, end[edge.axis]),
                                         {Side::kUnknown, Side::kUnknown, edges.known[i] != 0});
          found[i].assign(roots.begin(), roots.end());
        };
        if (edge.level == task.leaf.level) {
          find(in_leaf);
        } else {
          find(LocalModel(atoms.within(proof_reach(edge.level)), field_.decay(),
                          lattice_box(lattice_, edge.lo(), end)));
        }
      }
    };
  });
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty()) continue;
    edges_.insert(edges.keys[i]);
    edge_roots_.push_back(vertices_.add(found[i]));
  }
}

void SplitLattice::add_roots_on(int axis, const FineIndex& lo, int level, int side,
                                std::vector<FaceRoot>& roots) const {
  const Coord from = lattice_.plane(axis, lo[axis]), to = lattice_.plane(axis, lo[axis] + fine_size(level));
  VertexRange found;
  const LatticeKey edge = whole_edge(axis, lo);
  if (edge.level == 0) {
    if (const auto place = store_.find(edge.lo())) found = store_.edge_roots(*place, axis);
  } else {
    if (const auto number = edges_.find(edge)) found = edge_roots_[*number];
  }
  for (std::uint32_t v = found.first; v < found.first + found.count; ++v) {
    const CoordPoint& position = vertices_[v].position;
    if (position[axis] > from && position[axis] < to) roots.push_back({v, position, side, vertices_.rise(v)});
  }
}

void SplitLattice::collect_face_roots(const LatticeKey& face, std::vector<FaceRoot>& roots) const {
  const int a = first_axis(face.axis), b = second_axis(face.axis);
  const std::int64_t size = fine_size(face.level);
  roots.clear();
  add_roots_on(a, face.lo(), face.level, 0, roots);
  add_roots_on(b, moved(face.lo(), a, size), face.level, 1, roots);
  add_roots_on(a, moved(face.lo(), b, size), face.level, 2, roots);
  add_roots_on(b, face.lo(), face.level, 3, roots);
}

bool SplitLattice::is_divided(int axis, const FineIndex& lo, int level) const {
  return split_.contains({lo, level}) || split_.contains({moved(lo, axis, -fine_size(level)), level});
}

void SplitLattice::trace_faces(std::span<const SplitCell> cells, int threads) {
  const Wanted faces = list_wanted(cells, faces_, threads, [&](const LeafCell& leaf, const auto& ask) {
    const std::int64_t size = fine_size(leaf.key.level);
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int64_t by : {std::int64_t{0}, size}) {
        const CellKey beside{moved(leaf.key.lo, axis, by == 0 ? -size : size), leaf.key.level};
        if (split_.contains(beside)) continue;
        const FineIndex lo = moved(leaf.key.lo, axis, by);
        ask(LatticeKey(lo, axis, leaf.key.level), certificate_in_face(leaf.single_axes, axis));
      }
    }
  });
  std::vector<FaceCurves> curves(faces.keys.size());
  parallel_for_workers(faces.tasks.size(), threads, kTasksAtOnce, [&] {
    return [&, atoms = LocalAtoms(field_), around = CellKey{{}, -1}, tracer = FaceTracer(field_, lattice_),
            roots = std::vector<FaceRoot>()](std::size_t t) mutable {
      const Task& task = faces.tasks[t];
      if (!(task.cell == around)) atoms.move_to(cell_box(lattice_, around = task.cell));
      tracer.take_atoms_from(atoms);
      std::optional<LocalModel> in_leaf;  // made when a face needs a certificate
      for (std::uint32_t i = task.first; i < task.last; ++i) {
        const LatticeKey& face = faces.keys[i];
        const std::int64_t size = fine_size(face.level);
        const FineIndex end = moved(moved(face.lo(), first_axis(face.axis), size), second_axis(face.axis), size);
        collect_face_roots(face, roots);
        auto certificate = static_cast<FaceCertificate>(faces.known[i]);
        if (certificate == kFaceUncertified) {
          if (!in_leaf) {
            in_leaf.emplace(atoms.within(proof_reach(task.leaf.level)), field_.decay(), cell_box(lattice_, task.leaf));
          }
          certificate = certify_face(*in_leaf, face.axis, lattice_box(lattice_, face.lo(), end));
        }
        tracer.set_plain(face.level <= kLastPlainLevel);
        curves[i] = tracer.trace(face.axis, lattice_.point(face.lo()), lattice_.point(end), certificate, roots,
                                 fold_axes(face));
      }
    };
  });
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const FaceCurves& found = curves[i];
    if (found.links.empty()) continue;
    faces_.insert(faces.keys[i]);
    const VertexRange inside = vertices_.add(found.points);
    face_links_.push_back({static_cast<std::uint32_t>(links_.size()), static_cast<std::uint32_t>(found.links.size()),
                           inside});
    const auto numbered = [&](std::uint32_t v) { return v >= kLocalVertex ? inside.first + (v - kLocalVertex) : v; };
    for (const Link& link : found.links) links_.push_back({numbered(link.from), numbered(link.to)});
  }
}

std::span<const Link> SplitLattice::face_links(int axis, const FineIndex& lo, int level) const {
  const auto number = faces_.find(LatticeKey(lo, axis, level));
  if (!number) return {};
  const FaceLinks& face = face_links_[*number];
  return {links_.data() + face.first_link, face.link_count};
}

}  // namespace gaussmesh

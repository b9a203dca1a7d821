// The roots on the edges and the curves on the faces of cells below level 0.
//
// Which cells there are is split_lattice.cpp.
#include <algorithm>
#include <bit>

#include "core/parallel.h"
#include "pipeline/split_lattice.h"

namespace gaussmesh {
namespace {

/// Split cells whose edges and faces are looked at together: most of them turn out to have no surface, and are not
/// kept.
constexpr std::size_t kCellsAtOnce = 128;

/// Split cells that a thread takes at a time where there is little to do for each.
constexpr int kTasksAtOnce = 16;

/// The coarsest level that has a lattice plane at fine index n.
int level_of_plane(std::int64_t n) {
  return n == 0 ? 0 : std::max(0, kMaxLevel - std::countr_zero(static_cast<std::uint64_t>(n)));
}

Reach root_reach(int level) { return level <= kLastPlainLevel ? Reach::kPlain : Reach::kFine; }

/// Where the edge of a cell along `axis` begins, at the corner across it that the bits say: 1 is the upper one along
/// the first axis of the plane across, 2 along the second.
FineIndex edge_corner(const CellKey& cell, int axis, int corner) {
  const std::int64_t size = fine_size(cell.level);
  return moved(moved(cell.lo, first_axis(axis), (corner & 1) * size), second_axis(axis), (corner >> 1) * size);
}

/// Which parts of its box a model shows to have no surface: bit i of part i.
unsigned free_parts(const LocalModel& model, std::span<const Box> parts) {
  unsigned free = 0;
  for (std::size_t first = 0; first < parts.size(); first += PartProofs::kMost) {
    const std::size_t count = std::min<std::size_t>(PartProofs::kMost, parts.size() - first);
    const PartProofs proofs = model.prove(parts.subspan(first, count));
    for (std::size_t i = 0; i < count; ++i) free |= unsigned{proofs.directions[i] == kAllDirections} << (first + i);
  }
  return free;
}

}  // namespace

void SplitLattice::find_curves(std::size_t first_cell, int threads) {
  std::vector<CellWork> work(std::min(kCellsAtOnce, cells_.size() - first_cell), CellWork(field_));
  for (std::size_t first = first_cell; first < cells_.size(); first += kCellsAtOnce) {
    const std::size_t count = std::min(kCellsAtOnce, cells_.size() - first);
    const auto some = std::span(cells_).subspan(first, count);
    parallel_for_workers(count, threads, kTasksAtOnce,
                         [&] { return [&](std::size_t i) { prepare(some[i], work[i]); }; });
    find_edge_roots(some, work, threads);
    trace_faces(some, work, threads);
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
    std::uint32_t leaf = 0;  ///< that asked for it first
    bool is_found = false;
    std::uint8_t known = 0;
  };
  std::vector<std::vector<Asked>> by_cell(cells.size());
  parallel_for_workers(cells.size(), threads, kTasksAtOnce, [&] {
    return [&, keys = LatticeKeys()](std::size_t i) mutable {
      keys.clear();
      std::vector<Asked>& asked = by_cell[i];
      for (std::uint32_t leaf = 0; leaf < cells[i].leaves.size(); ++leaf) {
        visit(i, leaf, cells[i].leaves[leaf], [&](const LatticeKey& key, unsigned known) {
          const auto [number, is_new] = keys.insert(key);
          if (is_new) asked.push_back({key, leaf, found.contains(key), 0});
          asked[number].known |= static_cast<std::uint8_t>(known);
        });
      }
    };
  });
  Wanted all;
  std::size_t most = 0;
  for (const std::vector<Asked>& asked : by_cell) most += asked.size();
  all.keys.reserve(most);
  all.tasks.resize(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::vector<Task>& tasks = all.tasks[i];
    for (const Asked& asked : by_cell[i]) {
      if (asked.is_found) continue;
      const auto [number, is_new] = all.keys.insert(asked.key);
      if (is_new) all.known.push_back(0);
      all.known[number] |= asked.known;
      if (!is_new) continue;
      if (tasks.empty() || tasks.back().leaf != asked.leaf) tasks.push_back({asked.leaf, number, number});
      tasks.back().last = number + 1;
    }
  }
  return all;
}

/// Looks for a certificate of the leaf's own. @return whether the surface may be in the leaf
bool SplitLattice::look_closer(LeafCell& leaf, const LocalModel& model, CellWork& work) {
  const NearAtoms& near = work.atoms.within(proof_reach(leaf.key.level));
  const CellCertificate own = work.prover.certify(near, model, 0);
  if (own.kind == CellCertificate::Kind::kMonotone) leaf.direction = own.direction;
  leaf.single_axes = static_cast<std::uint8_t>(leaf.single_axes | own.single_axes);
  return own.kind != CellCertificate::Kind::kExcluded;
}

/// Finds at once, of all leaves, what need not be looked at any more, and drops those without surface.
void SplitLattice::prepare(SplitCell& cell, CellWork& work) const {
  work.atoms.move_to(cell_box(lattice_, cell.key));
  work.models.clear();
  work.free_edges.clear();
  std::vector<LeafCell> kept;
  for (LeafCell& leaf : cell.leaves) {
    const std::int64_t size = fine_size(leaf.key.level);
    const LocalModel& model = work.models.emplace_back(work.atoms.within(proof_reach(leaf.key.level)), field_.decay(),
                                                       cell_box(lattice_, leaf.key));
    if (leaf.is_inherited && !look_closer(leaf, model, work)) {
      work.models.pop_back();
      continue;
    }
    std::array<Box, 12> edges;
    std::array<Box, 6> faces;
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 4; ++corner) {
        const FineIndex lo = edge_corner(leaf.key, axis, corner);
        edges[4 * axis + corner] = lattice_box(lattice_, lo, moved(lo, axis, size));
      }
      for (int side = 0; side < 2; ++side) {
        Box& face = faces[2 * axis + side] = model.box();
        (side == 0 ? face.hi : face.lo)[axis] = (side == 0 ? face.lo : face.hi)[axis];
      }
    }
    work.free_edges.push_back(static_cast<std::uint16_t>(free_parts(model, edges)));
    leaf.empty_faces = static_cast<std::uint8_t>(free_parts(model, faces));
    kept.push_back(leaf);
  }
  kept.shrink_to_fit();
  cell.leaves = std::move(kept);
}

void SplitLattice::find_edge_roots(std::span<const SplitCell> cells, std::span<CellWork> work, int threads) {
  const auto visit = [&](std::size_t cell, std::size_t number, const LeafCell& leaf, const auto& ask) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 4; ++corner) {
        if (work[cell].free_edges[number] >> (4 * axis + corner) & 1) continue;
        const LatticeKey edge = whole_edge(axis, edge_corner(leaf.key, axis, corner));
        if (edge.level > 0) ask(edge, edge.level == leaf.key.level ? leaf.single_axes >> axis & 1u : 0u);
      }
    }
  };
  const Wanted edges = list_wanted(cells, edges_, threads, visit);
  std::vector<std::vector<EdgeRoot>> found(edges.keys.size());
  parallel_for_workers(cells.size(), threads, 1, [&] {
    return [&, finder = EdgeRootFinder(field_, lattice_), own = LocalAtoms(field_)](std::size_t c) mutable {
      for (const Task& task : edges.tasks[c]) {
        const int level = cells[c].leaves[task.leaf].key.level;
        for (std::uint32_t i = task.first; i < task.last; ++i) {
          const LatticeKey& edge = edges.keys[i];
          const FineIndex end = moved(edge.lo(), edge.axis, fine_size(edge.level));
          const Box edge_box = lattice_box(lattice_, edge.lo(), end);
          // One beside a larger cell may be longer than the cell that was split here: its atoms are not all.
          const bool is_longer = edge.level < cells[c].key.level;
          if (is_longer) own.move_to(edge_box);
          LocalAtoms& atoms = is_longer ? own : work[c].atoms;
          const auto find = [&](const LocalModel& model) {
            const auto roots = finder.find(atoms.within(root_reach(edge.level)), model, edge.axis,
                                           lattice_.point(edge.lo()), lattice_.plane(edge.axis, end[edge.axis]),
                                           {Side::kUnknown, Side::kUnknown, edges.known[i] != 0});
            found[i].assign(roots.begin(), roots.end());
          };
          if (edge.level == level) {
            find(work[c].models[task.leaf]);
          } else {
            find(LocalModel(atoms.within(proof_reach(edge.level)), field_.decay(), edge_box));
          }
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

void SplitLattice::collect_face_roots(const LatticeKey& face, unsigned free_edges, bool is_high,
                                      std::vector<FaceRoot>& roots) const {
  const int a = first_axis(face.axis), b = second_axis(face.axis);
  const std::int64_t size = fine_size(face.level);
  // The axis across the face is the second one across `a`, and the first one across `b`.
  const int low_b = 4 * a + 2 * is_high, low_a = 4 * b + is_high, high_b = low_b + 1, high_a = low_a + 2;
  const FineIndex lo = face.lo();
  roots.clear();
  if (!(free_edges >> low_b & 1)) add_roots_on(a, lo, face.level, 0, roots);
  if (!(free_edges >> high_a & 1)) add_roots_on(b, moved(lo, a, size), face.level, 1, roots);
  if (!(free_edges >> high_b & 1)) add_roots_on(a, moved(lo, b, size), face.level, 2, roots);
  if (!(free_edges >> low_a & 1)) add_roots_on(b, lo, face.level, 3, roots);
}

void SplitLattice::trace_faces(std::span<const SplitCell> cells, std::span<CellWork> work, int threads) {
  const auto visit = [&](std::size_t, std::size_t, const LeafCell& leaf, const auto& ask) {
    const std::int64_t size = fine_size(leaf.key.level);
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) {
        if (leaf.empty_faces >> (2 * axis + side) & 1) continue;
        const CellKey beside{moved(leaf.key.lo, axis, side == 0 ? -size : size), leaf.key.level};
        if (split_.contains(beside)) continue;
        const FineIndex lo = moved(leaf.key.lo, axis, side * size);
        ask(LatticeKey(lo, axis, leaf.key.level), certificate_in_face(leaf.single_axes, axis));
      }
    }
  };
  const Wanted faces = list_wanted(cells, faces_, threads, visit);
  std::vector<FaceCurves> curves(faces.keys.size());
  parallel_for_workers(cells.size(), threads, 1, [&] {
    return [&, tracer = FaceTracer(field_, lattice_), roots = std::vector<FaceRoot>()](std::size_t c) mutable {
      tracer.take_atoms_from(work[c].atoms);
      for (const Task& task : faces.tasks[c]) {
        const LeafCell& leaf = cells[c].leaves[task.leaf];
        for (std::uint32_t i = task.first; i < task.last; ++i) {
          const LatticeKey& face = faces.keys[i];
          const bool is_high = face.lo()[face.axis] != leaf.key.lo[face.axis];
          collect_face_roots(face, work[c].free_edges[task.leaf], is_high, roots);
          const auto known = static_cast<FaceCertificate>(faces.known[i]);
          curves[i] = trace_face(face, known, work[c].models[task.leaf], roots, tracer);
        }
      }
    };
  });
  for (std::size_t i = 0; i < curves.size(); ++i) keep_curves(faces.keys[i], curves[i]);
}

const FaceCurves& SplitLattice::trace_face(const LatticeKey& face, FaceCertificate known, const LocalModel& model,
                                           std::span<const FaceRoot> roots, FaceTracer& tracer) const {
  const std::int64_t size = fine_size(face.level);
  const FineIndex end = moved(moved(face.lo(), first_axis(face.axis), size), second_axis(face.axis), size);
  const FaceCertificate certificate =
      known != kFaceUncertified ? known : certify_face(model, face.axis, lattice_box(lattice_, face.lo(), end));
  tracer.set_plain(face.level <= kLastPlainLevel);
  return tracer.trace(face.axis, lattice_.point(face.lo()), lattice_.point(end), certificate, roots, fold_axes(face));
}

void SplitLattice::keep_curves(const LatticeKey& face, const FaceCurves& curves) {
  if (curves.links.empty()) return;
  faces_.insert(face);
  const VertexRange inside = vertices_.add(curves.points);
  face_links_.push_back(
      {static_cast<std::uint32_t>(links_.size()), static_cast<std::uint32_t>(curves.links.size()), inside});
  const auto numbered = [&](std::uint32_t v) { return v >= kLocalVertex ? inside.first + (v - kLocalVertex) : v; };
  for (const Link& link : curves.links) links_.push_back({numbered(link.from), numbered(link.to)});
}

std::span<const Link> SplitLattice::face_links(int axis, const FineIndex& lo, int level) const {
  const auto number = faces_.find(LatticeKey(lo, axis, level));
  if (!number) return {};
  const FaceLinks& face = face_links_[*number];
  return {links_.data() + face.first_link, face.link_count};
}

}  // namespace gaussmesh

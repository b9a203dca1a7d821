#include "pipeline/split_lattice.h"

#include <algorithm>
#include <bit>

#include "core/parallel.h"
#include "pipeline/cell_atoms.h"

namespace gaussmesh {
namespace {

/// The coarsest level that has a lattice plane at fine index n.
int level_of_plane(std::int64_t n) {
  return n == 0 ? 0 : std::max(0, kMaxLevel - std::countr_zero(static_cast<std::uint64_t>(n)));
}

std::int64_t round_down(std::int64_t n, std::int64_t size) {
  return n >= 0 ? n / size * size : -((-n + size - 1) / size * size);
}

/// Edges or faces that a thread takes at a time.
constexpr int kChunk = 32;

/// Axes along which the components of a cell are cut.
unsigned fold_axes_of(const FoldCell& cell) {
  unsigned axes = 0;
  for (const FoldComponent& c : cell.components) axes |= c.fold_axis >= 0 ? 1u << c.fold_axis : 0u;
  return axes;
}

}  // namespace

SplitLattice::SplitLattice(const GaussianField& field, const Lattice& lattice, CellStore& store,
                           const FoldCellMap& folds, const CellSet& forced, int threads)
    : field_(field), lattice_(lattice), store_(store), folds_(folds) {
  std::vector<CellKey> roots;
  for (std::uint32_t b = 0; b < store.bricks().size(); ++b) {
    std::vector<SurfaceCell>& cells = store.bricks()[b].cells;
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      const CellKey key{store.lowest_corner({b, i}), 0};
      cells[i].divided_faces = 0;
      cells[i].fold_axes = {};
      cells[i].split = forced.contains(key) || (cells[i].sign == 0 && !folds.contains(key));
      if (cells[i].split) roots.push_back(key);
    }
  }
  std::vector<Branch> branches(roots.size());
  parallel_for(roots.size(), threads, [&](std::size_t i) {
    CellProver prover(field_.decay(), kProofDepth);
    NearAtoms atoms;
    field_.collect_near(cell_box(lattice_, roots[i]), atoms, kFineTruncation);
    split(roots[i], atoms, forced, prover, branches[i]);
  });
  for (const Branch& branch : branches) {
    leaves_.insert(leaves_.end(), branch.leaves.begin(), branch.leaves.end());
    split_.insert(branch.split.begin(), branch.split.end());
    uncertified_.insert(uncertified_.end(), branch.uncertified.begin(), branch.uncertified.end());
  }
  mark_level_zero(roots);
  if (uncertified_.empty()) find_edge_roots(threads);
}

void SplitLattice::mark_level_zero(const std::vector<CellKey>& roots) {
  for (const CellKey& key : roots) {
    const auto place = store_.find(key.lo);
    store_.cell(*place).divided_faces = 7;
    for (int axis = 0; axis < 3; ++axis) {
      const auto next = store_.find(moved(key.lo, axis, kFinePerCell), place->brick);
      if (next) store_.cell(*next).divided_faces |= static_cast<std::uint8_t>(1u << axis);
    }
  }
  for (const auto& [key, cell] : folds_) {
    if (key.level > 0 || split_.contains(key)) continue;
    const auto axes = static_cast<std::uint8_t>(fold_axes_of(cell));
    const auto place = store_.find(key.lo);
    for (int axis = 0; axis < 3; ++axis) {
      store_.cell(*place).fold_axes[axis] |= axes;
      const auto next = store_.find(moved(key.lo, axis, kFinePerCell), place->brick);
      if (next) store_.cell(*next).fold_axes[axis] |= axes;
    }
  }
}

unsigned SplitLattice::fold_axes(const LatticeKey& face) const {
  unsigned axes = 0;
  for (const std::int64_t by : {std::int64_t{0}, -fine_size(face.level)}) {
    const FineIndex beside = moved(face.lo, face.axis, by);
    for (int level = 0; level <= face.level; ++level) {
      CellKey key{{}, level};
      for (int k = 0; k < 3; ++k) key.lo[k] = round_down(beside[k], fine_size(level));
      const auto it = folds_.find(key);
      if (it != folds_.end() && !split_.contains(key)) axes |= fold_axes_of(it->second);
    }
  }
  return axes;
}

std::vector<SurfacePoint> SplitLattice::lattice_points() const {
  std::vector<SurfacePoint> points;
  points.reserve(next_vertex());
  for (const Brick& brick : store_.bricks()) {
    for (const EdgeRoot& root : brick.roots) points.push_back(root.point);
  }
  points.insert(points.end(), points_.begin(), points_.end());
  return points;
}

void SplitLattice::split(const CellKey& key, const NearAtoms& around, const CellSet& forced, CellProver& prover,
                         Branch& branch) const {
  branch.split.push_back(key);
  NearAtoms atoms;
  atoms.restrict_from(around, cell_box(lattice_, key), field_.decay(), kFineTruncation);
  for (int c = 0; c < 8; ++c) {
    const CellKey child = child_cell(key, c);
    const Box box = cell_box(lattice_, child);
    const CellCertificate certificate = prover.certify(atoms, LocalModel(atoms, field_.decay(), box));
    if (certificate.kind == CellCertificate::Kind::kExcluded) continue;
    const bool certified = certificate.kind == CellCertificate::Kind::kMonotone;
    if (certified && !forced.contains(child)) {
      branch.leaves.push_back({child, certificate.axis, certificate.sign});
    } else if (!certified && !forced.contains(child) && folds_.contains(child)) {
      branch.leaves.push_back({child, 0, 0});
    } else if (child.level < kMaxLevel) {
      split(child, atoms, forced, prover, branch);
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
  FineIndex start = lo;
  start[axis] = round_down(lo[axis], fine_size(level));
  return {start, axis, level};
}

void SplitLattice::find_edge_roots(int threads) {
  for (const LeafCell& leaf : leaves_) {
    const std::int64_t size = fine_size(leaf.key.level);
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 4; ++corner) {
        FineIndex lo = leaf.key.lo;
        lo[first_axis(axis)] += (corner & 1) * size;
        lo[second_axis(axis)] += (corner >> 1) * size;
        const LatticeKey edge = whole_edge(axis, lo);
        if (edge.level > 0) edges_.push_back(edge);
      }
    }
  }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());

  std::vector<std::vector<EdgeRoot>> found(edges_.size());
  parallel_for_workers(edges_.size(), threads, kChunk, [&] {
    return [&, cells = CellAtoms(field_, lattice_), finder = EdgeRootFinder(field_, lattice_),
            atoms = NearAtoms()](std::size_t i) mutable {
      const LatticeKey& edge = edges_[i];
      const FineIndex end = moved(edge.lo, edge.axis, fine_size(edge.level));
      const Box box = lattice_box(lattice_, edge.lo, end);
      atoms.restrict_from(cells.around(edge.lo), box, field_.decay(), kFineTruncation);
      const auto roots = finder.find(atoms, LocalModel(atoms, field_.decay(), box), edge.axis, lattice_.point(edge.lo),
                                     lattice_.plane(edge.axis, end[edge.axis]));
      found[i].assign(roots.begin(), roots.end());
    };
  });
  edge_roots_.resize(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    for (const EdgeRoot& root : found[i]) {
      const auto vertex = first_vertex() + static_cast<std::uint32_t>(points_.size());
      edge_roots_[i].push_back({vertex, root.point.position, root.side});
      points_.push_back(root.point);
    }
  }
}

std::vector<VertexRoot> SplitLattice::roots_on(int axis, const FineIndex& lo, int level) const {
  const Coord from = lattice_.plane(axis, lo[axis]), to = lattice_.plane(axis, lo[axis] + fine_size(level));
  std::vector<VertexRoot> result;
  const auto keep = [&](const VertexRoot& root) {
    if (root.position[axis] > from && root.position[axis] < to) result.push_back(root);
  };
  const LatticeKey edge = whole_edge(axis, lo);
  if (edge.level == 0) {
    if (const auto place = store_.find(edge.lo)) {
      std::uint32_t vertex = store_.first_vertex(*place, axis);
      for (const EdgeRoot& root : store_.edge_roots(*place, axis)) keep({vertex++, root.point.position, root.side});
    }
  } else {
    const auto it = std::lower_bound(edges_.begin(), edges_.end(), edge);
    if (it != edges_.end() && *it == edge) {
      for (const VertexRoot& root : edge_roots_[it - edges_.begin()]) keep(root);
    }
  }
  return result;
}

std::vector<FaceRoot> SplitLattice::face_roots(const LatticeKey& face) const {
  const int a = first_axis(face.axis), b = second_axis(face.axis);
  const std::int64_t size = fine_size(face.level);
  std::vector<FaceRoot> result;
  const auto add = [&](int axis, const FineIndex& lo, int side) {
    for (const VertexRoot& root : roots_on(axis, lo, face.level)) {
      result.push_back({root.vertex, root.position, side, root.rise});
    }
  };
  add(a, face.lo, 0);
  add(b, moved(face.lo, a, size), 1);
  add(a, moved(face.lo, b, size), 2);
  add(b, face.lo, 3);
  return result;
}

bool SplitLattice::is_divided(int axis, const FineIndex& lo, int level) const {
  return split_.contains({lo, level}) || split_.contains({moved(lo, axis, -fine_size(level)), level});
}

void SplitLattice::trace_faces(int threads) {
  for (const LeafCell& leaf : leaves_) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int64_t by : {std::int64_t{0}, fine_size(leaf.key.level)}) {
        const FineIndex lo = moved(leaf.key.lo, axis, by);
        if (!is_divided(axis, lo, leaf.key.level)) faces_.push_back({lo, axis, leaf.key.level});
      }
    }
  }
  std::sort(faces_.begin(), faces_.end());
  faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());

  std::vector<FaceCurves> curves(faces_.size());
  parallel_for_workers(faces_.size(), threads, kChunk, [&] {
    return [&, cells = CellAtoms(field_, lattice_), tracer = FaceTracer(field_, lattice_)](std::size_t i) mutable {
      const LatticeKey& face = faces_[i];
      const std::int64_t size = fine_size(face.level);
      const FineIndex end = moved(moved(face.lo, first_axis(face.axis), size), second_axis(face.axis), size);
      const std::vector<FaceRoot> roots = face_roots(face);
      tracer.take_atoms_from(cells.around(face.lo), kFineTruncation);
      curves[i] = tracer.trace(face.axis, lattice_.point(face.lo), lattice_.point(end), kFaceUncertified, roots,
                               fold_axes(face));
    };
  });
  face_links_.resize(faces_.size());
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const std::uint32_t base = first_vertex() + static_cast<std::uint32_t>(points_.size());
    const auto numbered = [&](std::uint32_t v) { return v >= kLocalVertex ? base + (v - kLocalVertex) : v; };
    for (const Link& link : curves[i].links) face_links_[i].push_back({numbered(link.from), numbered(link.to)});
    points_.insert(points_.end(), curves[i].points.begin(), curves[i].points.end());
  }
}

std::span<const Link> SplitLattice::face_links(int axis, const FineIndex& lo, int level) const {
  const LatticeKey key{lo, axis, level};
  const auto it = std::lower_bound(faces_.begin(), faces_.end(), key);
  if (it == faces_.end() || *it != key) return {};
  return face_links_[it - faces_.begin()];
}

}  // namespace gaussmesh

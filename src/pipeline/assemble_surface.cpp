#include "pipeline/assemble_surface.h"

#include <algorithm>

#include "core/parallel.h"
#include "field/point_value.h"
#include "gaussmesh/error.h"
#include "patch/triangle_shape.h"
#include "pipeline/loop_collector.h"

namespace gaussmesh {
namespace {

/// Follows the curves on the faces that one brick owns.
class BrickTracer {
 public:
  BrickTracer(const GaussianField& field, const Lattice& lattice, const CellStore& store)
      : lattice_(lattice), store_(store), tracer_(field, lattice), atoms_(field) {
    tracer_.set_plain(true);
  }

  /// Fills the links and face points of a brick, and nothing that other bricks are traced from.
  void trace(Brick& result, std::uint32_t brick_number) {
    move_to(brick_number);
    result.links.clear();
    result.face_points.clear();
    for (std::uint32_t i = 0; i < result.cells.size(); ++i) {
      result.cells[i].first_link = static_cast<std::uint32_t>(result.links.size());
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t before = result.links.size();
        trace_face({brick_number, i}, axis, result);
        const std::size_t count = result.links.size() - before;
        if (count > 255) throw InternalError("more than 255 curve pieces on a face: choose a smaller spacing");
        result.cells[i].link_count[axis] = static_cast<std::uint8_t>(count);
      }
    }
    result.links.shrink_to_fit();
    result.face_points.shrink_to_fit();
  }

 private:
  void trace_face(const CellStore::Place& place, int axis, Brick& result) {
    const SurfaceCell& cell = store_.cell(place);
    if (cell.face[axis] == kFaceEmpty || (cell.divided_faces >> axis & 1)) return;
    const FaceCertificate certificate = certificate_of(place, axis);
    collect_roots(place, axis);
    const CoordPoint lo = lattice_.point(store_.lowest_corner(place));
    CoordPoint hi = lo;
    hi[first_axis(axis)] += lattice_.step * kFinePerCell;
    hi[second_axis(axis)] += lattice_.step * kFinePerCell;
    const FaceCurves& curves = tracer_.trace(axis, lo, hi, certificate, roots_, cell.fold_axes[axis]);
    const auto base = static_cast<std::uint32_t>(result.face_points.size());
    const auto numbered = [&](std::uint32_t v) { return v >= kLocalVertex ? base + v : v; };
    for (const Link& link : curves.links) result.links.push_back({numbered(link.from), numbered(link.to)});
    result.face_points.insert(result.face_points.end(), curves.points.begin(), curves.points.end());
  }

  /// A face without a certificate of its own is single-valued along the axis of the cell below it, if that lies in it.
  FaceCertificate certificate_of(const CellStore::Place& place, int axis) const {
    const SurfaceCell& cell = store_.cell(place);
    if (cell.face[axis] != kFaceUncertified) return cell.face[axis];
    const auto below = store_.find(moved(store_.lowest_corner(place), axis, -kFinePerCell), place.brick);
    if (!below) return kFaceEmpty;
    const SurfaceCell& other = store_.cell(*below);
    if (other.sign == 0 || other.axis == axis) return kFaceUncertified;
    return other.axis == first_axis(axis) ? kFaceAlongFirst : kFaceAlongSecond;
  }

  void move_to(std::uint32_t brick) {
    const FineIndex lo = brick_origin(store_.bricks()[brick].index);
    const std::int64_t size = kBrickCells * kFinePerCell;
    atoms_.move_to(lattice_box(lattice_, lo, {lo[0] + size, lo[1] + size, lo[2] + size}));
    tracer_.take_atoms_from(atoms_);
  }

  void collect_roots(const CellStore::Place& place, int axis) {
    roots_.clear();
    const int a = first_axis(axis), b = second_axis(axis);
    add_roots(place, a, 0);
    const FineIndex lo = store_.lowest_corner(place);
    if (const auto next = store_.find(moved(lo, a, kFinePerCell), place.brick)) add_roots(*next, b, 1);
    if (const auto next = store_.find(moved(lo, b, kFinePerCell), place.brick)) add_roots(*next, a, 2);
    add_roots(place, b, 3);
  }

  void add_roots(const CellStore::Place& place, int axis, int side) {
    const VertexRange roots = store_.edge_roots(place, axis);
    for (std::uint32_t v = roots.first; v < roots.first + roots.count; ++v) {
      roots_.push_back({v, store_.root(v).position, side, store_.rise(v)});
    }
  }

  const Lattice& lattice_;
  const CellStore& store_;
  FaceTracer tracer_;
  LocalAtoms atoms_;   ///< near the brick
  std::vector<FaceRoot> roots_;
};

/// Cells of this level and finer are not split any more for a triangle that is turned against the field: the promise
/// is one of quality, not of topology, and near a singular point it cannot be kept at any size.
constexpr int kFinestForNormals = 5;

/// Gathers the loops of cells and triangulates them. Keeps buffers: one for each thread.
class CellPatcher {
 public:
  CellPatcher(const GaussianField& field, const Lattice& lattice, const CellStore& store, const SplitLattice& split,
              const FoldCellMap& folds, double least_corner_cosine)
      : field_(field),
        lattice_(lattice),
        store_(store),
        folds_(folds),
        points_(store, split),
        least_corner_cosine_(least_corner_cosine),
        collector_(lattice, store, split),
        triangulator_(field),
        fold_triangulator_(field) {}

  using Result = PatchedCells;

  void patch_cell(const CellStore::Place& place, Result& result) {
    const SurfaceCell& cell = store_.cell(place);
    if (cell.split) return;
    patch({store_.lowest_corner(place), 0}, cell.axis, cell.sign, place.brick, result);
  }

  void patch_leaf(const LeafCell& leaf, Result& result) { patch(leaf.key, leaf.axis, leaf.sign, 0, result); }

 private:
  void patch(const CellKey& key, int axis, int sign, std::uint32_t hint, Result& result) {
    const std::span<const Loop> loops = collector_.collect(key, hint);
    if (loops.empty()) return;
    const Patch& patch =
        sign != 0 ? triangulator_.triangulate(lattice_.point(key.lo), lattice_.point(cell_hi(key)), axis, sign, loops)
                  : fold_triangulator_.triangulate(lattice_, folds_.at(key), loops);
    if (!patch.complete || (key.level < kFinestForNormals && is_turned(patch, key))) {
      result.failed.push_back(key);
      return;
    }
    result.fold_cells += sign == 0;
    const auto base = static_cast<std::uint32_t>(result.points.size());
    for (Triangle t : patch.triangles) {
      for (std::uint32_t& v : t) v = v >= kLocalVertex ? v + base : v;
      result.triangles.push_back(t);
    }
    result.points.insert(result.points.end(), patch.points.begin(), patch.points.end());
  }

  static double cosine(const SurfacePoint& p, const SurfacePoint& q) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += double(p.normal[k]) * double(q.normal[k]);
    return sum;
  }

  const SurfacePoint& point(std::uint32_t vertex, const Patch& patch) const {
    return vertex >= kLocalVertex ? patch.points[vertex - kLocalVertex] : points_[vertex];
  }

  /// Whether a triangle is turned against the field at its centroid, or has corners that face too many ways: the cell is
  /// too coarse for the surface.
  bool is_turned(const Patch& patch, const CellKey& key) {
    constexpr double kSuspect = 0.5;  // cosine with the corners' normals above which the centroid is not looked at
    bool atoms_loaded = false;
    for (const Triangle& t : patch.triangles) {
      const SurfacePoint &p = point(t[0], patch), &q = point(t[1], patch), &r = point(t[2], patch);
      if (std::min({cosine(p, q), cosine(q, r), cosine(r, p)}) < least_corner_cosine_) return true;
      if (least_normal_cosine(p, q, r) > kSuspect) continue;
      if (!atoms_loaded) field_.collect_near(cell_box(lattice_, key), atoms_);
      atoms_loaded = true;
      const Vec3 a = to_angstrom(p.position), b = to_angstrom(q.position), c = to_angstrom(r.position);
      Vec3 centroid;
      for (int k = 0; k < 3; ++k) centroid[k] = (a[k] + b[k] + c[k]) / 3.0;
      const auto normal = outward_normal(evaluate(atoms_, field_.decay(), centroid).gradient);
      if (normal_cosine(p, q, r, normal) <= 0.0) return true;
    }
    return false;
  }

  const GaussianField& field_;
  const Lattice& lattice_;
  const CellStore& store_;
  const FoldCellMap& folds_;
  VertexPoints points_;
  double least_corner_cosine_;
  NearAtoms atoms_;
  LoopCollector collector_;
  PatchTriangulator triangulator_;
  FoldTriangulator fold_triangulator_;
};

std::vector<std::uint32_t> flags_of(const Brick& brick) {
  std::vector<std::uint32_t> state;
  state.reserve(brick.cells.size());
  for (const SurfaceCell& cell : brick.cells) {
    std::uint32_t flags = cell.divided_faces;
    for (const std::uint8_t axes : cell.fold_axes) flags = flags << 8 | axes;
    state.push_back(flags);
  }
  return state;
}

}  // namespace

LevelZeroTracer::LevelZeroTracer(const GaussianField& field, const Lattice& lattice, CellStore& store)
    : field_(field), lattice_(lattice), store_(store), traced_(store.bricks().size()) {}

void LevelZeroTracer::trace(std::uint32_t first_vertex, int threads) {
  std::vector<Brick>& bricks = store_.bricks();
  parallel_for_workers(bricks.size(), threads, 1, [&] {
    return [&, tracer = BrickTracer(field_, lattice_, store_)](std::size_t i) mutable {
      std::vector<std::uint32_t> state = flags_of(bricks[i]);
      TracedBrick& traced = traced_[i];
      traced.is_new = !traced.is_done || state != traced.state;
      if (!traced.is_new) return;
      tracer.trace(bricks[i], static_cast<std::uint32_t>(i));
      traced.state = std::move(state);
      traced.is_done = true;
    };
  });
  std::uint32_t next_vertex = first_vertex;
  for (Brick& brick : bricks) {
    brick.first_face_vertex = next_vertex;
    next_vertex += static_cast<std::uint32_t>(brick.face_points.size());
  }
}

bool CellTriangulator::sees_new_faces(const LevelZeroTracer& faces, std::uint32_t brick) const {
  // The faces of a cell are its own low ones and those of the next cell along each axis.
  if (faces.is_new(brick)) return true;
  const BrickIndex index = store_.bricks()[brick].index;
  for (int axis = 0; axis < 3; ++axis) {
    BrickIndex next = index;
    ++next[axis];
    if (const auto b = store_.find_brick(next); b && faces.is_new(*b)) return true;
  }
  return false;
}

void CellTriangulator::renumber_face_points(PatchedCells& cells) const {
  const std::uint32_t first = face_vertices_.front();
  for (Triangle& t : cells.triangles) {
    for (std::uint32_t& v : t) {
      if (v < first || v >= kLocalVertex) continue;
      const auto brick = std::upper_bound(face_vertices_.begin(), face_vertices_.end(), v) - face_vertices_.begin() - 1;
      v += store_.bricks()[brick].first_face_vertex - face_vertices_[brick];
    }
  }
}

PatchOutcome CellTriangulator::triangulate(const SplitLattice& split, const FoldCellMap& folds,
                                           const LevelZeroTracer& faces, int threads) {
  PatchOutcome outcome;
  const std::size_t bricks = store_.bricks().size();
  const bool is_first = patched_.empty();
  const std::vector<bool> is_changed = split.changed_bricks();
  patched_.resize(bricks + split.cells().size());
  parallel_for_workers(patched_.size(), threads, 1, [&] {
    return [&, patcher = CellPatcher(field_, lattice_, store_, split, folds, least_corner_cosine_)](std::size_t task) mutable {
      PatchedCells& result = patched_[task];
      if (task < bricks) {
        const auto brick = static_cast<std::uint32_t>(task);
        const bool is_kept =
            !is_first && result.failed.empty() && !is_changed[brick] && !sees_new_faces(faces, brick);
        if (is_kept) return renumber_face_points(result);
        result = {};
        const auto cells = static_cast<std::uint32_t>(store_.bricks()[brick].cells.size());
        for (std::uint32_t i = 0; i < cells; ++i) patcher.patch_cell({brick, i}, result);
        result.triangles.shrink_to_fit();
      } else {
        // Smaller cells see no vertices inside faces of level 0: theirs keep their numbers.
        const SplitCell& cell = split.cells()[task - bricks];
        if (!is_first && !cell.is_changed) return;
        result = {};
        for (const LeafCell& leaf : cell.leaves) patcher.patch_leaf(leaf, result);
      }
    };
  });
  face_vertices_.clear();
  for (const Brick& brick : store_.bricks()) face_vertices_.push_back(brick.first_face_vertex);
  for (const PatchedCells& cells : patched_) {
    outcome.fold_cells += cells.fold_cells;
    outcome.failed.insert(outcome.failed.end(), cells.failed.begin(), cells.failed.end());
  }
  return outcome;
}

SurfaceMesh CellTriangulator::join(CellStore& store, const SplitLattice& split, int threads) && {
  std::vector<SurfacePoint> face_points;
  for (const Brick& brick : store.bricks()) {
    face_points.insert(face_points.end(), brick.face_points.begin(), brick.face_points.end());
  }
  std::size_t inner_points = 0;
  for (const PatchedCells& cells : patched_) inner_points += cells.points.size();
  SurfaceMesh surface;
  surface.points = store.release_roots();
  surface.points.reserve(surface.points.size() + split.points().size() + face_points.size() + inner_points);
  surface.points.insert(surface.points.end(), split.points().begin(), split.points().end());
  surface.points.insert(surface.points.end(), face_points.begin(), face_points.end());
  std::vector<std::uint32_t> dead_vertices = split.dead_vertices();
  std::sort(dead_vertices.begin(), dead_vertices.end());
  for (std::size_t i = 0; i < dead_vertices.size(); ++i) {
    // The living ones from a dead one to the next move down by as many as are dead before them.
    const auto from = surface.points.begin() + static_cast<std::ptrdiff_t>(dead_vertices[i]) + 1;
    const auto to = i + 1 < dead_vertices.size()
                        ? surface.points.begin() + static_cast<std::ptrdiff_t>(dead_vertices[i + 1])
                        : surface.points.end();
    std::copy(from, to, from - static_cast<std::ptrdiff_t>(i) - 1);
  }
  surface.points.resize(surface.points.size() - dead_vertices.size());
  std::vector<std::size_t> first_triangle{0}, first_point{surface.points.size()};
  for (const PatchedCells& cells : patched_) {
    first_triangle.push_back(first_triangle.back() + cells.triangles.size());
    first_point.push_back(first_point.back() + cells.points.size());
  }
  surface.triangles.resize(first_triangle.back());
  surface.points.resize(first_point.back());
  parallel_for(patched_.size(), threads, [&](std::size_t i) {
    PatchedCells& cells = patched_[i];
    const auto base = static_cast<std::uint32_t>(first_point[i]);
    const auto numbered = [&](std::uint32_t v) {
      if (v >= kLocalVertex) return base + (v - kLocalVertex);
      const auto dead = std::lower_bound(dead_vertices.begin(), dead_vertices.end(), v);
      return v - static_cast<std::uint32_t>(dead - dead_vertices.begin());
    };
    std::size_t at = first_triangle[i];
    for (const Triangle& t : cells.triangles) surface.triangles[at++] = {numbered(t[0]), numbered(t[1]), numbered(t[2])};
    std::copy(cells.points.begin(), cells.points.end(), surface.points.begin() + static_cast<std::ptrdiff_t>(base));
    cells = {};
  });
  return surface;
}

}  // namespace gaussmesh

#include "pipeline/assemble_surface.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/give_back_memory.h"
#include "core/parallel.h"
#include "field/point_value.h"
#include "gaussmesh/error.h"
#include "patch/triangle_shape.h"
#include "pipeline/loop_collector.h"

namespace gaussmesh {
namespace {

/// What is followed on the faces that one brick owns.
struct BrickCurves {
  std::vector<Link> links;
  std::vector<SurfacePoint> points;  ///< inside faces: the vertices of the links from kLocalVertex on
};

/// Follows the curves on the faces that one brick owns.
class BrickTracer {
 public:
  BrickTracer(const GaussianField& field, const Lattice& lattice, const CellStore& store)
      : lattice_(lattice), store_(store), tracer_(field, lattice), atoms_(field) {
    tracer_.set_plain(true);
  }

  /// Counts the links in a brick's cells, and changes nothing that other bricks are traced from.
  BrickCurves trace(Brick& brick, std::uint32_t brick_number) {
    move_to(brick_number);
    BrickCurves result;
    for (std::uint32_t i = 0; i < brick.cells.size(); ++i) {
      brick.cells[i].first_link = small_count<std::uint16_t>(result.links.size(), "curve pieces in a brick");
      find_next({brick_number, i});
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t before = result.links.size();
        trace_face({brick_number, i}, axis, result);
        const std::size_t count = result.links.size() - before;
        brick.cells[i].link_count[axis] = small_count<std::uint8_t>(count, "curve pieces on a face");
      }
    }
    result.links.shrink_to_fit();
    return result;
  }

 private:
  void trace_face(const CellStore::Place& place, int axis, BrickCurves& result) {
    const SurfaceCell& cell = store_.cell(place);
    if (cell.face[axis].certificate == kFaceEmpty || cell.face[axis].is_divided) return;
    const FaceCertificate certificate = certificate_of(place, axis);
    collect_roots(place, axis);
    const CoordPoint lo = lattice_.point(store_.lowest_corner(place));
    CoordPoint hi = lo;
    hi[first_axis(axis)] += lattice_.step * kFinePerCell;
    hi[second_axis(axis)] += lattice_.step * kFinePerCell;
    const FaceCurves& curves = tracer_.trace(axis, lo, hi, certificate, roots_, cell.face[axis].fold_axes);
    const auto base = static_cast<std::uint32_t>(result.points.size());
    const auto numbered = [&](std::uint32_t v) { return v >= kLocalVertex ? base + v : v; };
    for (const Link& link : curves.links) result.links.push_back({numbered(link.from), numbered(link.to)});
    result.points.insert(result.points.end(), curves.points.begin(), curves.points.end());
  }

  /// A face without a certificate of its own is single-valued along the axis of the cell below it, if that lies in
  /// it.
  FaceCertificate certificate_of(const CellStore::Place& place, int axis) const {
    const SurfaceCell& cell = store_.cell(place);
    const FaceCertificate own = cell.face[axis].certificate;
    if (own != kFaceUncertified && own != kFaceNoClosedCurve) return own;
    const auto below = store_.find(moved(store_.lowest_corner(place), axis, -kFinePerCell), place.brick);
    if (!below) return kFaceEmpty;
    const FaceCertificate along = certificate_in_face(store_.cell(*below).single_axes(), axis);
    return along != kFaceUncertified ? along : own;
  }

  void move_to(std::uint32_t brick) {
    const FineIndex lo = brick_origin(store_.bricks()[brick].index);
    const std::int64_t size = kBrickCells * kFinePerCell;
    atoms_.move_to(lattice_box(lattice_, lo, {lo[0] + size, lo[1] + size, lo[2] + size}));
    tracer_.take_atoms_from(atoms_);
  }

  void find_next(const CellStore::Place& place) {
    const FineIndex lo = store_.lowest_corner(place);
    for (int axis = 0; axis < 3; ++axis) next_[axis] = store_.find(moved(lo, axis, kFinePerCell), place.brick);
  }

  void collect_roots(const CellStore::Place& place, int axis) {
    roots_.clear();
    const int a = first_axis(axis), b = second_axis(axis);
    add_roots(place, a, 0);
    if (next_[a]) add_roots(*next_[a], b, 1);
    if (next_[b]) add_roots(*next_[b], a, 2);
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
  LocalAtoms atoms_;                                     ///< near the brick
  std::array<std::optional<CellStore::Place>, 3> next_;  ///< the cells beyond the one at hand, by axis
  std::vector<FaceRoot> roots_;
};

/// Cells of this level and finer are not split any more for a triangle that is turned against the field: the promise
/// is one of quality, not of topology, and near a singular point it cannot be kept at any size.
constexpr int kFinestForNormals = 5;

/// The same where triangles are to be improved. A crack whose mouth larger triangles bridge cannot be opened
/// afterwards, as their parts would be turned too far. A place where sheets nearly touch takes few cells at each level.
constexpr int kFinestForImproving = 10;

/// Where triangles are to be improved, the normal of one is as near as this to the field's at its corners (cosine; 60
/// degrees): what is turned farther is too coarse for the surface, and cannot be mended by moving vertices.
constexpr double kLeastNormalCosine = 0.5;

/// Triangles whose normal is as near as this to the field's at the corners (cosine) bridge nothing.
constexpr double kAlmostFlat = 0.8;

/// Takes over what an earlier call made of cells that have not changed, cell after cell.
class CellCopier {
 public:
  explicit CellCopier(const PatchedCells& from) : from_(from) {}

  void skip() {
    first_point_ += points_of_cell();
    first_triangle_ += from_.counts[cell_++];
  }

  void copy(bool is_fold_cell, PatchedCells& result) {
    const std::uint16_t triangles = from_.counts[cell_];
    const auto shift = static_cast<std::uint32_t>(result.points.size()) - first_point_;
    for (std::uint32_t t = first_triangle_; t < first_triangle_ + triangles; ++t) {
      Triangle triangle = from_.triangles[t];
      for (std::uint32_t& v : triangle) v = v >= kLocalVertex ? v + shift : v;
      result.triangles.push_back(triangle);
    }
    const auto points = from_.points.begin() + first_point_;
    result.points.insert(result.points.end(), points, points + points_of_cell());
    result.counts.push_back(triangles);
    result.fold_cells += is_fold_cell && triangles > 0;
    skip();
  }

 private:
  /// How many vertices inside itself the cell has: each of them is a corner of its triangles.
  std::uint32_t points_of_cell() const {
    std::uint32_t end = kLocalVertex + first_point_;
    for (std::uint32_t t = first_triangle_; t < first_triangle_ + from_.counts[cell_]; ++t) {
      for (const std::uint32_t v : from_.triangles[t]) end = std::max(end, v + 1);
    }
    return end - kLocalVertex - first_point_;
  }

  const PatchedCells& from_;
  std::size_t cell_ = 0;
  std::uint32_t first_triangle_ = 0, first_point_ = 0;
};

/// Gathers the loops of cells and triangulates them. Keeps buffers: one for each thread.
class CellPatcher {
 public:
  CellPatcher(const GaussianField& field, const Lattice& lattice, const CellStore& store, const SplitLattice& split,
              const FoldCellMap& folds, const TracedVertices& vertices, bool for_improvement,
              const FineCells& fine_cells)
      : field_(field),
        lattice_(lattice),
        store_(store),
        folds_(folds),
        vertices_(vertices),
        for_improvement_(for_improvement),
        fine_cells_(fine_cells),
        collector_(lattice, store, split, vertices),
        triangulator_(field),
        fold_triangulator_(field) {}

  using Result = PatchedCells;

  void patch_cell(const CellStore::Place& place, Result& result) {
    const SurfaceCell& cell = store_.cell(place);
    const std::size_t before = result.triangles.size();
    if (!cell.split) patch({store_.lowest_corner(place), 0}, cell.direction, place.brick, 0, result);
    result.counts.push_back(small_count<std::uint16_t>(result.triangles.size() - before, "triangles in a cell"));
  }

  void patch_leaf(const LeafCell& leaf, Result& result) {
    patch(leaf.key, leaf.direction, 0, leaf.empty_faces, result);
  }

 private:
  /// @param hint, empty_faces  as LoopCollector takes them
  void patch(const CellKey& key, const Direction& direction, std::uint32_t hint, unsigned empty_faces, Result& result) {
    const std::span<const Loop> loops = collector_.collect(key, hint, empty_faces);
    if (loops.empty()) return;
    const Patch& patch = direction.sign != 0 ? triangulator_.triangulate(lattice_.point(key.lo),
                                                                         lattice_.point(cell_hi(key)), direction, loops)
                                             : fold_triangulator_.triangulate(lattice_, folds_.at(key), loops);
    if (!patch.complete || fine_cells_.must_be_split(key) ||
        (key.level < finest_for_normals() && is_turned(patch, key))) {
      result.failed.push_back(key);
      return;
    }
    result.fold_cells += direction.sign == 0;
    const auto base = static_cast<std::uint32_t>(result.points.size());
    for (Triangle t : patch.triangles) {
      for (std::uint32_t& v : t) v = v >= kLocalVertex ? v + base : v;
      result.triangles.push_back(t);
    }
    result.points.insert(result.points.end(), patch.points.begin(), patch.points.end());
  }

  int finest_for_normals() const { return for_improvement_ ? kFinestForImproving : kFinestForNormals; }

  const SurfacePoint& point(std::uint32_t vertex, const Patch& patch) const {
    return vertex >= kLocalVertex ? patch.points[vertex - kLocalVertex] : vertices_[vertex];
  }

  /// Whether a triangle is turned against the field at its centroid, or, where triangles are to be improved, is turned
  /// too far at a corner or bridges a ridge: the cell is too coarse for the surface.
  bool is_turned(const Patch& patch, const CellKey& key) {
    constexpr double kSuspect = 0.5;  // cosine with the corners' normals above which the centroid is not looked at
    bool atoms_loaded = false;
    const auto value_at = [&](const Vec3& place) {
      if (!atoms_loaded) field_.collect_near(cell_box(lattice_, key), atoms_);
      atoms_loaded = true;
      return evaluate(atoms_, field_.decay(), place);
    };
    for (const Triangle& t : patch.triangles) {
      const SurfacePoint &p = point(t[0], patch), &q = point(t[1], patch), &r = point(t[2], patch);
      const double turn = least_normal_cosine(p, q, r);
      if (for_improvement_) {
        if (turn < kLeastNormalCosine) return true;
        if (turn < kAlmostFlat && is_bridge(longest_side(p, q, r), key, value_at)) return true;
        continue;  // none is left that would be suspect
      }
      if (turn > kSuspect) continue;
      const Vec3 a = to_angstrom(p.position), b = to_angstrom(q.position), c = to_angstrom(r.position);
      Vec3 centroid;
      for (int k = 0; k < 3; ++k) centroid[k] = (a[k] + b[k] + c[k]) / 3.0;
      if (normal_cosine(p, q, r, outward_normal(value_at(centroid).gradient)) <= 0.0) return true;
    }
    return false;
  }

  /// Whether the surface rises so high over the longest side of a thin triangle, as over a ridge, that its parts are
  /// turned far from the field if it is split there.
  template <typename ValueAt>
  bool is_bridge(const LongestSide& side, const CellKey& key, const ValueAt& value_at) const {
    constexpr double kThin = 0.3;   // height by length
    constexpr double kSteep = 0.7;  // rise by height, which turns the parts by 35 degrees
    constexpr double kHigh = 0.05;  // rise in cells; what rises less is mended afterwards
    if (side.height > kThin * side.length) return false;
    const PointValue value = value_at(side.middle);
    double slope_sq = 0.0;
    for (const double g : value.gradient) slope_sq += g * g;
    const double rise = std::abs(value.value) / std::sqrt(slope_sq);
    return rise > kSteep * side.height && rise > kHigh * to_angstrom(lattice_.step * fine_size(key.level));
  }

  const GaussianField& field_;
  const Lattice& lattice_;
  const CellStore& store_;
  const FoldCellMap& folds_;
  const TracedVertices& vertices_;
  bool for_improvement_;
  const FineCells& fine_cells_;
  NearAtoms atoms_;
  LoopCollector collector_;
  PatchTriangulator triangulator_;
  FoldTriangulator fold_triangulator_;
};

}  // namespace

void trace_bricks(const GaussianField& field, const Lattice& lattice, CellStore& store, TracedVertices& vertices,
                  int threads) {
  std::vector<Brick>& bricks = store.bricks();
  std::vector<BrickCurves> curves(bricks.size());
  parallel_for_workers(bricks.size(), threads, 1, [&] {
    return [&, tracer = BrickTracer(field, lattice, store)](std::size_t i) mutable {
      curves[i] = tracer.trace(bricks[i], static_cast<std::uint32_t>(i));
    };
  });
  std::vector<std::vector<Link>> links;
  links.reserve(bricks.size());
  for (BrickCurves& found : curves) {
    const std::uint32_t first = vertices.add(found.points).first;
    const auto number = [&](std::uint32_t& v) {
      if (v >= kLocalVertex) v = first + (v - kLocalVertex);
    };
    for (Link& link : found.links) {
      number(link.from);
      number(link.to);
    }
    links.push_back(std::move(found.links));
  }
  store.set_links(std::move(links), threads);
}

std::vector<CellKey> CellTriangulator::triangulate(const SplitLattice& split, const FoldCellMap& folds,
                                                   const TracedVertices& vertices, int threads) {
  const std::size_t all_bricks = store_.bricks().size();
  const bool is_first = patched_.empty();
  const std::vector<CellStore::Place> changed = is_first ? std::vector<CellStore::Place>() : split.changed_places();
  patched_.resize(all_bricks + split.cells().size());
  std::vector<std::size_t> tasks;
  if (is_first) {
    tasks.resize(all_bricks);
    std::iota(tasks.begin(), tasks.end(), std::size_t{0});
  } else {
    for (const CellStore::Place& place : changed) {
      if (tasks.empty() || tasks.back() != place.brick) tasks.push_back(place.brick);
    }
  }
  for (const std::uint32_t cell : split.changed_cells()) tasks.push_back(all_bricks + cell);
  parallel_for_workers(tasks.size(), threads, 1, [&] {
    return [&, patcher = CellPatcher(field_, lattice_, store_, split, folds, vertices, for_improvement_, fine_cells_)](
               std::size_t i) mutable {
      PatchedCells result;
      if (tasks[i] < all_bricks) {
        const auto brick = static_cast<std::uint32_t>(tasks[i]);
        const auto cells = static_cast<std::uint32_t>(store_.bricks()[brick].cells.size());
        result.counts.reserve(cells);
        CellCopier before(patched_[tasks[i]]);
        for (std::uint32_t c = 0; c < cells; ++c) {
          const CellStore::Place place{brick, c};
          if (is_first) {
            patcher.patch_cell(place, result);
          } else if (std::binary_search(changed.begin(), changed.end(), place)) {
            patcher.patch_cell(place, result);
            before.skip();
          } else {
            before.copy(store_.cell(place).direction.sign == 0, result);
          }
        }
      } else {
        for (const LeafCell& leaf : split.cells()[tasks[i] - all_bricks].leaves) patcher.patch_leaf(leaf, result);
      }
      result.triangles.shrink_to_fit();
      patched_[tasks[i]] = std::move(result);
    };
  });
  std::vector<CellKey> failed;
  for (const std::size_t task : tasks) {
    failed.insert(failed.end(), patched_[task].failed.begin(), patched_[task].failed.end());
  }
  return failed;
}

std::size_t CellTriangulator::fold_cells() const {
  std::size_t count = 0;
  for (const PatchedCells& cells : patched_) count += cells.fold_cells;
  return count;
}

SurfaceMesh CellTriangulator::join(CellStore& store, TracedVertices& vertices, int threads) && {
  constexpr std::size_t kPointsAtOnce = 65536;
  std::size_t inner_points = 0;
  for (const PatchedCells& cells : patched_) inner_points += cells.points.size();
  std::vector<SurfacePoint> roots = store.release_roots(), added = vertices.release_added();
  give_back_memory();  // the store's cells and links
  std::vector<std::uint32_t> dead_vertices = vertices.dropped();
  std::sort(dead_vertices.begin(), dead_vertices.end());
  // How many vertices are dead before this one, which are as many as it moves down.
  const auto dead_before = [&](std::uint32_t v) {
    return std::lower_bound(dead_vertices.begin(), dead_vertices.end(), v) - dead_vertices.begin();
  };

  const std::size_t traced = roots.size() + added.size(), living = traced - dead_vertices.size();
  SurfaceMesh surface;
  resize_in_parallel(surface.mesh.vertices, living + inner_points, threads);
  resize_in_parallel(surface.normals, living + inner_points, threads);
  const auto put = [&](std::size_t at, const SurfacePoint& p) {
    surface.mesh.vertices[at] = to_angstrom(p.position);
    surface.normals[at] = p.normal;
  };
  parallel_for_chunks(traced, kPointsAtOnce, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    auto dead = static_cast<std::size_t>(dead_before(static_cast<std::uint32_t>(first)));
    for (std::size_t v = first; v < last; ++v) {
      if (dead < dead_vertices.size() && dead_vertices[dead] == v) {
        ++dead;
      } else {
        put(v - dead, v < roots.size() ? roots[v] : added[v - roots.size()]);
      }
    }
  });
  for (auto* points : {&roots, &added}) *points = std::vector<SurfacePoint>();  // before there are triangles
  std::vector<std::size_t> first_triangle{0}, first_point{living};
  for (const PatchedCells& cells : patched_) {
    first_triangle.push_back(first_triangle.back() + cells.triangles.size());
    first_point.push_back(first_point.back() + cells.points.size());
  }
  vertex_number(first_point.back());  // the numbers of all are below
  resize_in_parallel(surface.mesh.triangles, first_triangle.back(), threads);
  parallel_for(patched_.size(), threads, [&](std::size_t i) {
    PatchedCells& cells = patched_[i];
    const auto base = static_cast<std::uint32_t>(first_point[i]);
    const auto numbered = [&](std::uint32_t v) {
      if (v >= kLocalVertex) return base + (v - kLocalVertex);
      return v - static_cast<std::uint32_t>(dead_before(v));
    };
    std::size_t at = first_triangle[i];
    for (const Triangle& t : cells.triangles) {
      surface.mesh.triangles[at++] = {numbered(t[0]), numbered(t[1]), numbered(t[2])};
    }
    for (std::size_t p = 0; p < cells.points.size(); ++p) put(base + p, cells.points[p]);
    cells = {};
  });
  return surface;
}

}  // namespace gaussmesh

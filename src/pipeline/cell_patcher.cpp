#include "pipeline/cell_patcher.h"

#include <cmath>

#include "field/point_value.h"
#include "patch/triangle_shape.h"

namespace gaussmesh {
namespace {

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

Vec3 centroid_of(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r) {
  const Vec3 a = to_angstrom(p.position), b = to_angstrom(q.position), c = to_angstrom(r.position);
  Vec3 centroid;
  for (int k = 0; k < 3; ++k) centroid[k] = (a[k] + b[k] + c[k]) / 3.0;
  return centroid;
}

/// Whether the surface rises so high over the longest side of a thin triangle, as over a ridge, that its parts are
/// turned far from the field if it is split there.
template <typename ValueAt>
bool is_bridge(const LongestSide& side, double cell_size, const ValueAt& value_at) {
  constexpr double kThin = 0.3;   // height by length
  constexpr double kSteep = 0.7;  // rise by height, which turns the parts by 35 degrees
  constexpr double kHigh = 0.05;  // rise in cells; what rises less is mended afterwards
  if (side.height > kThin * side.length) return false;
  const PointValue value = value_at(side.middle);
  double slope_sq = 0.0;
  for (const double g : value.gradient) slope_sq += g * g;
  const double rise = std::abs(value.value) / std::sqrt(slope_sq);
  return rise > kSteep * side.height && rise > kHigh * cell_size;
}

}  // namespace

CellPatcher::CellPatcher(const GaussianField& field, const Lattice& lattice, const TracedCells& cells,
                         const TraceDemands& demands, const FineCells& fine_cells)
    : field_(field),
      lattice_(lattice),
      cells_(cells),
      for_improvement_(demands.for_improvement),
      fine_cells_(fine_cells),
      collector_(lattice, cells.store, cells.split, cells.vertices),
      triangulator_(field),
      fold_triangulator_(field) {}

void CellPatcher::patch_cell(const CellStore::Place& place, PatchedCells& result) {
  const SurfaceCell& cell = cells_.store.cell(place);
  const std::size_t before = result.triangles.size();
  if (!cell.split) patch({cells_.store.lowest_corner(place), 0}, cell.direction, place.brick, 0, result);
  result.counts.push_back(small_count<std::uint16_t>(result.triangles.size() - before, "triangles in a cell"));
}

void CellPatcher::patch_leaf(const LeafCell& leaf, PatchedCells& result) {
  patch(leaf.key, leaf.direction, 0, leaf.empty_faces, result);
}

void CellPatcher::patch(const CellKey& key, const Direction& direction, std::uint32_t hint, unsigned empty_faces,
                        PatchedCells& result) {
  const std::span<const Loop> loops = collector_.collect(key, hint, empty_faces);
  if (loops.empty()) return;
  const Patch& patch = direction.sign != 0 ? triangulator_.triangulate(lattice_.point(key.lo),
                                                                       lattice_.point(cell_hi(key)), direction, loops)
                                           : fold_triangulator_.triangulate(lattice_, cells_.folds.at(key), loops);
  if (!patch.complete || is_too_coarse(patch, key)) {
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

bool CellPatcher::is_too_coarse(const Patch& patch, const CellKey& key) {
  if (fine_cells_.must_be_split(key)) return true;
  const int finest = for_improvement_ ? kFinestForImproving : kFinestForNormals;
  return key.level < finest && is_turned(patch, key);
}

// Whether a triangle is turned against the field at its centroid, or, where triangles are to be improved, is turned
// too far at a corner or bridges a ridge.
bool CellPatcher::is_turned(const Patch& patch, const CellKey& key) {
  constexpr double kSuspect = 0.5;  // cosine with the corners' normals above which the centroid is not looked at
  const double cell_size = to_angstrom(lattice_.step * fine_size(key.level));
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
      if (turn < kAlmostFlat && is_bridge(longest_side(p, q, r), cell_size, value_at)) return true;
      continue;  // none is left that would be suspect
    }
    if (turn > kSuspect) continue;
    if (normal_cosine(p, q, r, outward_normal(value_at(centroid_of(p, q, r)).gradient)) <= 0.0) return true;
  }
  return false;
}

}  // namespace gaussmesh

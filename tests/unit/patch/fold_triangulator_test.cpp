#include "patch/fold_triangulator.h"

#include <bit>

#include "catch2.h"
#include "support/cell_loops.h"
#include "support/fields.h"
#include "support/patch_checks.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

const Lattice kLattice = lattice_of(2.0);
const CellKey kCell{{0, 0, 0}, 0};

/// A place in the cell, in fractions of it.
Vec3 in_cell(double x, double y, double z) {
  const Box box = cell_box(kLattice, kCell);
  return {box.lo[0] + x * (box.hi[0] - box.lo[0]), box.lo[1] + y * (box.hi[1] - box.lo[1]),
          box.lo[2] + z * (box.hi[2] - box.lo[2])};
}

/// One component with all roots on the cell's edges.
FoldCell one_component(const std::vector<Loop>& loops, int chi, std::optional<int> fold_axis) {
  FoldComponent component{chi, static_cast<int>(loops.size()), fold_axis, {}};
  for (const Loop& loop : loops) {
    for (const LoopVertex& v : loop) {
      if (std::popcount(static_cast<unsigned>(v.faces)) == 2) component.roots.push_back(v.point.position);
    }
  }
  return {kCell, {component}};
}

/// Faces are turned away from the middle of a sphere.
void check_outward(const Patch& patch, const std::vector<Loop>& loops, const Vec3& centre) {
  std::map<std::uint32_t, std::uint32_t> number;
  const TriangleMesh mesh = patch_mesh(patch, loops, number);
  for (const Triangle& t : mesh.triangles) {
    const Point &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
    double volume = 0.0;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      volume += (p[k] - centre[k]) * ((q[l] - p[l]) * (r[m] - p[m]) - (q[m] - p[m]) * (r[l] - p[l]));
    }
    CHECK(volume > 0.0);
  }
}

}  // namespace

TEST_CASE("a bit more than an eighth of a sphere, no graph along any axis, is cut along each axis in turn") {
  const Vec3 centre = in_cell(0.12, 0.13, 0.14);
  const std::vector<Atom> atoms = {{centre[0], centre[1], centre[2], 1.5, 0}};
  const GaussianField field(atoms, 0.6, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    const std::vector<Loop> loops = cell_loops(field, kLattice, kCell, 1u << axis);
    REQUIRE(loops.size() == 1);
    int folds = 0;
    for (const LoopVertex& v : loops[0]) {
      if (!(v.point.fold_axes >> axis & 1)) continue;
      ++folds;
      CHECK(to_angstrom(v.point.position[axis]) == Approx(centre[axis]).margin(1e-6));
    }
    CHECK(folds == 2);
    FoldTriangulator triangulator(field);
    const Patch& patch = triangulator.triangulate(kLattice, one_component(loops, 1, axis), loops);
    CHECK(check_patch(patch, loops).chi == 1);
    check_outward(patch, loops, centre);
    for (const SurfacePoint& p : patch.points) {
      const Vec3 at = to_angstrom(p.position);
      CHECK(std::hypot(at[0] - centre[0], at[1] - centre[1], at[2] - centre[2]) == Approx(1.5).margin(2e-9));
    }
  }
}

TEST_CASE("what does not add up to the Euler number and the boundary that were proven is refused") {
  const Vec3 centre = in_cell(0.12, 0.13, 0.14);
  const GaussianField field({{centre[0], centre[1], centre[2], 1.5, 0}}, 0.6, 1.0);
  const std::vector<Loop> loops = cell_loops(field, kLattice, kCell, 1u);
  FoldTriangulator triangulator(field);
  const auto complete = [&](int chi, int boundary_loops) {
    FoldCell cell = one_component(loops, chi, 0);
    cell.components[0].boundary_loops = boundary_loops;
    return triangulator.triangulate(kLattice, cell, loops).complete;
  };
  CHECK(complete(1, 1));
  CHECK_FALSE(complete(0, 1));
  CHECK_FALSE(complete(2, 1));
  CHECK_FALSE(complete(1, 2));
}

TEST_CASE("loops of no component are refused") {
  const Vec3 centre = in_cell(0.12, 0.13, 0.14);
  const GaussianField field({{centre[0], centre[1], centre[2], 1.5, 0}}, 0.6, 1.0);
  const std::vector<Loop> loops = cell_loops(field, kLattice, kCell, 1u);
  FoldTriangulator triangulator(field);
  FoldCell cell = one_component(loops, 1, 0);
  cell.components[0].roots = {{1, 2, 3}};
  CHECK_FALSE(triangulator.triangulate(kLattice, cell, loops).complete);
}

TEST_CASE("a piece without a common fold is triangulated as it is") {
  const Vec3 centre = in_cell(-0.1, -0.1, -0.1);
  const GaussianField field({{centre[0], centre[1], centre[2], 1.8, 0}}, 0.6, 1.0);
  const std::vector<Loop> loops = cell_loops(field, kLattice, kCell);
  REQUIRE(loops.size() == 1);
  FoldTriangulator triangulator(field);
  const Patch& patch = triangulator.triangulate(kLattice, one_component(loops, 1, std::nullopt), loops);
  const PatchFacts facts = check_patch(patch, loops);
  CHECK(facts.chi == 1);
  CHECK(facts.boundary == loops[0].size());
  check_outward(patch, loops, centre);
}

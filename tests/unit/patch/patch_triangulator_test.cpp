#include "patch/patch_triangulator.h"

#include "boxes/cell_prover.h"
#include "catch2.h"
#include "patch/triangle_shape.h"
#include "support/cell_loops.h"
#include "support/fields.h"
#include "support/patch_checks.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

// A cell of 1 A, and a sphere so large that its surface is nearly the plane z = 0.5.
const CoordPoint kLo = {0, 0, 0}, kHi = {1000000000, 1000000000, 1000000000};
const std::vector<Atom> kFlat = {{0.5, 0.5, -999.5, 1000.0, 0}};

/// A loop with corners at the given places, normals up, numbered from `first` on.
Loop loop_of(const std::vector<Vec3>& places, std::uint32_t first) {
  Loop loop;
  for (const Vec3& p : places) {
    const CoordPoint at = to_coord(p);
    loop.push_back({first++, {at, {0, 0, 1}, 0}, faces_of(at, kLo, kHi)});
  }
  return loop;
}

PatchFacts triangulate(const std::vector<Loop>& loops, const Direction& direction = along_axis(2, -1)) {
  const GaussianField field(kFlat, 0.6, 1.0);
  PatchTriangulator triangulator(field);
  const Patch& patch = triangulator.triangulate(kLo, kHi, direction, loops);
  const PatchFacts facts = check_patch(patch, loops);
  std::map<std::uint32_t, std::uint32_t> number;
  const TriangleMesh mesh = patch_mesh(patch, loops, number);
  for (const Triangle& t : mesh.triangles) {
    const Point &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
    const double up = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    CHECK(up > 0.0);
  }
  return facts;
}

const std::vector<Vec3> kSquare = {{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}};

}  // namespace

TEST_CASE("a point lies on the faces whose planes it shares") {
  CHECK(faces_of({0, 5, 5}, kLo, kHi) == 1);
  CHECK(faces_of({kHi[0], 5, 5}, kLo, kHi) == 2);
  CHECK(faces_of({5, 0, kHi[2]}, kLo, kHi) == (4 | 32));
  CHECK(faces_of({5, 5, 5}, kLo, kHi) == 0);
}

TEST_CASE("convex loops on the outline of a cell: n - 2 triangles, no new points") {
  CHECK(triangulate({loop_of(kSquare, 0)}).triangles == 2);
  CHECK(triangulate({loop_of({{0.4, 0, 0.5}, {0, 0.3, 0.5}, {0, 0, 0.6}}, 0)}).triangles == 1);
  const PatchFacts six = triangulate(
      {loop_of({{0.2, 0, 0.5}, {0.7, 0, 0.9}, {1, 0.3, 0.5}, {1, 1, 0.5}, {0.4, 1, 0.5}, {0, 0.6, 0.2}}, 0)});
  CHECK(six.triangles == 4);
  CHECK(six.chi == 1);
}

TEST_CASE("two discs in one cell are triangulated apart") {
  const PatchFacts facts = triangulate({loop_of({{0.4, 0, 0.5}, {0, 0.3, 0.5}, {0, 0, 0.6}}, 0),
                                        loop_of({{0.6, 1, 0.5}, {1, 0.5, 0.5}, {1, 1, 0.6}}, 3)});
  CHECK(facts.triangles == 2);
  CHECK(facts.chi == 2);
}

TEST_CASE("a hole where a curve closes in the upper face is left open") {
  for (const double size : {0.3, 0.05}) {
    // Clockwise seen from above.
    const double a = 0.5 - size, b = 0.5 + size;
    const PatchFacts facts =
        triangulate({loop_of(kSquare, 0), loop_of({{a, a, 1}, {a, b, 1}, {b, b, 1}, {b, a, 1}}, 4)});
    CHECK(facts.triangles == 8);
    CHECK(facts.chi == 0);
    CHECK(facts.boundary == 8);
  }
}

TEST_CASE("a hole in a face is not joined to the corner next to it that is on the same face") {
  const PatchFacts facts =
      triangulate({loop_of({{0.5, 0, 1}, {1, 0.1, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}, {0, 0.1, 0.5}}, 0),
                   loop_of({{0.5, 0.2, 1}, {0.4, 0.4, 1}, {0.6, 0.4, 1}}, 5)});
  CHECK(facts.chi == 0);
}

TEST_CASE("two holes; with a disc beside them nothing tells for certain whose they are") {
  std::vector<Loop> loops = {loop_of({{0, 0, 0.5}, {1, 0, 0.5}, {1, 0.6, 0.5}, {0, 0.6, 0.5}}, 0),
                             loop_of({{0.1, 0.2, 1}, {0.2, 0.4, 1}, {0.3, 0.2, 1}}, 4),
                             loop_of({{0.6, 0.1, 1}, {0.6, 0.3, 1}, {0.8, 0.2, 1}}, 7)};
  CHECK(triangulate(loops).chi == 1 - 2);
  loops.push_back(loop_of({{1, 0.9, 0.5}, {1, 1, 0.5}, {0.5, 1, 0.5}}, 10));
  const GaussianField field(kFlat, 0.6, 1.0);
  CHECK_FALSE(PatchTriangulator(field).triangulate(kLo, kHi, along_axis(2, -1), loops).complete);
}

TEST_CASE("a loop all in one face needs a point inside the cell") {
  // The cap of a sphere above the lower face: chords in that face are not allowed.
  const GaussianField field({{0.5, 0.5, -1.5, 2.0, 0}}, 0.6, 1.0);
  const double radius = std::sqrt(4.0 - 2.25);
  for (const int corners : {3, 4, 5, 8}) {
    CAPTURE(corners);
    std::vector<Vec3> places;
    for (int i = 0; i < corners; ++i) {
      const double angle = 6.283185307179586 * (i + 0.3) / corners;
      places.push_back({0.5 + 0.3 * radius * std::cos(angle), 0.5 + 0.3 * radius * std::sin(angle), 0});
    }
    const std::vector<Loop> loops = {loop_of(places, 0)};
    PatchTriangulator triangulator(field);
    const Patch& patch = triangulator.triangulate(kLo, kHi, along_axis(2, -1), loops);
    const PatchFacts facts = check_patch(patch, loops);
    CHECK(facts.chi == 1);
    REQUIRE(patch.points.size() == 1);
    const Vec3 p = to_angstrom(patch.points[0].position);
    CHECK(std::hypot(p[0] - 0.5, p[1] - 0.5, p[2] + 1.5) == Approx(2.0).margin(2e-9));
  }
}

TEST_CASE("loops that are no boundary of a surface over the square are refused") {
  const GaussianField field(kFlat, 0.6, 1.0);
  PatchTriangulator triangulator(field);
  const auto complete = [&](const std::vector<Loop>& loops) {
    return triangulator.triangulate(kLo, kHi, along_axis(2, -1), loops).complete;
  };
  CHECK(complete({loop_of(kSquare, 0)}));
  CHECK_FALSE(complete({loop_of({{0, 0, 0.5}, {1, 1, 0.5}}, 0)}));                            // two corners
  CHECK_FALSE(complete({loop_of({{0, 0, 0.5}, {0, 1, 0.5}, {1, 1, 0.5}, {1, 0, 0.5}}, 0)}));  // clockwise
  CHECK_FALSE(complete({loop_of(kSquare, 0), loop_of({{0.5, 0.5, 1}, {0.5, 1.5, 1}, {1.5, 0.5, 1}}, 4)}));  // crossing
  CHECK_FALSE(complete({loop_of({{0.1, 0.2, 1}, {0.2, 0.4, 1}, {0.3, 0.2, 1}}, 0)}));  // a hole in nothing
}

TEST_CASE("the same loops along every axis and in both directions") {
  const double r = 1000.0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      CAPTURE(axis, sign);
      Vec3 centre = {0.5, 0.5, 0.5};
      centre[axis] += sign * r;
      const GaussianField field({{centre[0], centre[1], centre[2], r, 0}}, 0.6, 1.0);
      Loop loop;
      for (int i = 0; i < 4; ++i) {
        // Counter-clockwise seen against the axis, so turned round where the solvent is below.
        const int corner = sign < 0 ? i : 3 - i;
        CoordPoint p = kLo;
        p[first_axis(axis)] = corner == 1 || corner == 2 ? kHi[0] : 0;
        p[second_axis(axis)] = corner >= 2 ? kHi[0] : 0;
        p[axis] = 500000000;
        std::array<float, 3> normal{};
        normal[axis] = static_cast<float>(-sign);
        loop.push_back({static_cast<std::uint32_t>(i), {p, normal, 0}, faces_of(p, kLo, kHi)});
      }
      PatchTriangulator triangulator(field);
      const std::vector<Loop> loops = {loop};
      const Patch& patch = triangulator.triangulate(kLo, kHi, along_axis(axis, sign), loops);
      CHECK(check_patch(patch, loops).triangles == 2);
      for (const Triangle& t : patch.triangles) {
        CHECK(normal_cosine(loop[t[0]].point, loop[t[1]].point, loop[t[2]].point, loop[0].point.normal) > 0.99);
      }
    }
  }
}

TEST_CASE("cells of clouds that are single-valued: what the loops enclose is filled, once") {
  const std::uint64_t seed = 72;
  CAPTURE(seed);
  Random random(seed);
  std::size_t patches = 0, refused = 0, several_loops = 0, slanted = 0, with_points = 0;
  for (int cloud = 0; cloud < 250; ++cloud) {
    CAPTURE(cloud);
    const double decay = random.logarithmic(0.3, 6.0);
    const std::vector<Atom> atoms = random_cloud(random, {12, 5.0, 0.7, 2.0, 0.1});
    const GaussianField field(atoms, decay, 1.0);
    const ExactField exact(atoms, decay, 1.0);
    const Lattice lattice = lattice_of(random.logarithmic(0.3, 2.5));
    for (int i = 0; i < 20; ++i) {
      const CellKey key = cell_at(lattice, random_point(random, box_around({0, 0, 0}, 4.0)));
      const Box box = cell_box(lattice, key);
      NearAtoms near;
      field.collect_near(box, near);
      const LocalModel model(near, decay, box);
      const CellCertificate certificate = CellProver(decay).certify(near, model, 3);
      if (certificate.kind != CellCertificate::Kind::kMonotone) continue;
      const std::vector<Loop> loops = cell_loops(field, lattice, key);
      if (loops.empty()) continue;
      PatchTriangulator triangulator(field);
      const Patch& patch =
          triangulator.triangulate(lattice.point(key.lo), lattice.point(cell_hi(key)), certificate.direction, loops);
      if (!patch.complete) {  // the cell would be split
        ++refused;
        continue;
      }
      const PatchFacts facts = check_patch(patch, loops);
      CHECK(facts.chi <= static_cast<int>(loops.size()));
      for (const SurfacePoint& p : patch.points) {
        const Vec3 at = to_angstrom(p.position);
        const auto slope = std::abs(exact.gradient(at)[certificate.direction.axis]);
        CHECK(static_cast<double>(std::abs(exact.psi(at)) / slope) < 2e-9);
        CHECK(faces_of(p.position, lattice.point(key.lo), lattice.point(cell_hi(key))) == 0);
      }
      ++patches;
      slanted += certificate.direction.is_slanted();
      several_loops += loops.size() > 1;
      with_points += !patch.points.empty();
    }
  }
  CHECK(patches > 300);
  CHECK(refused < patches / 50);
  CHECK(several_loops > 20);
  CHECK(slanted > 20);
  CHECK(with_points > 3);
}

#include "gaussmesh/two_sided_distance.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "verify/shapes.h"

using namespace gaussmesh;
using shapes::icosphere;
using shapes::moved;
using shapes::together;

TEST_CASE("centroids and middles of edges are as deep in a sphere as the formulas say") {
  // A regular icosahedron: centroids are at the inradius, middles of edges farther out, and so nearer to the
  // sphere.
  const double radius = 2.0, t = std::numbers::phi;
  const double inradius = radius * t * t / std::sqrt(3.0) / std::sqrt(t * t + 1);
  const double midradius = radius * t / std::sqrt(t * t + 1);
  const TwoSidedDistance found = two_sided_distance(icosphere(0, radius), {{0, 0, 0, radius, 0}}, 1.0, 1.0);
  CHECK(found.samples == 20 + 30);
  CHECK(found.mesh_to_surface == Approx(radius - inradius).margin(1e-5));
  CHECK(found.mean_mesh_to_surface == Approx((20 * (radius - inradius) + 30 * (radius - midradius)) / 50).margin(1e-5));
  CHECK(found.surface_to_mesh == Approx(radius - inradius).margin(1e-5));
}

TEST_CASE("both directions fall with the square of the triangles' size") {
  double last = 1.0;
  for (int level = 1; level < 5; ++level) {
    const TwoSidedDistance found = two_sided_distance(icosphere(level, 2.0), {{0, 0, 0, 2.0, 0}}, 0.6, 1.0);
    CHECK(found.mesh_to_surface < 0.35 * last);
    CHECK(found.surface_to_mesh == Approx(found.mesh_to_surface).epsilon(0.01).margin(1e-5));
    last = found.mesh_to_surface;
  }
}

TEST_CASE("the way back is to the nearest of all triangles, not to the sample's own") {
  // A second, larger sphere: its samples are far from the surface, but their feet are on the first.
  const std::vector<Atom> atoms{{0, 0, 0, 2.0, 0}};
  const TriangleMesh ball = icosphere(4, 2.0);
  const TwoSidedDistance alone = two_sided_distance(ball, atoms, 0.6, 1.0);
  const TwoSidedDistance found = two_sided_distance(together(ball, icosphere(3, 2.2)), atoms, 0.6, 1.0);
  CHECK(found.mesh_to_surface > 0.19);
  CHECK(found.mesh_to_surface < 0.2);
  CHECK(found.surface_to_mesh < 2 * alone.surface_to_mesh);
  const Point& p = found.farthest_of_mesh;
  CHECK(std::hypot(p[0], p[1], p[2]) > 2.19);
}

TEST_CASE("samples without a way to the surface are infinitely far, and there is none back from them") {
  const TwoSidedDistance found = two_sided_distance(icosphere(1, 1.5), {{0, 0, 0, 1.5, 0}}, 0.6, 1e6);
  CHECK(found.mesh_to_surface == std::numeric_limits<double>::infinity());
  CHECK(found.surface_to_mesh == 0.0);
  CHECK(two_sided_distance({}, {{0, 0, 0, 1.5, 0}}, 0.6, 1.0).samples == 0);
  CHECK_THROWS_AS(two_sided_distance({}, {}, 0.6, 1.0), OptionError);
  CHECK_THROWS_AS(two_sided_distance({}, {{0, 0, 0, 1.5, 0}}, -0.6, 1.0), OptionError);
}

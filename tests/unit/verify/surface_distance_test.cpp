#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "catch2.h"
#include "gaussmesh/check_mesh.h"
#include "gaussmesh/error.h"
#include "support/threads.h"
#include "verify/shapes.h"

using namespace gaussmesh;
using shapes::icosphere;
using shapes::moved;
using shapes::together;
using shapes::turned;

namespace {

/// Radius of the surface of one atom.
double sphere_radius(double radius, double decay, double isovalue) {
  return std::sqrt(radius * radius - std::log(isovalue) / decay);
}

/// Atoms of all sizes at random places.
std::vector<Atom> heap(std::mt19937& engine, int count, double box) {
  std::uniform_real_distribution<double> place(-box, box), radius(0, 2);
  std::vector<Atom> atoms;
  for (int i = 0; i < count; ++i) atoms.push_back({place(engine), place(engine), place(engine), radius(engine), 0});
  return atoms;
}

}  // namespace

TEST_CASE("one atom is a sphere") {
  const double decay = 0.7, isovalue = 1.4, offset = 0.125;
  for (const double radius : {0.9, 1.8, 30.0}) {
    const double exact = sphere_radius(radius, decay, isovalue);
    for (const Point& centre : {Point{0, 0, 0}, {100, -200, 300}}) {
      const std::vector<Atom> atoms{{centre[0], centre[1], centre[2], radius, 0}};
      const SurfaceDistance on = distance_to_surface(moved(icosphere(3, exact), centre), atoms, decay, isovalue);
      CHECK(on.max_vertex_distance < 1e-12 * 400);
      CHECK(on.faces_against_gradient == 0);
      const SurfaceDistance off =
          distance_to_surface(moved(icosphere(3, exact + offset), centre), atoms, decay, isovalue);
      CHECK(off.max_vertex_distance == Approx(offset).margin(1e-8));
      CHECK(off.mean_vertex_distance == Approx(offset).margin(1e-8));
      const SurfaceDistance in =
          distance_to_surface(moved(icosphere(3, exact - offset), centre), atoms, decay, isovalue);
      CHECK(in.max_vertex_distance == Approx(offset).margin(1e-8));
    }
  }
}

TEST_CASE("small distances are measured as well as large ones") {
  const double decay = 0.6, isovalue = 1.7;
  const double exact = sphere_radius(1.8, decay, isovalue);
  for (const double offset : {1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    CAPTURE(offset);
    for (const double side : {-1.0, 1.0}) {
      const TriangleMesh mesh = icosphere(3, exact + side * offset);
      const VertexDistance found = vertex_distance_to_surface(mesh, {{0, 0, 0, 1.8, 0}}, decay, isovalue);
      CHECK(found.max == Approx(offset).margin(2e-9));
      CHECK(found.mean == Approx(offset).margin(2e-9));
      CHECK(found.max == distance_to_surface(mesh, {{0, 0, 0, 1.8, 0}}, decay, isovalue).max_vertex_distance);
    }
  }
}

TEST_CASE("next to a saddle point the slope is not taken for the distance") {
  // Two atoms at the isovalue at which their surfaces touch in the origin: phi = 2 exp(-1.25 d) there.
  const double decay = 0.6;
  const std::vector<Atom> atoms{{-1.5, 0, 0, 1, 0}, {1.5, 0, 0, 1, 0}};
  const double isovalue = 2 * std::exp(-1.25 * decay) * (1 + 1e-9);
  // On the axis, beside the saddle: the way to the surface is along the axis, and Newton's method finds it.
  for (const double x : {1e-4, 1e-3, 1e-2}) {
    const auto log_phi = [&](double at) {
      return std::log(std::exp(-decay * ((at + 1.5) * (at + 1.5) - 1)) +
                      std::exp(-decay * ((at - 1.5) * (at - 1.5) - 1)));
    };
    double low = 0.0, high = 0.5;  // phi rises from the saddle to an atom
    for (int i = 0; i < 60; ++i) (log_phi((low + high) / 2) < std::log(isovalue) ? low : high) = (low + high) / 2;
    CAPTURE(x);
    const double found = vertex_distance_to_surface({{{x, 0, 0}}, {}}, atoms, decay, isovalue).max;
    CHECK(found == Approx(std::abs(x - low)).margin(2e-8));
  }
}

TEST_CASE("centroids of flat triangles are inside a sphere") {
  const TriangleMesh mesh = icosphere(0, 2.0);  // a regular icosahedron: all centroids as deep
  const SurfaceDistance found = distance_to_surface(mesh, {{0, 0, 0, 2.0, 0}}, 1.0, 1.0);
  const double t = std::numbers::phi;
  const double inradius = 2.0 * t * t / std::sqrt(3.0) / std::sqrt(t * t + 1);
  CHECK(found.max_centroid_distance == Approx(2.0 - inradius).margin(1e-8));
  CHECK(found.mean_centroid_distance == Approx(2.0 - inradius).margin(1e-8));
}

TEST_CASE("faces turned inwards are against the gradient") {
  const TriangleMesh ball = icosphere(2, 2.0);
  const std::vector<Atom> atoms{{0, 0, 0, 2.0, 0}};
  CHECK(distance_to_surface(turned(ball), atoms, 0.5, 1.0).faces_against_gradient == ball.triangles.size());
  TriangleMesh one_turned = ball;
  std::swap(one_turned.triangles[7][0], one_turned.triangles[7][1]);
  CHECK(distance_to_surface(one_turned, atoms, 0.5, 1.0).faces_against_gradient == 1);
}

TEST_CASE("radii of 1000 A neither overflow nor drown small atoms far away") {
  const double decay = 2.0, isovalue = 1.5;
  const double small = sphere_radius(1.2, decay, isovalue), large = sphere_radius(1000, decay, isovalue);
  const std::vector<Atom> atoms{{0, 0, 0, 1000, 0}, {1e6, 0, 0, 1.2, 0}, {0, 0, -1e6, 1.2, 0}};
  const TriangleMesh mesh = together(together(icosphere(2, large), moved(icosphere(2, small), {1e6, 0, 0})),
                                     moved(icosphere(2, small), {0, 0, -1e6}));
  CHECK(distance_to_surface(mesh, atoms, decay, isovalue).max_vertex_distance < 1e-9);
}

TEST_CASE("atoms that are left out do not count") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  const double decay = 0.5;
  const std::vector<Atom> atoms = heap(engine, 400, 10);
  // A mesh of one vertex, and the level through it by summation over all atoms.
  std::uniform_real_distribution<double> place(-12, 12);
  for (int i = 0; i < 50; ++i) {
    const Point p{place(engine), place(engine), place(engine)};
    double phi = 0.0;
    for (const Atom& a : atoms)
      phi += std::exp(
          -decay * (std::pow(p[0] - a.x, 2) + std::pow(p[1] - a.y, 2) + std::pow(p[2] - a.z, 2) - a.radius * a.radius));
    const SurfaceDistance found = distance_to_surface({{p}, {}}, atoms, decay, phi);
    CHECK(found.max_vertex_distance < 1e-9);
    const SurfaceDistance other = distance_to_surface({{p}, {}}, atoms, decay, phi * 1.000001);
    CHECK(other.max_vertex_distance > 1e-8);
  }
}

TEST_CASE("points far from the surface find it, points without a way to it say so") {
  const std::vector<Atom> atoms{{0, 0, 0, 1.5, 0}};
  const TriangleMesh far{{{5000, 0, 0}}, {}};
  CHECK(distance_to_surface(far, atoms, 0.6, 1.0).max_vertex_distance == Approx(4998.5));
  const TriangleMesh centre{{{0, 0, 0}}, {}};
  CHECK(distance_to_surface(centre, atoms, 0.6, 1.0).max_vertex_distance == std::numeric_limits<double>::infinity());
  const double above_all = 1e6;  // phi is nowhere that large: there is no surface
  CHECK(distance_to_surface(icosphere(1, 1.5), atoms, 0.6, above_all).max_vertex_distance ==
        std::numeric_limits<double>::infinity());
}

TEST_CASE("an empty mesh has no distance, and bad options are refused") {
  const std::vector<Atom> atoms{{0, 0, 0, 1.5, 0}};
  CHECK(distance_to_surface({}, atoms, 0.6, 1.0).max_vertex_distance == 0.0);
  CHECK_THROWS_AS(distance_to_surface({}, atoms, 0.0, 1.0), OptionError);
  CHECK_THROWS_WITH(distance_to_surface({}, atoms, 0.6, -1e-9), "isovalue: expected a number > 0, got '-1e-09'");
  CHECK_THROWS_AS(distance_to_surface({}, atoms, 0.6, std::nan("")), OptionError);
  CHECK_THROWS_AS(distance_to_surface({}, {}, 0.6, 1.0), OptionError);
}

TEST_CASE("distances are the same to the last bit for any number of threads") {
  std::mt19937 engine(3);
  const std::vector<Atom> atoms = heap(engine, 200, 6);
  const TriangleMesh mesh = icosphere(4, 7);
  const auto alone = testing::on_threads(1, [&] { return distance_to_surface(mesh, atoms, 0.6, 1.0); });
  const auto shared = testing::on_threads(3, [&] { return distance_to_surface(mesh, atoms, 0.6, 1.0); });
  CHECK(alone.max_vertex_distance == shared.max_vertex_distance);
  CHECK(alone.mean_vertex_distance == shared.mean_vertex_distance);
  CHECK(alone.mean_centroid_distance == shared.mean_centroid_distance);
  CHECK(alone.faces_against_gradient == shared.faces_against_gradient);
}

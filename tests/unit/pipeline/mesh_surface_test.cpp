#include "gaussmesh/mesh_surface.h"

#include <functional>
#include <limits>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "support/exact_field.h"
#include "support/lattices.h"
#include "support/meshing.h"
#include "support/random.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

const std::vector<Piece> kOneBall = {{0, false}};
const std::vector<Piece> kTwoBalls = {{0, false}, {0, false}};
const std::vector<Piece> kOneTorus = {{1, false}};

double sphere_area(double radius) { return 4.0 * std::numbers::pi * radius * radius; }
double sphere_volume(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

/// phi halfway between two equal atoms: there the surface passes from two components to one.
double value_between(double distance, double radius, double decay) {
  return 2.0 * std::exp(-decay * (0.25 * distance * distance - radius * radius));
}

std::vector<Atom> pair_along(const Vec3& direction, double distance, double radius) {
  const double length = std::hypot(direction[0], direction[1], direction[2]), f = 0.5 * distance / length;
  return {{f * direction[0], f * direction[1], f * direction[2], radius, 0},
          {-f * direction[0], -f * direction[1], -f * direction[2], radius, 0}};
}

void check_good(const MeshResult& result) {
  CHECK(result.report.certified);
  CHECK(result.report.check.fit_for_solver());
  CHECK(result.report.vertex_distance_max < 1e-6);
  CHECK(result.report.isovalue_used == result.report.options.isovalue);
  CHECK(result.normals.size() == result.mesh.vertices.size());
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("one atom is a sphere of radius sqrt(r^2 - ln(c) / d), at every spacing") {
  for (const auto& [decay, isovalue] : {std::pair(0.6, 1.7), std::pair(0.4, 0.8), std::pair(2.0, 1.0)}) {
    const Atom atom{1.1, -2.2, 3.3, 2.0, 0.0};
    const double radius = sphere_radius(atom.radius, decay, isovalue);
    for (const double spacing : {0.2, 0.5, 1.2, 2.5}) {
      CAPTURE(decay, isovalue, spacing);
      const MeshResult result = mesh_surface({atom}, options(decay, isovalue, spacing));
      check_good(result);
      CHECK(topology(result) == kOneBall);
      for (std::size_t i = 0; i < result.mesh.vertices.size(); ++i) {
        const Point& p = result.mesh.vertices[i];
        const double u[3] = {p[0] - atom.x, p[1] - atom.y, p[2] - atom.z};
        CHECK(std::hypot(u[0], u[1], u[2]) == Approx(radius).margin(1e-6));
        for (int k = 0; k < 3; ++k) {
          CHECK(static_cast<double>(result.normals[i][k]) == Approx(u[k] / radius).margin(1e-4));
        }
      }
    }
  }
}

TEST_CASE("area and volume of a sphere converge as the square of the spacing") {
  const double radius = sphere_radius(3.0, 0.6, 1.7);
  double area_error[3], volume_error[3];
  for (int i = 0; i < 3; ++i) {
    const MeshCheck check =
        mesh_surface({{0.1, 0.2, 0.3, 3.0, 0}}, options(0.6, 1.7, std::ldexp(0.8, -i))).report.check;
    area_error[i] = 1.0 - check.area / sphere_area(radius);
    volume_error[i] = 1.0 - check.volume / sphere_volume(radius);
  }
  for (int i = 0; i < 2; ++i) {
    CHECK(area_error[i] / area_error[i + 1] == Approx(4.0).epsilon(0.25));
    CHECK(volume_error[i] / volume_error[i + 1] == Approx(4.0).epsilon(0.25));
  }
  CHECK(area_error[2] > 0.0);
  CHECK(area_error[2] < 0.01);
  CHECK(volume_error[2] < 0.01);
}

TEST_CASE("the number of triangles follows the spacing") {
  const double radius = sphere_radius(4.0, 0.6, 1.7);
  for (const double spacing : {0.25, 0.5, 1.0}) {
    const auto triangles =
        static_cast<double>(mesh_surface({{0, 0, 0, 4.0, 0}}, options(0.6, 1.7, spacing)).mesh.triangles.size());
    const double per_cell_face = triangles * spacing * spacing / sphere_area(radius);
    CHECK(per_cell_face > 1.5);
    CHECK(per_cell_face < 6.0);
  }
}

TEST_CASE("the same atom n times has the surface of one whose radius is larger: r^2 + ln(n) / d") {
  for (const int copies : {2, 3, 50}) {
    const std::vector<Atom> atoms(copies, Atom{0.3, 0.1, -0.2, 1.5, 0});
    const MeshResult result = mesh_surface(atoms, options(0.6, 1.7, 0.4));
    check_good(result);
    CHECK(topology(result) == kOneBall);
    const double radius = std::sqrt(1.5 * 1.5 + std::log(copies / 1.7) / 0.6);
    for (const Point& p : result.mesh.vertices) {
      CHECK(std::hypot(p[0] - 0.3, p[1] - 0.1, p[2] + 0.2) == Approx(radius).margin(1e-6));
    }
  }
}

TEST_CASE("hydrogens of radius 0 count in the field") {
  // Alone, one is a sphere of radius sqrt(-ln(c) / d) where c < 1.
  const MeshResult alone = mesh_surface({{0, 0, 0, 0.0, 0}}, options(0.5, 0.4, 0.3));
  check_good(alone);
  const double radius = std::sqrt(-std::log(0.4) / 0.5);
  for (const Point& p : alone.mesh.vertices) CHECK(std::hypot(p[0], p[1], p[2]) == Approx(radius).margin(1e-6));

  const Atom oxygen{0, 0, 0, 1.5, 0}, hydrogen{0.96, 0, 0, 0.0, 0};
  const MeshResult with = mesh_surface({oxygen, hydrogen}, options(0.6, 1.7, 0.4));
  const MeshResult without = mesh_surface({oxygen}, options(0.6, 1.7, 0.4));
  check_good(with);
  CHECK(with.report.check.volume > 1.05 * without.report.check.volume);
}

TEST_CASE("any order of the atoms and any number of threads give the same mesh to the last bit") {
  const std::uint64_t seed = 81;
  CAPTURE(seed);
  Random random(seed);
  std::vector<Atom> atoms = random_cloud(random, {60, 10.0, 0.8, 2.0, 0.2});
  atoms.push_back(atoms[3]);
  for (const double spacing : {0.4, 1.5}) {  // the second needs fold curves and split cells
    const MeshResult first = mesh_surface(atoms, options(0.6, 1.3, spacing, 1));
    check_good(first);
    for (const int threads : {1, 2, 5}) {
      random.shuffle(atoms);
      const MeshResult other = mesh_surface(atoms, options(0.6, 1.3, spacing, threads));
      CHECK(other.mesh.vertices == first.mesh.vertices);
      CHECK(other.mesh.triangles == first.mesh.triangles);
      CHECK(other.normals == first.normals);
    }
  }
}

TEST_CASE("moving the molecule by whole bricks of the lattice moves the mesh and changes no triangle") {
  const std::uint64_t seed = 82;
  CAPTURE(seed);
  Random random(seed);
  const std::vector<Atom> atoms = random_cloud(random, {20, 6.0, 0.8, 2.0, 0.2});
  const double brick = 8.0 * lattice_of(0.7).cell_size();
  const MeshResult first = mesh_surface(atoms, options(0.6, 1.3, 0.7));
  const Vec3 shift = {2.0 * brick, -3.0 * brick, brick};
  std::vector<Atom> moved = atoms;
  for (Atom& a : moved) a.x += shift[0], a.y += shift[1], a.z += shift[2];
  const MeshResult second = mesh_surface(moved, options(0.6, 1.3, 0.7));
  REQUIRE(second.mesh.triangles == first.mesh.triangles);
  double farthest = 0.0;
  for (std::size_t i = 0; i < first.mesh.vertices.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      farthest = std::max(farthest, std::abs(second.mesh.vertices[i][k] - first.mesh.vertices[i][k] - shift[k]));
    }
  }
  CHECK(farthest < 3e-9);
}

TEST_CASE("coordinates are whole numbers of 1e-9 A") {
  const MeshResult result = mesh_surface({{0, 0, 0, 2.0, 0}, {1e4, -1e5, 1e6, 2.0, 0}}, options(0.6, 1.7, 0.5));
  check_good(result);
  for (const Point& p : result.mesh.vertices) {
    for (const double x : p) CHECK(to_angstrom(to_coord(x)) == x);
  }
}

TEST_CASE("two atoms 10^6 A apart are two spheres, and cost what two spheres cost") {
  const MeshResult one = mesh_surface({{0, 0, 0, 2.0, 0}}, options(0.6, 1.7, 0.5));
  const MeshResult two = mesh_surface({{0, 0, 0, 2.0, 0}, {1e6, 1e6, 1e6, 2.0, 0}}, options(0.6, 1.7, 0.5));
  check_good(two);
  CHECK(topology(two) == kTwoBalls);
  CHECK(static_cast<double>(two.report.cells) < 2.2 * static_cast<double>(one.report.cells));
  CHECK(two.report.check.volume == Approx(2.0 * one.report.check.volume).epsilon(0.02));
}

TEST_CASE("two atoms drawn together: two components up to the critical level, one from there on") {
  const double decay = 0.6, r = 1.5;
  for (const Vec3& direction : {Vec3{0, 1, 0}, Vec3{1, -2, 3}}) {
    for (const double distance : {3.2, 4.5}) {
      const double critical = value_between(distance, r, decay);
      for (const double change : {1e-3, 1e-6}) {
        for (const double spacing : {0.5, 1.3}) {
          CAPTURE(distance, change, spacing);
          const auto atoms = pair_along(direction, distance, r);
          CHECK(topology(mesh_surface(atoms, options(decay, critical * (1.0 - change), spacing))) == kOneBall);
          CHECK(topology(mesh_surface(atoms, options(decay, critical * (1.0 + change), spacing))) == kTwoBalls);
        }
      }
    }
  }
}

TEST_CASE("the critical distance of two atoms is where value_between is c") {
  const double decay = 0.5, r = 1.7, isovalue = 1.1;
  const double critical = 2.0 * std::sqrt(r * r - std::log(0.5 * isovalue) / decay);
  CHECK(topology(mesh_surface(pair_along({0, 0, 1}, critical - 1e-5, r), options(decay, isovalue, 0.8))) == kOneBall);
  CHECK(topology(mesh_surface(pair_along({0, 0, 1}, critical + 1e-5, r), options(decay, isovalue, 0.8))) == kTwoBalls);
}

TEST_CASE("a ring of atoms is a torus, lying, standing and seen edge-on") {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double spacing : {0.2, 0.5, 1.2, 2.5}) {
      CAPTURE(axis, spacing);
      const MeshResult result = mesh_surface(atom_ring(12, 3.0, 1.5, axis), options(1.0, 1.0, spacing));
      check_good(result);
      CHECK(topology(result) == kOneTorus);
      if (spacing > 2.0) CHECK(result.report.cells_cut_by_folds > 0);
    }
  }
}

TEST_CASE("a tunnel or a dimple, as c is above or below phi in the middle of a ring") {
  std::size_t cut = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto atoms = atom_ring(8, 2.0, 1.6, axis);
    const double middle = 8.0 * std::exp(-(2.0 * 2.0 - 1.6 * 1.6));
    for (const double change : {0.1, 1e-2, 1e-4}) {
      for (const double spacing : {0.5, 1.2, 2.5}) {
        CAPTURE(axis, change, spacing);
        const MeshResult tunnel = mesh_surface(atoms, options(1.0, middle * (1.0 + change), spacing));
        check_good(tunnel);
        CHECK(topology(tunnel) == kOneTorus);
        const MeshResult dimple = mesh_surface(atoms, options(1.0, middle * (1.0 - change), spacing));
        check_good(dimple);
        CHECK(topology(dimple) == kOneBall);
        cut += tunnel.report.cells_cut_by_folds + dimple.report.cells_cut_by_folds;
      }
    }
  }
  CHECK(cut > 20);
}

TEST_CASE("a neck between two atoms keeps them together at every spacing; folds cut cells there") {
  const double decay = 0.6, r = 1.9, distance = 3.8;
  std::size_t cut = 0;
  for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{1, 1, 1}, Vec3{1, -2, 0.5}}) {
    for (const double share : {0.9, 0.99, 0.999}) {
      for (const double spacing : {0.2, 0.5, 1.2, 2.5}) {
        CAPTURE(share, spacing);
        const double isovalue = share * value_between(distance, r, decay);
        const MeshResult result = mesh_surface(pair_along(direction, distance, r), options(decay, isovalue, spacing));
        check_good(result);
        CHECK(topology(result) == kOneBall);
        cut += result.report.cells_cut_by_folds;
      }
    }
  }
  CHECK(cut > 0);
}

TEST_CASE("a hollow shell of atoms has a cavity of negative volume") {
  const auto shell = atom_shell(80, 6.0, 1.7);
  for (const double spacing : {0.5, 1.2, 2.5}) {
    CAPTURE(spacing);
    const MeshResult result = mesh_surface(shell, options(0.6, 1.2, spacing));
    check_good(result);
    CHECK(topology(result) == std::vector<Piece>{{0, false}, {0, true}});
    const MeshComponent& cavity = result.report.check.components[1];
    CHECK(cavity.volume < -50.0);
    CHECK(cavity.depth == 1);
    CHECK(result.report.check.volume < result.report.check.components[0].volume);
  }
}

TEST_CASE("nested: a shell in a shell round an atom, five components") {
  std::vector<Atom> atoms = atom_shell(80, 6.0, 1.7);
  for (const Atom& a : atom_shell(500, 15.0, 1.7)) atoms.push_back(a);
  atoms.push_back({0, 0, 0, 1.5, 0});
  for (const double spacing : {0.9, 2.5}) {
    CAPTURE(spacing);
    const MeshResult result = mesh_surface(atoms, options(0.6, 1.2, spacing));
    check_good(result);
    CHECK(topology(result) == std::vector<Piece>{{0, false}, {0, false}, {0, false}, {0, true}, {0, true}});
    std::size_t deepest = 0;
    for (const MeshComponent& c : result.report.check.components) deepest = std::max(deepest, c.depth);
    CHECK(deepest == 4);
  }
}

TEST_CASE("atoms with one centre and different radii are one sphere") {
  const std::vector<Atom> atoms = {{0, 0, 0, 1.0, 0}, {0, 0, 0, 2.0, 0}, {0, 0, 0, 0.0, 0}};
  const MeshResult result = mesh_surface(atoms, options(0.6, 1.7, 0.5));
  check_good(result);
  const double sum = std::exp(0.6) + std::exp(2.4) + 1.0, radius = std::sqrt(std::log(sum / 1.7) / 0.6);
  for (const Point& p : result.mesh.vertices) CHECK(std::hypot(p[0], p[1], p[2]) == Approx(radius).margin(1e-6));
}

TEST_CASE("c at a critical value is refused, with the place and the value") {
  const double decay = 0.6, r = 1.5, distance = 3.6, critical = value_between(distance, r, decay);
  auto atoms = pair_along({1, 2, 3}, distance, r);
  for (Atom& a : atoms) a.x += 7.25, a.y -= 3.5, a.z += 1.125;
  for (const double spacing : {0.3, 0.5, 1.2}) {
    CAPTURE(spacing);
    MeshOptions o = options(decay, critical, spacing);
    CHECK_THROWS_AS(mesh_surface(atoms, o), CannotMeshError);
    const std::string message = message_of([&] { mesh_surface(atoms, o); });
    CHECK_THAT(message, Catch::Matchers::ContainsSubstring("critical value"));
    CHECK_THAT(message, Catch::Matchers::ContainsSubstring("7.25"));
    CHECK_THAT(message, Catch::Matchers::ContainsSubstring("-3.5"));
    CHECK_THAT(message, Catch::Matchers::ContainsSubstring("1.125"));

    o.allow_uncertified = true;
    const MeshResult result = mesh_surface(atoms, o);
    CHECK_FALSE(result.report.certified);
    CHECK(result.report.check.fit_for_solver());
    CHECK(result.report.isovalue_used != critical);
    CHECK(result.report.isovalue_used == Approx(critical).epsilon(1e-3));
    CHECK(result.report.vertex_distance_max < 1e-6);
    REQUIRE(result.report.critical.size() == 1);
    const CriticalPlace& place = result.report.critical[0];
    CHECK(place.value == Approx(critical).epsilon(1e-9));
    CHECK(std::hypot(place.point[0] - 7.25, place.point[1] + 3.5, place.point[2] - 1.125) < 1e-6);
  }
}

TEST_CASE("c within 1e-10 of a critical value is meshed, or refused with the place and the value") {
  // Random clouds, levels next to saddles: roots 1e-8 A apart and slopes of 1e-5 are the rule near the place.
  struct NearSaddle {
    double decay, isovalue, critical;
    Vec3 place;
    std::vector<Atom> atoms;
  };
  const NearSaddle samples[] = {
      {0.27689795718742721,
       6.7581978983913968,
       6.75819789913789,
       {1.6302978, 2.0083054, 1.4994598},
       {{2.3638733834608252, 2.0901444629338957, 2.573597397443582, 1.7565481192787282, 0},
        {2.4952958270222698, 1.8761015042790208, 0.88758450953714296, 1.1687236604320468, 0},
        {1.0971812224499944, 1.9205581162432697, 0.87097507920292794, 1.9258833780282893, 0},
        {1.6991788152161313, 1.741380218338942, 2.7911471661690954, 1.4568539035162256, 0},
        {0.58417445259316192, 2.6528044658676531, 0.37227311766544143, 1.4149605624544768, 0}}},
      {0.36429720225805856,
       6.7221756429671276,
       6.72217564304632,
       {1.7425942, 1.3171846, 1.7908248},
       {{0.82166788568839311, 1.0579443205175181, 3.4372486879688857, 0.98022160053394636, 0},
        {1.7744947320524211, 2.2853556423262864, 1.2199564450062377, 0.81944277570537127, 0},
        {1.981906963532972, 1.2800087903231661, 1.6841913533736912, 2.0428799284014003, 0},
        {1.9604247553525052, 1.2537563512505381, 3.4740479515509248, 0.84605731933638151, 0},
        {0.39477512477252497, 0.53767485839875218, 1.0680201904508839, 1.2875428795886374, 0}}}};
  int refused = 0;
  for (const NearSaddle& sample : samples) {
    for (const double spacing : {0.28227594124105793, 0.3, 0.8, 0.82447099079995967, 1.8135531565481076}) {
      CAPTURE(sample.decay, spacing);
      try {
        check_good(mesh_surface(sample.atoms, options(sample.decay, sample.isovalue, spacing)));
      } catch (const CannotMeshError& error) {
        CHECK_THAT(error.what(), Catch::Matchers::ContainsSubstring("critical value"));
        MeshOptions o = options(sample.decay, sample.isovalue, spacing);
        o.allow_uncertified = true;
        const MeshResult result = mesh_surface(sample.atoms, o);
        REQUIRE(result.report.critical.size() == 1);
        const CriticalPlace& found = result.report.critical[0];
        CHECK(found.value == Approx(sample.critical).epsilon(1e-9));
        for (int k = 0; k < 3; ++k) CHECK(found.point[k] == Approx(sample.place[k]).margin(1e-6));
        ++refused;
      }
    }
  }
  CHECK(refused > 0);
}

TEST_CASE("the message names a critical point to 1e-6 A, a zero as zero") {
  const double decay = 0.6, r = 1.5, distance = 3.6;
  const auto atoms = pair_along({0, 1, 3}, distance, r);
  const MeshOptions o = options(decay, value_between(distance, r, decay), 0.5);
  CHECK_THAT(message_of([&] { mesh_surface(atoms, o); }),
             Catch::Matchers::ContainsSubstring("at (0, 0, 0) the surface"));
}

TEST_CASE("the crease between spheres of 1000 and 586 A is meshed with cells of 79 A") {
  // The normals turn within 0.001 A: cells are split at the crease, and their neighbours after them, round by round.
  check_good(mesh_surface({{1998.0942586480826, -265.09049091628964, -43.799361945600928, 1000, 0},
                           {552.97994221284409, 121.87264484370114, 4.8664311444222959, 585.89050206372247, 0},
                           {494.94123963770119, 102.78009344559813, 40.932930801178628, 60.000639993914987, 0}},
                          options(0.49728125911820098, 1.9899949930991561, 79.45713612555403)));
}

TEST_CASE("a maximum at c, a surface that is one point, is no surface that can be certified") {
  CHECK_THROWS_AS(mesh_surface({{0, 0, 0, 1.5, 0}}, options(0.6, std::exp(0.6 * 2.25), 0.5)), CannotMeshError);
}

TEST_CASE("phi below c everywhere: nothing to mesh, and that is said") {
  const double highest = std::exp(0.6 * 2.25);  // of one atom, at its centre
  CHECK_THROWS_AS(mesh_surface({{0, 0, 0, 1.5, 0}}, options(0.6, 1.001 * highest, 0.5)), CannotMeshError);
  CHECK_THAT(message_of([&] {
               mesh_surface({{0, 0, 0, 1.5, 0}}, options(0.6, 1.001 * highest, 0.5));
             }),
             Catch::Matchers::ContainsSubstring("nothing to mesh"));
  // As where all radii of a file are 0, whatever its atoms are.
  CHECK_THAT(message_of([&] {
               mesh_surface({{0, 0, 0, 0.25, 0}, {9, 0, 0, 0, 0}}, options(0.6, 1.7, 0.5));
             }),
             Catch::Matchers::ContainsSubstring("everywhere, with radii of 0.25 A at most; choose a smaller c"));
  CHECK_THAT(message_of([&] {
               mesh_surface({{0, 0, 0, 1.5, 0}}, options(0.6, 1e9, 0.5));
             }),
             Catch::Matchers::ContainsSubstring("nothing to mesh"));
  // A sphere much smaller than a cell is not nothing.
  const MeshResult small = mesh_surface({{0, 0, 0, 1.5, 0}}, options(0.6, 0.9999 * highest, 2.0));
  check_good(small);
  CHECK(topology(small) == kOneBall);
  const double radius = sphere_radius(1.5, 0.6, 0.9999 * highest);
  for (const Point& p : small.mesh.vertices) CHECK(std::hypot(p[0], p[1], p[2]) == Approx(radius).margin(1e-6));
}

TEST_CASE("options out of their range are refused by name") {
  const std::vector<Atom> atoms = {{0, 0, 0, 1.5, 0}};
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto refused = [&](double MeshOptions::*member, double value, const std::string& name) {
    MeshOptions o;
    o.*member = value;
    CHECK_THROWS_AS(mesh_surface(atoms, o), OptionError);
    CHECK_THAT(message_of([&] { mesh_surface(atoms, o); }), Catch::Matchers::ContainsSubstring(name));
  };
  for (const double bad : {0.0, -1.0, nan, infinity, 1e-12, 1e12}) {
    CAPTURE(bad);
    refused(&MeshOptions::decay, bad, "decay");
    refused(&MeshOptions::isovalue, bad, "isovalue");
    refused(&MeshOptions::spacing, bad, "spacing");
  }
  for (const double bad : {-1.0, nan, infinity, 1e-12, 1e12}) refused(&MeshOptions::tolerance, bad, "tolerance");
  MeshOptions o;
  o.threads = -1;
  CHECK_THROWS_AS(mesh_surface(atoms, o), OptionError);
}

TEST_CASE("atoms that cannot be are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(mesh_surface({}, {}), InputError);
  for (const Atom& atom : {Atom{0, 0, 0, -1.0, 0}, Atom{0, 0, 0, nan, 0}, Atom{0, 0, 0, infinity, 0},
                           Atom{nan, 0, 0, 1, 0}, Atom{0, nan, 0, 1, 0}, Atom{0, 0, nan, 1, 0},
                           Atom{0, infinity, 0, 1, 0}, Atom{0, 0, 2e6, 1, 0}, Atom{0, 0, 0, 2e5, 0}}) {
    CHECK_THROWS_AS(mesh_surface({{0, 0, 0, 1.5, 0}, atom}, {}), InputError);
  }
}

TEST_CASE("a radius of 35 A and one of 1000 A overflow nothing") {
  for (const auto& [r, spacing] : {std::pair(35.0, 2.0), std::pair(1000.0, 50.0)}) {
    for (const double decay : {0.4, 2.0}) {
      CAPTURE(r, spacing, decay);
      const MeshResult result = mesh_surface({{1, 2, 3, r, 0}}, options(decay, 1.7, spacing));
      check_good(result);
      CHECK(topology(result) == kOneBall);
      const double radius = sphere_radius(r, decay, 1.7);
      CHECK(result.report.check.area == Approx(sphere_area(radius)).epsilon(0.01));
      CHECK(result.report.check.volume == Approx(sphere_volume(radius)).epsilon(0.01));
    }
  }
}

TEST_CASE("the report says what was done") {
  const std::vector<Atom> atoms = atom_ring(12, 3.0, 1.5);
  const MeshReport report = mesh_surface(atoms, options(1.0, 1.0, 2.5)).report;
  CHECK(report.atoms == 12);
  CHECK(report.options.spacing == 2.5);
  CHECK(report.cells > 0);
  REQUIRE_FALSE(report.boxes.empty());
  double size = 1e9;
  for (const BoxCount& boxes : report.boxes) {
    CHECK(boxes.size < size);
    CHECK(boxes.boxes > 0);
    size = boxes.size;
  }
  CHECK(report.smallest_box > 0.0);
  CHECK(report.smallest_box <= 2.5);
  CHECK(report.critical.empty());
  REQUIRE_FALSE(report.stages.empty());
  for (const StageCost& stage : report.stages) {
    CHECK_FALSE(stage.name.empty());
    CHECK(stage.time_s >= 0.0);
    CHECK(stage.peak_memory_MB > 0.0);
  }
}

TEST_CASE("a mesh that takes more memory than there is is not begun, one that takes less is") {
  const std::vector<Atom> sphere = {{0, 0, 0, 10.0, 0}};
  for (const bool improve : {true, false}) {
    CAPTURE(improve);
    MeshOptions options;
    options.decay = options.isovalue = 1.0;
    options.improve = improve;
    options.memory_bytes = 5e5;  // some 12,000 triangles of 60 or 100 bytes
    CHECK_THROWS_WITH(mesh_surface(sphere, options),
                      Catch::Matchers::ContainsSubstring("of memory, and there are 0.0005 GB"));
    options.memory_bytes = 5e6;
    CHECK(mesh_surface(sphere, options).report.check.components.size() == 1);
  }
}

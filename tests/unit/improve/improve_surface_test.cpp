// What the improved mesh promises: shapes, sizes, turns, and everything that the traced mesh promised.
#include "improve/improve_surface.h"

#include <filesystem>
#include <map>

#include "catch2.h"
#include "core/vectors.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_atoms.h"
#include "support/meshing.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

std::vector<Atom> molecule(const char* name) {
  return read_atoms(std::filesystem::path(GAUSSMESH_DATA) / (std::string(name) + ".pqr")).atoms;
}

Vec3 normal_of(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 n = cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
  return 1.0 / length(n) * n;
}

/// Edges whose two triangles turn against each other by more than an angle of the given cosine.
std::size_t sharp_edges(const TriangleMesh& mesh, double cosine) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> triangle_at;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) triangle_at[{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}] = t;
  }
  std::size_t count = 0;
  for (const auto& [edge, t] : triangle_at) {
    const std::uint32_t other = triangle_at.at({edge.second, edge.first});
    if (t < other) count += dot(normal_of(mesh, mesh.triangles[t]), normal_of(mesh, mesh.triangles[other])) < cosine;
  }
  return count;
}

}  // namespace

TEST_CASE("triangles of molecules are nearly equilateral and of the size that was asked for") {
  for (const char* name : {"1a1p", "1l2y", "2y29_wat"}) {
    const std::vector<Atom> atoms = molecule(name);
    for (const double spacing : {0.3, 0.5}) {
      CAPTURE(name, spacing);
      const MeshResult result = mesh_surface(atoms, improved(0.6, 1.7, spacing));
      const MeshCheck& check = result.report.check;
      CHECK(check.fit_for_solver());
      CHECK(topology(result) == topology(mesh_surface(atoms, options(0.6, 1.7, spacing))));
      CHECK(check.min_angle_deg > 30.0);
      CHECK(check.max_angle_deg < 120.0);
      CHECK(check.mean_min_angle_deg > 51.0);
      CHECK(check.mean_edge_ratio > 0.85);
      CHECK(check.mean_edge == Approx(spacing).epsilon(0.1));
      CHECK(check.max_edge < 2.0 * spacing);
      CHECK(result.report.vertex_distance_max < 1e-6);
      CHECK(sharp_edges(result.mesh, 0.5) == 0);
    }
  }
}

TEST_CASE("creases and rims much narrower than the spacing get triangles as good") {
  const MeshResult result = mesh_surface(molecule("1l2y"), improved(2.0, 1.0, 0.8));
  CHECK(result.report.check.fit_for_solver());
  CHECK(result.report.check.min_angle_deg > 30.0);
  CHECK(sharp_edges(result.mesh, 0.5) == 0);
}

TEST_CASE("cracks and ridges that a traced triangle would bridge get triangles as good") {
  const std::vector<Atom> three{{2.32, 3.44, 1.88, 1.44, 0}, {1.0, 0.84, 0.11, 1.92, 0}, {3.44, 2.18, 1.25, 1.31, 0}};
  const MeshResult few = mesh_surface(three, improved(8.0, 1.0, 1.5));
  CHECK(few.report.check.min_angle_deg > 30.0);
  const MeshResult many = mesh_surface(molecule("1a1p"), improved(10.0, 1.0, 1.0));
  CHECK(many.report.check.fit_for_solver());
  CHECK(many.report.check.min_angle_deg > 30.0);
}

TEST_CASE("a neck much narrower than the spacing gets triangles of its own size") {
  // c just below the saddle between two atoms: necks down to 0.0005 A.
  const double d = 0.6, r = 1.6, half = 1.7;
  const double saddle = 2.0 * std::exp(-d * (half * half - r * r));
  const std::vector<Atom> atoms{{-half, 0.1, 0.2, r, 0}, {half, 0.1, 0.2, r, 0}};
  for (const double below : {1e-3, 1e-5, 1e-7}) {
    CAPTURE(below);
    const MeshResult result = mesh_surface(atoms, improved(d, saddle * (1.0 - below), 0.6));
    const double neck = std::sqrt(below / d);  // phi / c = (1 + below) exp(-d x^2) across it
    CHECK(topology(result) == std::vector<Piece>{{0, false}});
    CHECK(result.report.check.min_angle_deg > 30.0);
    CHECK(result.report.check.min_edge > 0.2 * neck);
    CHECK(result.report.check.min_edge < 2.0 * neck);
    CHECK(result.report.check.triangles < 3200);  // 1060 to 2800
    CHECK(sharp_edges(result.mesh, 0.5) == 0);
  }
}

TEST_CASE("the sphere of one atom, up to triangles as large as itself") {
  const std::vector<Atom> atoms{{0.1, 0.2, 0.3, 1.5, 0}};
  for (const double spacing : {0.1, 0.5, 1.0, 3.0}) {
    CAPTURE(spacing);
    const MeshResult result = mesh_surface(atoms, improved(0.6, 1.7, spacing));
    CHECK(topology(result) == std::vector<Piece>{{0, false}});
    CHECK(result.report.check.min_angle_deg > 30.0);
    CHECK(sharp_edges(result.mesh, 0.5) == 0);
  }
}

TEST_CASE("a tolerance makes smaller triangles, until they are as near to the surface as that") {
  const std::vector<Atom> atoms = molecule("2y29_wat");
  MeshOptions o = improved(0.6, 1.7, 0.8);
  o.measure_distance = true;
  const MeshResult coarse = mesh_surface(atoms, o);
  o.tolerance = 0.02;
  const MeshResult fine = mesh_surface(atoms, o);
  CHECK(fine.mesh.triangles.size() > coarse.mesh.triangles.size());
  CHECK(coarse.report.surface_distance.value() > 0.03);
  CHECK(fine.report.surface_distance.value() <= 0.02);
  CHECK(distance_to_surface(fine.mesh, atoms, 0.6, 1.7).max_centroid_distance <= 0.02);
  CHECK(fine.report.check.fit_for_solver());
  o.improve = false;
  CHECK_THROWS_AS(mesh_surface(atoms, o), OptionError);
}

TEST_CASE("where a mesh takes several attempts, its boxes are those of the last one") {
  MeshOptions o = improved(2.0, 1.0, 0.8);
  o.tolerance = 0.05;
  int attempts = 0;
  o.on_stage_end = [&](const std::string& stage) { attempts += stage == "improve"; };
  const std::vector<BoxCount> boxes = mesh_surface(molecule("1a1p"), o).report.boxes;
  REQUIRE(attempts > 1);
  REQUIRE(!boxes.empty());
  for (std::size_t i = 1; i < boxes.size(); ++i) CHECK(boxes[i].size == 0.5 * boxes[i - 1].size);
}

TEST_CASE("a stage's caller can end the work, also where a finer trace is made that may fail") {
  const std::vector<Atom> crease{{0, 0, 0, 40.0, 0}, {50.0, 0, 0, 40.0, 0}};
  MeshOptions o = improved(0.6, 1.7, 5.0);
  int traces = 0;
  o.on_stage_end = [&](const std::string& stage) {
    traces += stage == "boxes and roots";
    if (traces == 2) throw std::runtime_error("enough");
  };
  CHECK_THROWS_WITH(mesh_surface(crease, o), "enough");
  CHECK(traces == 2);
}

TEST_CASE("exact signs everywhere give as good a mesh as near close sheets only") {
  const std::vector<Atom> atoms = molecule("2y29_wat");
  const MeshResult traced = mesh_surface(atoms, options(0.6, 1.7, 0.5));
  const GaussianField field(atoms, 0.6, 1.7);
  SizeTargets targets;
  const ImprovedSurface guarded =
      improve_surface({traced.mesh, traced.normals}, field, targets, Guarding::kEverywhere, ManyBad::kMend, 1);
  const MeshCheck check = check_mesh(guarded.surface.mesh);
  CHECK(check.fit_for_solver());
  CHECK(check.chi == traced.report.check.chi);
  CHECK(check.mean_min_angle_deg > 50.0);
}

TEST_CASE("improved meshes are the same to the last bit for any number of threads and order of the atoms") {
  std::vector<Atom> atoms = molecule("1a1p");
  const MeshResult one = mesh_surface(atoms, improved(0.6, 1.7, 0.6, 1));
  std::reverse(atoms.begin(), atoms.end());
  const MeshResult three = mesh_surface(atoms, improved(0.6, 1.7, 0.6, 3));
  CHECK(one.mesh.vertices == three.mesh.vertices);
  CHECK(one.mesh.triangles == three.mesh.triangles);
  CHECK(one.normals == three.normals);
}

TEST_CASE("density is vertices per area") {
  const std::vector<Atom> atoms{{0.1, 0.2, 0.3, 3.0, 0}};
  const MeshResult result = mesh_surface(atoms, improved(0.6, 1.7, spacing_for_density(6.0)));
  CHECK(double(result.mesh.vertices.size()) / result.report.check.area == Approx(6.0).epsilon(0.1));
}

// Near given places, and only there, cells are split until they are as small as was asked for.
#include "pipeline/fine_cells.h"

#include <algorithm>
#include <cmath>

#include "catch2.h"
#include "pipeline/trace_surface.h"
#include "support/lattices.h"
#include "support/random.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

/// Distance of a point from a cell along the axis along which it is largest (A).
double distance(const Lattice& lattice, const CellKey& cell, const Vec3& p) {
  const Box box = cell_box(lattice, cell);
  double farthest = 0.0;
  for (int k = 0; k < 3; ++k) farthest = std::max({farthest, box.lo[k] - p[k], p[k] - box.hi[k]});
  return farthest;
}

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

TEST_CASE("cells are to be split that are nearer to a place than cells there are wide, and larger") {
  Random random(7);
  const Lattice lattice = lattice_of(0.7);
  for (int round = 0; round < 20; ++round) {
    const FinePlace place{{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0)},
                          1 + round % 5};
    const FineCells fine(lattice, std::span(&place, 1));
    const double wide = lattice.cell_size() * std::ldexp(1.0, -place.level);
    int near = 0, far = 0;
    for (int level = 0; level <= 6; ++level) {
      const std::int64_t size = fine_size(level);
      const CellKey around = cell_at(lattice, place.at, level);
      for (int i = 0; i < 343; ++i) {
        CellKey cell = around;
        for (int k = 0, rest = i; k < 3; ++k, rest /= 7) cell.lo[k] += (rest % 7 - 3) * size;
        const double apart = distance(lattice, cell, place.at);
        if (std::abs(apart - wide) < 1e-3 * wide) continue;
        const bool is_near = level < place.level && apart < wide;
        near += is_near;
        far += !is_near;
        CHECK(fine.must_be_split(cell) == is_near);
      }
    }
    CHECK(near > 0);
    CHECK(far > 0);
  }
}

TEST_CASE("a trace has small triangles at places where it is to be fine, and the same elsewhere") {
  const std::vector<Atom> atoms{{0.1, 0.2, 0.3, 2.0, 0}, {2.6, 0.1, -0.2, 1.7, 0}};
  const GaussianField field(atoms, 0.6, 1.7);
  TraceDemands demands;
  const auto trace = [&] { return trace_surface(field, demands, 1, [](const std::string&) {}).surface.mesh; };
  const TriangleMesh plain = trace();
  const Vec3 place = plain.vertices[plain.vertices.size() / 2];
  demands.fine_places.push_back({place, 3});
  const TriangleMesh fine = trace();

  const auto near = [&](const TriangleMesh& mesh, double radius) {
    return std::count_if(mesh.vertices.begin(), mesh.vertices.end(),
                         [&](const Vec3& v) { return distance(v, place) < radius; });
  };
  const double width = demands.spacing / 8.0;
  CHECK(near(fine, 2.0 * width) >= 4 * near(plain, 2.0 * width));
  const auto beyond = [&](const TriangleMesh& mesh) {
    std::vector<Vec3> vertices;
    std::copy_if(mesh.vertices.begin(), mesh.vertices.end(), std::back_inserter(vertices),
                 [&](const Vec3& v) { return distance(v, place) > 2.0; });
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  };
  CHECK(beyond(fine) == beyond(plain));
  CHECK(beyond(plain).size() > 100);
  const auto euler = [](const TriangleMesh& mesh) { return 2 * mesh.vertices.size() - mesh.triangles.size(); };
  CHECK(euler(fine) == euler(plain));
}

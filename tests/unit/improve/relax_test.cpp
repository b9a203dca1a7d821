// Vertices move along the surface towards equilateral triangles, and no others move.
#include "improve/relax.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch2.h"
#include "support/block_mesh.h"
#include "support/meshing.h"
#include "support/random.h"
#include "support/whole_mesh.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

using Index = HalfEdgeMesh::Index;

constexpr double kRadius = 100.0;  // so that a hexagon of edge 1 A is flat to 0.005 A

/// Of a sphere round the origin.
Normal radial(const Vec3& p) {
  const double f = 1.0 / length(p);
  return {static_cast<float>(f * p[0]), static_cast<float>(f * p[1]), static_cast<float>(f * p[2])};
}

/// Distances of the corners from the middle; these make it a regular one of edge 1 A.
using Corners = std::array<double, 6>;
constexpr Corners kRegular{1, 1, 1, 1, 1, 1};

/// A hexagon round the pole of a sphere, and a vertex in it.
struct Hexagon {
  Hexagon(double x, double y, const Corners& corners = kRegular)
      : field({{0, 0, 0, kRadius, 0}}, 0.6, 1.0),
        block{{}, HalfEdgeMesh(triangles(), 7), {}, {}, {}, {{-3, -3, kRadius - 3}, {3, 3, kRadius + 3}}},
        block_field(field, block.box) {
    add(x, y);
    for (int i = 0; i < 6; ++i) {
      const double angle = i * std::numbers::pi / 3.0;
      add(corners[i] * std::cos(angle), corners[i] * std::sin(angle));
    }
  }

  std::size_t relax() {
    SheetGuard guard(block, Guarding::kCloseSheets);
    return relax_vertices(block, guard, block_field, Accuracy::kExact);
  }

  GaussianField field;
  BlockMesh block;
  BlockField block_field;

 private:
  static std::vector<Triangle> triangles() {
    std::vector<Triangle> fan;
    for (Index i = 0; i < 6; ++i) fan.push_back({0, 1 + i, 1 + (i + 1) % 6});
    return fan;
  }
  void add(double x, double y) {
    block.at.push_back(round_to_units({x, y, std::sqrt(kRadius * kRadius - x * x - y * y)}));
    block.normal.push_back(radial(block.at.back()));
    block.size.push_back(1.0f);
    block.curvature.push_back(0.0f);
    block.refinement.push_back(1.0f);
    block.is_active.push_back(1);
    block.is_guarded.push_back(0);
  }
};

const Vec3 kCentre{0.1, 0.2, 0.3};

/// A sphere as one block, each vertex shifted at random along the surface.
struct ShakenSphere {
  explicit ShakenSphere(double largest_shift)
      : field({{kCentre[0], kCentre[1], kCentre[2], 2.0, 0}}, 0.6, 1.0),
        block(
            MeshBlocks(
                whole_mesh(mesh_surface({{kCentre[0], kCentre[1], kCentre[2], 2.0, 0}}, improved(0.6, 1.0, 0.5)), 0.5f),
                {{{-5.0, -5.0, -5.0}, {5.0, 5.0, 5.0}}}, 1)
                .extract(0)),
        block_field(field, block.box) {
    Random random(41);
    for (Index v = 0; v < block.at.size(); ++v) {
      Vec3 shifted = block.at[v];
      for (double& x : shifted) x += random.uniform(-largest_shift, largest_shift);
      const auto place = block_field.project(shifted, 0.5);
      REQUIRE(place);
      block.put(v, *place);
    }
  }

  std::size_t relax(Accuracy accuracy) {
    SheetGuard guard(block, Guarding::kCloseSheets);
    return relax_vertices(block, guard, block_field, accuracy);
  }
  double mean_sine() const {
    double sum = 0.0;
    for (Index t = 0; t < block.connectivity.triangles(); ++t) sum += triangle_quality(block, t).min_sine;
    return sum / block.connectivity.triangles();
  }
  double least_sine() const {
    double least = 1.0;
    for (Index t = 0; t < block.connectivity.triangles(); ++t) {
      least = std::min(least, triangle_quality(block, t).min_sine);
    }
    return least;
  }
  /// Largest distance of a vertex from the sphere.
  double largest_distance() const {
    double largest = 0.0;
    for (const Vec3& p : block.at) largest = std::max(largest, std::abs(length(p - kCentre) - 2.0));
    return largest;
  }

  GaussianField field;
  BlockMesh block;
  BlockField block_field;
};

}  // namespace

TEST_CASE("a vertex in a regular hexagon goes to its middle at once, wherever it was") {
  for (const auto& [x, y] : {std::pair(0.3, 0.1), std::pair(-0.45, 0.2), std::pair(0.05, -0.5)}) {
    CAPTURE(x, y);
    Hexagon hexagon(x, y);
    const std::vector<Vec3> before = hexagon.block.at;
    CHECK(hexagon.relax() == 1);
    const Vec3 place = hexagon.block.at[0];
    CHECK(std::hypot(place[0], place[1]) < 0.005);
    CHECK(length(place) == Approx(kRadius).margin(2e-9));
    for (int k = 0; k < 3; ++k) CHECK(hexagon.block.normal[0][k] == Approx(radial(place)[k]).margin(1e-6));
    CHECK(std::equal(before.begin() + 1, before.end(), hexagon.block.at.begin() + 1));  // they are on the boundary
  }
}

TEST_CASE(
    "a vertex goes to the mean of the corners of equilateral triangles on the sides round it, short sides first") {
  Hexagon hexagon(0.1, 0.05, {1.3, 1.0, 0.8, 0.9, 1.2, 1.0});
  double x = 0.0, y = 0.0, total = 0.0;
  for (Index i = 1; i <= 6; ++i) {
    const Vec3 &a = hexagon.block.at[i], &b = hexagon.block.at[i % 6 + 1];
    const double dx = b[0] - a[0], dy = b[1] - a[1], weight = 1.0 / (dx * dx + dy * dy);
    x += weight * (a[0] + 0.5 * dx - std::sqrt(0.75) * dy);  // the side turned by 60 degrees about its beginning
    y += weight * (a[1] + std::sqrt(0.75) * dx + 0.5 * dy);
    total += weight;
  }
  CHECK(hexagon.relax() == 1);
  CHECK(hexagon.block.at[0][0] == Approx(x / total).margin(0.005));
  CHECK(hexagon.block.at[0][1] == Approx(y / total).margin(0.005));
  CHECK(std::hypot(x, y) / total > 0.05);  // not the middle
}

TEST_CASE("vertices that are not active, or would move by less than shows, stay") {
  Hexagon inactive(0.3, 0.1);
  inactive.block.is_active[0] = 0;
  const Vec3 there = inactive.block.at[0];
  CHECK(inactive.relax() == 0);
  CHECK(inactive.block.at[0] == there);

  Hexagon near(0.004, 0.003);
  const Vec3 here = near.block.at[0];
  CHECK(near.relax() == 0);
  CHECK(near.block.at[0] == here);
}

TEST_CASE("a vertex does not go where a triangle would be a sliver") {
  Hexagon hexagon(0.5, 0.0, {1.0, 1.0, 1.0, 0.12, 1.0, 1.0});  // it would go to (0.16, 0), near the fourth corner
  CHECK(star_quality(hexagon.block, 0).min_sine > 0.4);
  const Vec3 there = hexagon.block.at[0];
  CHECK(hexagon.relax() == 0);
  CHECK(hexagon.block.at[0] == there);
}

TEST_CASE("on a sphere relaxing makes triangles better, and changes neither surface nor connectivity") {
  ShakenSphere sphere(0.12);
  const std::vector<Triangle> triangles = triangles_of(sphere.block);
  const double before = sphere.mean_sine(), least_before = sphere.least_sine();
  double last = before;
  for (int round = 0; round < 3; ++round) {
    const std::vector<Vec3> at = sphere.block.at;
    const std::size_t moved = sphere.relax(Accuracy::kExact);
    std::size_t changed = 0;
    for (Index v = 0; v < at.size(); ++v) changed += at[v] != sphere.block.at[v];
    CHECK(moved == changed);
    CHECK(sphere.mean_sine() > last);
    last = sphere.mean_sine();
  }
  CHECK(last > before + 0.1);
  CHECK(sphere.least_sine() >= std::min(0.3, least_before));
  CHECK(sphere.largest_distance() < 2e-9);
  CHECK(triangles_of(sphere.block) == triangles);
}

TEST_CASE("what was relaxed roughly is exactly on the surface once it is settled, and what lies outside stays") {
  ShakenSphere sphere(0.12);
  sphere.relax(Accuracy::kRough);
  CHECK(sphere.largest_distance() < 1e-5);
  for (Vec3& p : sphere.block.at) p = kCentre + (1.0 + 1e-6) * (p - kCentre);
  sphere.block.box.hi[0] = 1.0;
  const std::vector<Vec3> before = sphere.block.at;
  settle_vertices(sphere.block, sphere.block_field);
  std::size_t outside = 0;
  for (Index v = 0; v < before.size(); ++v) {
    const Vec3& p = sphere.block.at[v];
    if (before[v][0] >= 1.0) {
      ++outside;
      CHECK(p == before[v]);
    } else {
      CHECK(length(p - kCentre) == Approx(2.0).margin(2e-9));
    }
  }
  CHECK(outside > 10);
  CHECK(outside < before.size() / 2);
}

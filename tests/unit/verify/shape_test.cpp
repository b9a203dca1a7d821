#include "verify/shape.h"

#include <random>

#include "catch2.h"
#include "verify/duplicates.h"
#include "verify/shapes.h"

using namespace gaussmesh;
using namespace gaussmesh::verify;

namespace {

/// Triangles that have nothing to do with each other, some of them needles and caps.
TriangleMesh soup(std::mt19937& engine, std::uint32_t count) {
  std::uniform_real_distribution<double> place(-1, 1), exponent(-6, 0);
  TriangleMesh mesh;
  for (std::uint32_t t = 0; t < count; ++t) {
    const Point a{place(engine), place(engine), place(engine)};
    const double thin = std::pow(10, exponent(engine));
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices.push_back(corner == 0 ? a : Point{a[0] + place(engine), a[1] + thin * place(engine), a[2]});
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

}  // namespace

TEST_CASE("many triangles measured together are as they are one by one") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  TriangleMesh mesh = soup(engine, 1000);
  mesh.triangles[200] = {5, 5, 6};  // no shape at all
  const MeshCheck all = measure_shape(mesh);
  MeshCheck sum;
  sum.min_angle_deg = sum.min_edge = 1000;
  for (const Triangle& triangle : mesh.triangles) {
    const MeshCheck one = measure_shape({mesh.vertices, {triangle}});
    sum.min_angle_deg = std::min(sum.min_angle_deg, one.min_angle_deg);
    sum.max_angle_deg = std::max(sum.max_angle_deg, one.max_angle_deg);
    sum.mean_min_angle_deg += one.mean_min_angle_deg / 1000;
    sum.mean_edge_ratio += one.mean_edge_ratio / 1000;
    sum.min_edge = std::min(sum.min_edge, one.min_edge);
    sum.max_edge = std::max(sum.max_edge, one.max_edge);
    sum.mean_edge += one.mean_edge / 1000;
    sum.fraction_under_30_deg += one.fraction_under_30_deg / 1000;
    for (std::size_t i = 0; i < sum.angle_histogram.size(); ++i) sum.angle_histogram[i] += one.angle_histogram[i];
    for (std::size_t i = 0; i < sum.ratio_histogram.size(); ++i) sum.ratio_histogram[i] += one.ratio_histogram[i];
  }
  CHECK(all.min_angle_deg == Approx(sum.min_angle_deg).epsilon(1e-12));
  CHECK(all.max_angle_deg == Approx(sum.max_angle_deg).epsilon(1e-12));
  CHECK(all.mean_min_angle_deg == Approx(sum.mean_min_angle_deg).epsilon(1e-12));
  CHECK(all.mean_edge_ratio == Approx(sum.mean_edge_ratio).epsilon(1e-12));
  CHECK(all.min_edge == Approx(sum.min_edge).epsilon(1e-12));
  CHECK(all.max_edge == Approx(sum.max_edge).epsilon(1e-12));
  CHECK(all.mean_edge == Approx(sum.mean_edge).epsilon(1e-12));
  CHECK(all.fraction_under_30_deg == Approx(sum.fraction_under_30_deg).epsilon(1e-12));
  CHECK(all.angle_histogram == sum.angle_histogram);
  CHECK(all.ratio_histogram == sum.ratio_histogram);
}

TEST_CASE("every vertex at the place of an earlier one is counted, and none without a usable place") {
  std::mt19937 engine(7);
  std::uniform_int_distribution<int> whole(0, 9);
  std::vector<Point> points;
  std::vector<bool> seen(1000);
  std::size_t duplicates = 0;
  for (int i = 0; i < 3000; ++i) {
    const int x = whole(engine), y = whole(engine), z = whole(engine);
    points.push_back({x == 0 && i % 2 == 0 ? -0.0 : x, 1.0 * y, 1.0 * z});
    duplicates += seen[100 * x + 10 * y + z];
    seen[100 * x + 10 * y + z] = true;
  }
  CHECK(count_duplicates(points) == duplicates);
  points.insert(points.end(), 5, {std::nan(""), 0, 0});
  CHECK(count_duplicates(points) == duplicates);
}

// Vertices of close sheets are those that all pairs show, whatever the sizes.
#include "improve/close_sheets.h"

#include <cmath>
#include <random>

#include "catch2.h"

using namespace gaussmesh;

namespace {

/// Vertices of small spheres in a cube of edge 10 A, with wanted sizes of 0.001 to 0.8 A.
BlockMesh scattered_spheres(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> anywhere(0.0, 10.0), direction(-1.0, 1.0), exponent(-3.0, -0.1);
  BlockMesh mesh{{}, HalfEdgeMesh({}, 0), {}, {}, {}, {{0.0, 0.0, 0.0}, {10.0, 10.0, 10.0}}};
  Vec3 middle{};
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 50 == 0) middle = {anywhere(random), anywhere(random), anywhere(random)};
    const Vec3 d{direction(random), direction(random), direction(random)};
    const Vec3 n = (1.0 / length(d)) * d;
    mesh.at.push_back(middle + 0.7 * n);
    mesh.normal.push_back({static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
    mesh.size.push_back(static_cast<float>(std::pow(10.0, exponent(random))));
  }
  return mesh;
}

std::vector<std::uint8_t> close_sheets_by_pairs(const BlockMesh& mesh) {
  std::vector<std::uint8_t> is_close(mesh.at.size(), 0);
  for (std::size_t v = 0; v < mesh.at.size(); ++v) {
    for (std::size_t w = 0; w < v; ++w) {
      const double near = double(std::max(mesh.size[v], mesh.size[w]));
      const double cosine = dot(as_vector(mesh.normal[v]), mesh.normal[w]);
      if (length(mesh.at[v] - mesh.at[w]) < near && cosine < 0.25) is_close[v] = is_close[w] = 1;
    }
  }
  return is_close;
}

}  // namespace

TEST_CASE("close sheets are found as all pairs of vertices show them") {
  for (const std::size_t count : {0u, 1u, 2u, 15u, 16u, 17u, 100u, 2000u}) {
    CAPTURE(count);
    const BlockMesh mesh = scattered_spheres(count, 7);
    const std::vector<std::uint8_t> expected = close_sheets_by_pairs(mesh);
    CHECK(find_close_sheets(mesh) == expected);
    if (count < 2000) continue;
    const auto close = std::count(expected.begin(), expected.end(), 1);
    CHECK(close > 10);
    CHECK(close < static_cast<std::ptrdiff_t>(count) - 10);
  }
}

#include "verify/intersections.h"

#include <algorithm>
#include <optional>
#include <random>
#include <set>

#include "catch2.h"
#include "support/threads.h"
#include "verify/shapes.h"
#include "verify/triangle_pair.h"

using namespace gaussmesh;
using namespace gaussmesh::verify;

namespace {

// A reference for small whole coordinates: all corners of the intersection of the two triangles, as fractions. A
// corner is a vertex of one inside the other, or an edge of one through the other, or two edges that cross.

using Whole = std::int64_t;
using Vector = std::array<Whole, 3>;
using WholeTriangle = std::array<Vector, 3>;

/// numerator / denominator, denominator > 0
struct Fraction {
  Vector numerator{};
  Whole denominator = 1;
};

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator*(Whole s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
Whole inner(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector outer(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
const Vector kZero{};

bool is_in_triangle(const Vector& p, const WholeTriangle& t) {
  const Vector normal = outer(t[1] - t[0], t[2] - t[0]);
  if (inner(normal, p - t[0]) != 0) return false;
  for (int k = 0; k < 3; ++k)
    if (inner(normal, outer(t[(k + 1) % 3] - t[k], p - t[k])) < 0) return false;
  return true;
}

/// p + s (q - p) = a + u (b - a) + v (c - a) by Cramer's rule; nothing where the edge is parallel to the plane.
std::optional<Fraction> edge_through_triangle(const Vector& p, const Vector& q, const WholeTriangle& t) {
  const Vector b = t[1] - t[0], c = t[2] - t[0], d = q - p, e = t[0] - p;
  Whole det = inner(d, outer(b, c));
  if (det == 0) return std::nullopt;
  Whole s = inner(e, outer(b, c)), u = -inner(d, outer(e, c)), v = -inner(d, outer(b, e));
  if (det < 0) det = -det, s = -s, u = -u, v = -v;
  if (s < 0 || s > det || u < 0 || v < 0 || u + v > det) return std::nullopt;
  return Fraction{det * p + s * d, det};
}

std::optional<Fraction> edges_cross(const Vector& p, const Vector& q, const Vector& r, const Vector& s) {
  const Vector normal = outer(q - p, s - r);
  if (normal == kZero || inner(normal, r - p) != 0) return std::nullopt;
  const Whole size = inner(normal, normal);
  const Whole on_pq = inner(normal, outer(r - p, s - r)), on_rs = inner(normal, outer(r - p, q - p));
  if (on_pq < 0 || on_pq > size || on_rs < 0 || on_rs > size) return std::nullopt;
  return Fraction{size * p + on_pq * (q - p), size};
}

void add_corners(const WholeTriangle& s, const WholeTriangle& t, std::vector<Fraction>& corners) {
  for (int i = 0; i < 3; ++i) {
    if (is_in_triangle(s[i], t)) corners.push_back({s[i], 1});
    if (const auto point = edge_through_triangle(s[i], s[(i + 1) % 3], t)) corners.push_back(*point);
    for (int j = 0; j < 3; ++j)
      if (const auto point = edges_cross(s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3])) corners.push_back(*point);
  }
}

/// Whether a corner is on the segment a b, which may be one point.
bool is_on_segment(const Fraction& corner, const Vector& a, const Vector& b) {
  const Vector along = b - a, to_corner = corner.numerator - corner.denominator * a;
  if (outer(along, to_corner) != kZero) return false;
  if (along == kZero) return to_corner == kZero;
  const Whole place = inner(along, to_corner);
  return place >= 0 && place <= corner.denominator * inner(along, along);
}

bool reference(const TriangleMesh& mesh) {
  WholeTriangle t[2];
  std::set<std::uint32_t> first(mesh.triangles[0].begin(), mesh.triangles[0].end());
  std::vector<Vector> shared;
  for (int n = 0; n < 2; ++n)
    for (int i = 0; i < 3; ++i) {
      const Point& p = mesh.vertices[mesh.triangles[n][i]];
      for (int k = 0; k < 3; ++k) t[n][i][k] = static_cast<Whole>(p[k]);
      if (n == 1 && first.count(mesh.triangles[1][i])) shared.push_back(t[n][i]);
    }
  if (shared.size() == 3) return true;
  std::vector<Fraction> corners;
  add_corners(t[0], t[1], corners);
  add_corners(t[1], t[0], corners);
  return std::any_of(corners.begin(), corners.end(), [&](const Fraction& corner) {
    return shared.empty() || !is_on_segment(corner, shared.front(), shared.back());
  });
}

bool meet(const TriangleMesh& mesh, std::size_t a, std::size_t b) {
  return meet_beyond_shared(PlacedTriangle(mesh, mesh.triangles[a]), PlacedTriangle(mesh, mesh.triangles[b]));
}

Intersections find(const TriangleMesh& mesh) {
  const VertexStars stars(mesh);
  return find_intersections(mesh, TriangleTree(mesh), find_flat_fans(mesh, stars, find_edge_topology(mesh, stars)));
}

/// Whether a triangle has no area: whichever way one looks at it, it turns neither way.
bool has_flat_triangle(const TriangleMesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    const auto turn_along = [&](int axis) {
      const auto corner = [&](int k) { return project_along(axis, mesh.vertices[t[k]]); };
      return orient2d(corner(0), corner(1), corner(2));
    };
    return turn_along(0) == 0 && turn_along(1) == 0 && turn_along(2) == 0;
  });
}

/// Two triangles with `shared` common vertices, corners in a random order.
TriangleMesh random_pair(std::mt19937& engine, int grid, std::uint32_t shared) {
  std::uniform_int_distribution<int> coordinate(0, grid);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 6 - shared; ++i)
    mesh.vertices.push_back({double(coordinate(engine)), double(coordinate(engine)), double(coordinate(engine))});
  mesh.triangles = {{0, 1, 2}, {3 - shared, 4 - shared, 5 - shared}};
  for (Triangle& t : mesh.triangles) std::shuffle(t.begin(), t.end(), engine);
  return mesh;
}

/// Small triangles strewn over a box; some share vertices.
TriangleMesh strewn(std::mt19937& engine, std::size_t count, double box, double size) {
  std::uniform_real_distribution<double> place(0, box), offset(-size, size);
  TriangleMesh mesh;
  for (std::uint32_t t = 0; t < count; ++t) {
    const Point p{place(engine), place(engine), place(engine)};
    for (int i = 0; i < 3; ++i)
      mesh.vertices.push_back({p[0] + offset(engine), p[1] + offset(engine), p[2] + offset(engine)});
    mesh.triangles.push_back({3 * t, 3 * t + 1, t % 5 == 4 ? 3 * t - 1 : 3 * t + 2});
  }
  return mesh;
}

std::size_t count_by_brute_force(const TriangleMesh& mesh) {
  std::vector<PlacedTriangle> placed;
  for (const Triangle& t : mesh.triangles) placed.emplace_back(mesh, t);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < placed.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) pairs += meet_beyond_shared(placed[j], placed[i]);
  return pairs;
}

}  // namespace

TEST_CASE("random pairs on small grids agree with fractions") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  for (const int grid : {1, 2, 3, 6})
    for (const std::uint32_t shared : {0u, 1u, 2u, 3u}) {
      std::size_t meeting = 0, tested = 0;
      for (int i = 0; i < 40000; ++i) {
        TriangleMesh mesh = random_pair(engine, grid, shared);
        if (has_flat_triangle(mesh)) continue;
        const bool expected = reference(mesh);
        ++tested;
        meeting += expected;
        if (meet(mesh, 0, 1) != expected || meet(mesh, 1, 0) != expected)
          FAIL("grid " << grid << ", " << shared << " shared, case " << i);
        for (Point& p : mesh.vertices) p = {1e7 - p[0] / 1024, p[1] / 1024 + 3e6, p[2] / 1024 - 8e6};
        if (meet(mesh, 0, 1) != expected) FAIL("moved: grid " << grid << ", " << shared << " shared, case " << i);
      }
      CAPTURE(grid, shared, tested);
      CHECK(tested > 5000);
      CHECK(meeting > tested / 200);
      CHECK((shared == 3 || meeting < tested));
    }
}

TEST_CASE("flat triangles are left to degenerate_triangles") {
  for (const double end : {-3.0, 3.0}) {  // the flat one before, or after the other along the curve
    TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {0.5, 0.5, end}},
                      {{0, 1, 2}, {3, 4, 5}}};
    CHECK(find(mesh).pairs == 0);
    mesh.vertices[5][0] = 0.6;
    CHECK(find(mesh).pairs == 1);
  }
}

TEST_CASE("the tree finds what all pairs give") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  const TriangleMesh even = strewn(engine, 1500, 10, 1);
  CHECK(find(even).pairs == count_by_brute_force(even));
  CHECK(find(even).pairs > 100);
  const TriangleMesh uneven = shapes::together(strewn(engine, 1500, 10, 0.3), strewn(engine, 20, 10, 20));
  CHECK(find(uneven).pairs == count_by_brute_force(uneven));
  const TriangleMesh far = shapes::together(even, shapes::moved(even, {1e6, 0, 0}));
  CHECK(find(far).pairs == count_by_brute_force(far));
  const TriangleMesh crowded = strewn(engine, 300, 0, 1);  // all round one place
  CHECK(find(crowded).pairs == count_by_brute_force(crowded));
}

TEST_CASE("many triangles in one place") {
  TriangleMesh mesh = shapes::tetrahedron();
  for (int i = 0; i < 99; ++i) mesh.triangles.push_back(mesh.triangles[0]);
  CHECK(find(mesh).pairs == 100 * 99 / 2);
}

TEST_CASE("examples are the first pairs, lower number first") {
  std::mt19937 engine(1);
  const TriangleMesh mesh = strewn(engine, 400, 1, 1);
  const Intersections found = find(mesh);
  REQUIRE(found.examples.size() == 10);
  CHECK(std::is_sorted(found.examples.begin(), found.examples.end()));
  for (const auto& [a, b] : found.examples) {
    CHECK(a < b);
    CHECK(meet(mesh, a, b));
  }
  const auto [last_a, last_b] = found.examples.back();
  std::size_t up_to_last = 0;
  for (std::uint32_t a = 0; a <= last_a; ++a)
    for (std::uint32_t b = a + 1; b < (a == last_a ? last_b + 1 : mesh.triangles.size()); ++b)
      up_to_last += meet(mesh, a, b);
  CHECK(up_to_last == 10);
}

TEST_CASE("good meshes of any size have no intersections") {
  for (const double radius : {1e-3, 1.0, 1e6}) CHECK(find(shapes::icosphere(4, radius)).pairs == 0);
  CHECK(find(shapes::torus(60, 20, 10, 3)).pairs == 0);
  const TriangleMesh ball = shapes::icosphere(3, 1);
  CHECK(find(shapes::together(ball, shapes::moved(ball, {1e6, 0, 0}))).pairs == 0);
  CHECK(find(TriangleMesh{}).pairs == 0);
}

TEST_CASE("intersections do not depend on the number of threads") {
  std::mt19937 engine(7);
  const TriangleMesh mesh = strewn(engine, 5000, 10, 0.7);
  const auto alone = testing::on_threads(1, [&] { return find(mesh); });
  const auto together = testing::on_threads(5, [&] { return find(mesh); });
  CHECK(alone.pairs == together.pairs);
  CHECK(alone.examples == together.examples);
}

#include "core/exact_plane.h"

#include <vector>

#include "catch2.h"
#include "support/random.h"

using namespace gaussmesh;
using testing::Random;

namespace {

PlanePoint along(const PlanePoint& p, const PlanePoint& step, Coord times) {
  return {p.a + times * step.a, p.b + times * step.b};
}

/// The points of a square of `size`^2 grid points.
std::vector<PlanePoint> grid(Coord size) {
  std::vector<PlanePoint> points;
  for (Coord a = 0; a < size; ++a) {
    for (Coord b = 0; b < size; ++b) points.push_back({a, b});
  }
  return points;
}

Coord cross(const PlanePoint& u, const PlanePoint& v) { return u.a * v.b - u.b * v.a; }
PlanePoint minus(const PlanePoint& p, const PlanePoint& q) { return {p.a - q.a, p.b - q.b}; }

/// Whether p + s (q - p) = r + t (u - r) for some s, t in [0, 1], by Cramer's rule; small coordinates, nothing
/// parallel.
bool cross_in_one_point(const PlanePoint& p, const PlanePoint& q, const PlanePoint& r, const PlanePoint& u) {
  Coord det = cross(minus(q, p), minus(u, r));
  Coord s = cross(minus(r, p), minus(u, r)), t = cross(minus(r, p), minus(q, p));
  if (det < 0) det = -det, s = -s, t = -t;
  return s >= 0 && s <= det && t >= 0 && t <= det;
}

/// Whether x is one of the points p + (q - p) n / 12. On a grid of 4 x 4 points segments on one line, if they meet
/// at all, have a grid point in common.
bool is_on(const PlanePoint& p, const PlanePoint& q, const PlanePoint& x) {
  for (Coord n = 0; n <= 12; ++n) {
    if (12 * (x.a - p.a) == n * (q.a - p.a) && 12 * (x.b - p.b) == n * (q.b - p.b)) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("turn is exact for points that are one unit off a line, at any size of coordinates") {
  const std::uint64_t seed = 3;
  CAPTURE(seed);
  Random random(seed);
  for (int bits : {2, 20, 40, 60}) {
    const Coord size = Coord{1} << bits;
    for (int i = 0; i < 20000; ++i) {
      const PlanePoint step{random.integer(-8, 8), random.integer(-8, 8)};
      const PlanePoint p{random.integer(-size, size), random.integer(-size, size)};
      const Coord m = random.integer(-size / 16, size / 16), n = random.integer(1, size / 16 + 1);
      const PlanePoint q = along(p, step, n), on_line = along(p, step, m);
      const PlanePoint off{random.integer(-1, 1), random.integer(-1, 1)};
      // With q - p = n step and r - p = m step + off the area is n (step x off).
      const Coord area = cross(step, off);
      const int expected = area > 0 ? 1 : area < 0 ? -1 : 0;
      const PlanePoint r = along(on_line, off, 1);
      REQUIRE(turn(p, q, on_line) == 0);
      REQUIRE(turn(p, q, r) == expected);
      REQUIRE(turn(q, r, p) == expected);
      REQUIRE(turn(q, p, r) == -expected);
    }
  }
}

TEST_CASE("turn is exact at the ends of its range") {
  const Coord far = (Coord{1} << 61) - 1;  // coordinates differ by just less than 2^62
  CHECK(turn({-far, -far}, {far, far - 1}, {far, far}) == 1);
  CHECK(turn({-far, -far}, {far, far}, {far, far - 1}) == -1);
  CHECK(turn({-far, -far}, {far, far}, {0, 0}) == 0);
  CHECK(turn({-far, -far}, {far, far}, {0, 1}) == 1);
  CHECK(turn({-far, far}, {far, -far}, {1, -1}) == 0);
}

TEST_CASE("segments_meet agrees with Cramer's rule on all segments of a small grid") {
  const auto points = grid(4);
  std::size_t meeting = 0, apart = 0;
  for (const PlanePoint& p : points) {
    for (const PlanePoint& q : points) {
      for (const PlanePoint& r : points) {
        for (const PlanePoint& u : points) {
          if (p == q || r == u) continue;
          bool expected;
          if (cross(minus(q, p), minus(u, r)) != 0) {
            expected = cross_in_one_point(p, q, r, u);
          } else {
            expected = is_on(p, q, r) || is_on(p, q, u) || is_on(r, u, p) || is_on(r, u, q);
          }
          if (segments_meet(p, q, r, u) != expected) {
            FAIL(p.a << ' ' << p.b << ", " << q.a << ' ' << q.b << " and " << r.a << ' ' << r.b << ", " << u.a << ' '
                     << u.b << ": expected " << expected);
          }
          ++(expected ? meeting : apart);
        }
      }
    }
  }
  CHECK(meeting > 10000);
  CHECK(apart > 10000);
}

TEST_CASE("a segment of no length meets what passes through it") {
  CHECK(segments_meet({1, 1}, {1, 1}, {0, 0}, {2, 2}));
  CHECK_FALSE(segments_meet({1, 0}, {1, 0}, {0, 0}, {2, 2}));
  CHECK_FALSE(segments_meet({3, 3}, {3, 3}, {0, 0}, {2, 2}));
  CHECK(segments_meet({3, 3}, {3, 3}, {3, 3}, {3, 3}));
}

TEST_CASE("segments_overlap: only in the same direction from the common end") {
  for (const PlanePoint& q : grid(5)) {
    for (const PlanePoint& r : grid(5)) {
      const PlanePoint p{2, 2};
      if (q == p || r == p) continue;
      const PlanePoint u = minus(q, p), v = minus(r, p);
      const bool expected = cross(u, v) == 0 && u.a * v.a + u.b * v.b > 0;
      if (segments_overlap(p, q, r) != expected) FAIL(q.a << ' ' << q.b << " and " << r.a << ' ' << r.b);
    }
  }
}

TEST_CASE("sides of polygons meet unless all they share is a corner between two of them") {
  const auto polygon = [](std::vector<PlanePoint> corners, int first = 0) {
    std::vector<PolygonSide> sides;
    const int n = static_cast<int>(corners.size());
    for (int i = 0; i < n; ++i) sides.push_back({corners[i], corners[(i + 1) % n], first + i, first + (i + 1) % n});
    return sides;
  };
  const auto both = [](std::vector<PolygonSide> a, const std::vector<PolygonSide>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const auto square = polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  CHECK_FALSE(sides_meet({}));
  CHECK_FALSE(sides_meet(square));
  CHECK_FALSE(sides_meet(both(square, polygon({{1, 1}, {1, 2}, {2, 1}}, 4))));
  CHECK(sides_meet(both(square, polygon({{0, 1}, {1, 2}, {2, 1}}, 4))));   // touches a side
  CHECK(sides_meet(both(square, polygon({{0, 0}, {1, 2}, {2, 1}}, 4))));   // a corner, by another number
  CHECK(sides_meet(both(square, polygon({{-1, 1}, {1, 2}, {2, 1}}, 4))));  // crosses it
  CHECK(sides_meet(polygon({{0, 0}, {4, 4}, {4, 0}, {0, 4}})));            // a bow tie
  CHECK(sides_meet(polygon({{0, 0}, {4, 0}, {2, 0}, {2, 4}})));            // turns back upon itself
  CHECK(sides_meet(polygon({{0, 0}, {4, 0}})));                            // there and back
  CHECK(sides_meet(polygon({{0, 0}, {0, 0}, {4, 0}, {0, 4}})));            // a side of no length
}

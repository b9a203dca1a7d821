#include "core/exact_space.h"

#include <algorithm>
#include <optional>

#include "catch2.h"
#include "support/random.h"
#include "verify/triangle_pair.h"

using namespace gaussmesh;
using namespace gaussmesh::verify;
using testing::Random;

namespace {

CoordPoint random_point(Random& random, Coord lo, Coord hi) {
  return {random.integer(lo, hi), random.integer(lo, hi), random.integer(lo, hi)};
}

/// p + i u + j v + k w
CoordPoint combined(CoordPoint p, Coord i, const CoordPoint& u, Coord j, const CoordPoint& v, Coord k,
                    const CoordPoint& w) {
  for (int a = 0; a < 3; ++a) p[a] += i * u[a] + j * v[a] + k * w[a];
  return p;
}

Coord determinant(const CoordPoint& u, const CoordPoint& v, const CoordPoint& w) {
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

int sign(Coord x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// What the judge, which shares no code with core/, says of the pair; nothing where a triangle has no area.
std::optional<bool> judged(const NamedTriangle& s, const NamedTriangle& t) {
  TriangleMesh mesh;
  mesh.vertices.resize(6);
  const auto place = [&](const NamedTriangle& triangle) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) mesh.vertices[triangle.name[i]][k] = static_cast<double>(triangle.at[i][k]);
    }
  };
  place(s);
  place(t);
  for (const NamedTriangle* triangle : {&s, &t}) {
    CoordPoint u, v;
    for (int k = 0; k < 3; ++k) {
      u[k] = triangle->at[1][k] - triangle->at[0][k];
      v[k] = triangle->at[2][k] - triangle->at[0][k];
    }
    if (u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0]) return std::nullopt;
  }
  return meet_beyond_shared({mesh, s.name}, {mesh, t.name});
}

/// Whether some corner of one lies in the plane of the other and is not shared by name.
bool some_corner_is_coplanar(const NamedTriangle& s, const NamedTriangle& t) {
  for (int i = 0; i < 3; ++i) {
    const bool t_shared = std::find(s.name.begin(), s.name.end(), t.name[i]) != s.name.end();
    const bool s_shared = std::find(t.name.begin(), t.name.end(), s.name[i]) != t.name.end();
    if (!t_shared && orientation(s.at[0], s.at[1], s.at[2], t.at[i]) == 0) return true;
    if (!s_shared && orientation(t.at[0], t.at[1], t.at[2], s.at[i]) == 0) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("orientation has the sign of the determinant") {
  const CoordPoint o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  CHECK(orientation(o, x, y, z) == 1);
  CHECK(orientation(o, y, x, z) == -1);
  CHECK(orientation(o, x, y, {5, -7, 0}) == 0);
}

TEST_CASE("orientation is exact one unit off a plane, at any size of coordinates") {
  const std::uint64_t seed = 4;
  CAPTURE(seed);
  Random random(seed);
  for (const int bits : {8, 20, 30, 39}) {
    const Coord size = Coord{1} << bits, most = size / 32;
    for (int n = 0; n < 20000; ++n) {
      // In the basis u, v, w the volume is that of the coefficients times det(u, v, w).
      const CoordPoint u = random_point(random, -4, 4), v = random_point(random, -4, 4),
                       w = random_point(random, -4, 4);
      const CoordPoint p = random_point(random, -size / 4, size / 4);
      const Coord i = random.integer(1, most), j = random.integer(1, most), k = random.integer(-1, 1);
      const CoordPoint q = combined(p, i, u, random.integer(-1, 1), v, 0, w);
      const CoordPoint r = combined(p, 0, u, j, v, 0, w);
      const CoordPoint s = combined(p, random.integer(-most, most), u, random.integer(-most, most), v, k, w);
      const int expected = sign(determinant(u, v, w)) * sign(k);
      REQUIRE(orientation(p, q, r, s) == expected);
      REQUIRE(orientation(q, p, r, s) == -expected);
      REQUIRE(orientation(r, s, p, q) == expected);
    }
  }
}

TEST_CASE("triangles_may_meet: never misses triangles that meet, and is exact in general position") {
  const std::uint64_t seed = 5;
  CAPTURE(seed);
  Random random(seed);
  std::size_t met = 0, apart = 0, coplanar = 0;
  for (const Coord size : {3, 8, 1000}) {
    for (int shared = 0; shared <= 2; ++shared) {
      CAPTURE(size, shared);
      for (int n = 0; n < 20000; ++n) {
        NamedTriangle s, t;
        for (std::uint32_t i = 0; i < 3; ++i) {
          s.name[i] = i;
          t.name[i] = i + 3;
          s.at[i] = random_point(random, 0, size);
          t.at[i] = random_point(random, 0, size);
        }
        for (int i = 0; i < shared; ++i) {
          t.name[(i + n) % 3] = s.name[i];
          t.at[(i + n) % 3] = s.at[i];
        }
        const auto expected = judged(s, t);
        if (!expected) continue;
        const bool answer = triangles_may_meet(s, t);
        REQUIRE(answer == triangles_may_meet(t, s));
        if (*expected) REQUIRE(answer);
        if (some_corner_is_coplanar(s, t)) {
          ++coplanar;
        } else {
          REQUIRE(answer == *expected);
          ++(answer ? met : apart);
        }
      }
    }
  }
  CHECK(met > 1000);
  CHECK(apart > 1000);
  CHECK(coplanar > 1000);
}

TEST_CASE("a triangle meets itself") {
  const NamedTriangle s{{0, 1, 2}, {{{0, 0, 0}, {5, 0, 0}, {0, 5, 0}}}};
  const NamedTriangle turned{{2, 1, 0}, {{{0, 5, 0}, {5, 0, 0}, {0, 0, 0}}}};
  CHECK(triangles_may_meet(s, s));
  CHECK(triangles_may_meet(s, turned));
}

TEST_CASE("two triangles folded flat onto each other along their common edge may meet; unfolded ones do not") {
  const NamedTriangle s{{0, 1, 2}, {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};
  CHECK(triangles_may_meet(s, {{0, 1, 3}, {{{0, 0, 0}, {4, 0, 0}, {1, 4, 0}}}}));
  CHECK_FALSE(triangles_may_meet(s, {{0, 1, 3}, {{{0, 0, 0}, {4, 0, 0}, {1, 4, 1}}}}));
  CHECK_FALSE(triangles_may_meet(s, {{0, 1, 3}, {{{0, 0, 0}, {4, 0, 0}, {1, -4, -1}}}}));
}

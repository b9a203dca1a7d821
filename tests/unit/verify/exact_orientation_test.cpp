#include "verify/exact_orientation.h"

#include <cmath>
#include <cstdint>
#include <random>

#include "catch2.h"

using namespace gaussmesh;
using namespace gaussmesh::verify;

namespace {

__extension__ using Wide = __int128;
using Whole2 = std::array<std::int64_t, 2>;
using Whole3 = std::array<std::int64_t, 3>;

int sign(Wide x) { return (x > 0) - (x < 0); }

int reference(const Whole2& a, const Whole2& b, const Whole2& c) {
  return sign(static_cast<Wide>(b[0] - a[0]) * (c[1] - a[1]) - static_cast<Wide>(b[1] - a[1]) * (c[0] - a[0]));
}

/// Good for coordinates below 2^39: differences of 2^40, determinants of 6 * 2^120.
int reference(const Whole3& a, const Whole3& b, const Whole3& c, const Whole3& d) {
  Wide u[3], v[3], w[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    w[k] = d[k] - a[k];
  }
  return sign((u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
              (u[0] * v[1] - u[1] * v[0]) * w[2]);
}

/// Whole numbers times a power of two: still exact in a double.
PlanePoint scaled(const Whole2& a, double unit) {
  return {static_cast<double>(a[0]) * unit, static_cast<double>(a[1]) * unit};
}
Point scaled(const Whole3& a, double unit) {
  return {static_cast<double>(a[0]) * unit, static_cast<double>(a[1]) * unit, static_cast<double>(a[2]) * unit};
}

class Source {
 public:
  Source() : seed_(std::random_device{}()), engine_(seed_) {}

  unsigned seed() const { return seed_; }
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(engine_);
  }
  Whole3 point(std::int64_t most) { return {between(-most, most), between(-most, most), between(-most, most)}; }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }

 private:
  unsigned seed_;
  std::mt19937_64 engine_;
};

/// In the plane of a, b, c, or one unit off it in some coordinates.
Whole3 near_plane(Source& source, const Whole3& a, const Whole3& b, const Whole3& c, std::int64_t off) {
  const std::int64_t s = source.between(-3, 3), t = source.between(-3, 3);
  Whole3 d{};
  for (int k = 0; k < 3; ++k) d[k] = a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) + source.between(-off, off);
  return d;
}

}  // namespace

TEST_CASE("orient3d: the side that a, b, c turn counter-clockwise seen from is positive") {
  CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == 1);
  CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}) == -1);
  CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, -9, 0}) == 0);
  CHECK(orient2d({0, 0}, {1, 0}, {0, 1}) == 1);
  CHECK(orient2d({0, 0}, {0, 1}, {1, 0}) == -1);
  CHECK(orient2d({0, 0}, {1, 1}, {3, 3}) == 0);
}

TEST_CASE("orient3d agrees with whole numbers where points are nearly coplanar") {
  Source source;
  CAPTURE(source.seed());
  int zeros = 0;
  for (int i = 0; i < 200000; ++i) {
    const std::int64_t most = std::int64_t{1} << source.between(1, 34);  // times 7 at most: below 2^37
    const Whole3 a = source.point(most), b = source.point(most), c = source.point(most);
    const Whole3 d = near_plane(source, a, b, c, source.between(0, 1));
    const int expected = reference(a, b, c, d);
    zeros += expected == 0;
    const double unit = std::ldexp(1.0, static_cast<int>(source.between(-160, 160)));
    if (orient3d(scaled(a, unit), scaled(b, unit), scaled(c, unit), scaled(d, unit)) != expected)
      FAIL("case " << i << ": expected " << expected);
  }
  CHECK(zeros > 50000);
}

TEST_CASE("orient2d agrees with whole numbers where points are nearly collinear") {
  Source source;
  CAPTURE(source.seed());
  for (int i = 0; i < 200000; ++i) {
    const std::int64_t most = std::int64_t{1} << source.between(1, 48);
    const std::int64_t s = source.between(-5, 5);
    const Whole2 a{source.between(-most, most), source.between(-most, most)};
    const Whole2 b{source.between(-most, most), source.between(-most, most)};
    const Whole2 c{a[0] + s * (b[0] - a[0]) + source.between(-1, 1), a[1] + s * (b[1] - a[1]) + source.between(-1, 1)};
    if (orient2d(scaled(a, 0x1p-20), scaled(b, 0x1p-20), scaled(c, 0x1p-20)) != reference(a, b, c)) FAIL("case " << i);
  }
}

TEST_CASE("orient2d on the grid of neighbouring doubles round a point of a line") {
  // Kettner et al., Comput. Geom. 40:61 (2008): rounded evaluation gives a picture of noise here.
  constexpr std::int64_t kOne = std::int64_t{1} << 53;
  for (std::int64_t i = 0; i < 256; ++i)
    for (std::int64_t j = 0; j < 256; ++j) {
      const Whole2 a{kOne / 2 + i, kOne / 2 + j}, b{12 * kOne, 12 * kOne}, c{24 * kOne, 24 * kOne};
      if (orient2d(scaled(a, 0x1p-53), scaled(b, 0x1p-53), scaled(c, 0x1p-53)) != reference(a, b, c))
        FAIL("grid point " << i << ", " << j);
    }
}

TEST_CASE("orient3d is one answer for one set of points, however they are listed") {
  Source source;
  CAPTURE(source.seed());
  for (int i = 0; i < 100000; ++i) {
    Point p[4];
    for (int n = 0; n < 3; ++n) p[n] = {source.real(-1e7, 1e7), source.real(-1e7, 1e7), source.real(-1e7, 1e7)};
    const double s = source.real(-1, 1), t = source.real(-1, 1);
    for (int k = 0; k < 3; ++k) p[3][k] = p[0][k] + s * (p[1][k] - p[0][k]) + t * (p[2][k] - p[0][k]);
    const int side = orient3d(p[0], p[1], p[2], p[3]);
    const bool agree = orient3d(p[1], p[2], p[0], p[3]) == side && orient3d(p[1], p[0], p[2], p[3]) == -side &&
                       orient3d(p[3], p[0], p[1], p[2]) == -side && orient3d(p[2], p[3], p[0], p[1]) == side;
    if (!agree) FAIL("case " << i);
  }
}

TEST_CASE("signs are exact up to the ends of the range of coordinates") {
  for (const double unit : {kSmallestExact, kLargestExact / 4}) {
    CHECK(orient3d({0, 0, 0}, {unit, 0, 0}, {0, unit, 0}, {0, 0, unit}) == 1);
    CHECK(orient3d({unit, unit, unit}, {2 * unit, unit, unit}, {unit, 2 * unit, unit}, {3 * unit, unit, unit}) == 0);
    CHECK(orient2d({0, 0}, {unit, 0}, {unit, unit}) == 1);
  }
  const double tiny = kSmallestExact, huge = kLargestExact;
  CHECK(orient3d({0, 0, 0}, {huge, 0, 0}, {0, huge, 0}, {huge, huge, tiny}) == 1);
  CHECK(orient3d({0, 0, 0}, {huge, huge, 0}, {huge, huge, tiny}, {huge, huge, -tiny}) == 0);
  CHECK(is_exact_coordinate(0.0));
  CHECK(is_exact_coordinate(-tiny));
  CHECK_FALSE(is_exact_coordinate(std::nextafter(tiny, 0.0)));
  CHECK_FALSE(is_exact_coordinate(std::nextafter(huge, INFINITY)));
  CHECK_FALSE(is_exact_coordinate(NAN));
}

TEST_CASE("ExactSum loses nothing") {
  Source source;
  CAPTURE(source.seed());
  std::vector<double> numbers;
  for (int i = 0; i < 1000; ++i)
    numbers.push_back(std::ldexp(source.real(-1, 1), static_cast<int>(source.between(-300, 300))));
  ExactSum sum;
  for (const double x : numbers) sum.add(exact_difference(x, 0.0));
  for (const double x : numbers) sum.add(exact_difference(0.0, x));
  CHECK(sum.sign() == 0);
  sum.add(exact_difference(0x1p300, 0x1p-300));
  sum.add(exact_difference(0.0, 0x1p300));
  CHECK(sum.sign() == -1);
}

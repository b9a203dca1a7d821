#include "verify/exact_orientation.h"

namespace gaussmesh::verify {
namespace {

/// As kOrient3dError: two differences, a product and a sum make four roundings, the sum of sizes five more.
constexpr double kOrient2dError = 6 * 0x1p-53;

using Differences = std::array<Expansion<2>, 3>;

Differences exact_differences(const Point& to, const Point& from) {
  return {exact_difference(to[0], from[0]), exact_difference(to[1], from[1]), exact_difference(to[2], from[2])};
}

Expansion<16> exact_minor(const Differences& u, const Differences& v, int i, int j) {
  return u[i] * v[j] - u[j] * v[i];
}

int exact_orient2d(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const Expansion<8> plus = exact_difference(b[0], a[0]) * exact_difference(c[1], a[1]);
  const Expansion<8> minus = exact_difference(b[1], a[1]) * exact_difference(c[0], a[0]);
  return (plus - minus).sign();
}

}  // namespace

int orient2d(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const double plus = (b[0] - a[0]) * (c[1] - a[1]);
  const double minus = (b[1] - a[1]) * (c[0] - a[0]);
  const double size = std::abs(plus) + std::abs(minus);
  const double bound = kOrient2dError * size;
  if (plus - minus > bound) return 1;
  if (plus - minus < -bound) return -1;
  return size == 0.0 ? 0 : exact_orient2d(a, b, c);
}

int orient3d(const Point& a, const Point& b, const Point& c, const Point& d) { return OrientedPlane(a, b, c).side(d); }

Expansion<192> exact_determinant(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Differences u = exact_differences(b, a);
  const Differences v = exact_differences(c, a);
  const Differences w = exact_differences(d, a);
  return exact_minor(u, v, 1, 2) * w[0] + exact_minor(u, v, 2, 0) * w[1] + exact_minor(u, v, 0, 1) * w[2];
}

}  // namespace gaussmesh::verify

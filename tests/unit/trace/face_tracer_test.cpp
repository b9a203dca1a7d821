#include "trace/face_tracer.h"

#include <map>
#include <numbers>
#include <set>

#include "catch2.h"
#include "core/lattice_degenerate.h"
#include "support/fields.h"
#include "support/lattices.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

const Lattice kLattice = lattice_of(0.5);

/// A face across `axis`, from corner to corner of its rectangle.
struct Face {
  int axis = 0;
  CoordPoint lo{}, hi{};
};

/// The face at `height` along its axis, from (a_lo, b_lo) to (a_hi, b_hi) in its own axes.
Face face_at(int axis, double height, double a_lo, double a_hi, double b_lo, double b_hi) {
  Face face{axis, {}, {}};
  face.lo[axis] = face.hi[axis] = to_coord(height);
  face.lo[first_axis(axis)] = to_coord(a_lo);
  face.hi[first_axis(axis)] = to_coord(a_hi);
  face.lo[second_axis(axis)] = to_coord(b_lo);
  face.hi[second_axis(axis)] = to_coord(b_hi);
  return face;
}

/// What a face looks like when it has been traced.
struct Traced {
  std::vector<FaceRoot> roots;
  FaceCurves curves;

  CoordPoint position(std::uint32_t vertex) const {
    return vertex >= kLocalVertex ? curves.points[vertex - kLocalVertex].position : roots[vertex].position;
  }
};

Traced trace(const GaussianField& field, const Face& face, unsigned fold_axes = 0) {
  Traced result;
  const int a = first_axis(face.axis), b = second_axis(face.axis);
  CoordPoint low_high = face.lo, high_low = face.lo;
  low_high[b] = face.hi[b];
  high_low[a] = face.hi[a];
  const struct {
    CoordPoint lo;
    int axis;
  } edges[] = {{face.lo, a}, {high_low, b}, {low_high, a}, {face.lo, b}};
  EdgeRootFinder finder(field, kLattice);
  NearAtoms near;
  const Box box{to_angstrom(face.lo), to_angstrom(face.hi)};
  field.collect_near(box, near);
  const LocalModel model(near, field.decay(), box);
  for (int side = 0; side < 4; ++side) {
    const auto [lo, axis] = edges[side];
    for (const EdgeRoot& root : finder.find(near, model, axis, lo, face.hi[axis])) {
      result.roots.push_back({static_cast<std::uint32_t>(result.roots.size()), root.point.position, side, root.rise});
    }
  }
  FaceTracer tracer(field, kLattice);
  result.curves =
      tracer.trace(face.axis, face.lo, face.hi, certify_face(model, face.axis, box), result.roots, fold_axes);
  return result;
}

/// The curves of a face from end to end, closed ones with their first vertex at both ends.
std::vector<std::vector<std::uint32_t>> curves_of(const Traced& traced) {
  std::map<std::uint32_t, std::uint32_t> next;
  std::set<std::uint32_t> targets;
  for (const Link& link : traced.curves.links) {
    next[link.from] = link.to;
    targets.insert(link.to);
  }
  std::vector<std::vector<std::uint32_t>> curves;
  const auto follow = [&](std::uint32_t start) {
    auto& curve = curves.emplace_back(1, start);
    for (auto it = next.find(start); it != next.end(); it = next.find(curve.back())) {
      curve.push_back(it->second);
      next.erase(it);
    }
  };
  for (const Link& link : traced.curves.links) {
    if (!targets.contains(link.from)) follow(link.from);
  }
  while (!next.empty()) follow(next.begin()->first);
  return curves;
}

double along(const CoordPoint& p, int axis) { return to_angstrom(p[axis]); }

/// Every root ends one curve with the molecule on its left, other vertices are passed once, curves do not meet.
void check_curves(const Traced& traced, const Face& face, const ExactField& exact) {
  std::map<std::uint32_t, int> out, in;
  for (const Link& link : traced.curves.links) {
    ++out[link.from];
    ++in[link.to];
  }
  for (const FaceRoot& root : traced.roots) {
    const bool starts = root.boundary_side < 2 ? root.rise < 0 : root.rise > 0;
    CHECK(out[root.vertex] == (starts ? 1 : 0));
    CHECK(in[root.vertex] == (starts ? 0 : 1));
  }
  const int a = first_axis(face.axis), b = second_axis(face.axis);
  for (std::size_t i = 0; i < traced.curves.points.size(); ++i) {
    const auto vertex = kLocalVertex + static_cast<std::uint32_t>(i);
    CHECK(out[vertex] == 1);
    CHECK(in[vertex] == 1);
    const SurfacePoint& p = traced.curves.points[i];
    CHECK(p.position[face.axis] == face.lo[face.axis]);
    for (int k : {a, b}) {
      CHECK(p.position[k] > face.lo[k]);
      CHECK(p.position[k] < face.hi[k]);
    }
    const Vec3 at = to_angstrom(p.position);
    const auto gradient = exact.gradient(at);
    const auto in_face = std::hypot(gradient[a], gradient[b]);
    CHECK(static_cast<double>(std::abs(exact.psi(at)) / in_face) < 2e-9);
  }
  const auto plane = [&](std::uint32_t v) { return PlanePoint{traced.position(v)[a], traced.position(v)[b]}; };
  const auto& links = traced.curves.links;
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Link &s = links[i], &t = links[j];
      if (s.from == t.to || s.to == t.from) continue;
      CHECK_FALSE(segments_meet(plane(s.from), plane(s.to), plane(t.from), plane(t.to)));
    }
  }
}

/// At the vertices inside the face the molecule is to the left of the way on. For curves of little bend only.
void check_molecule_on_left(const Traced& traced, const Face& face, const ExactField& exact) {
  const int a = first_axis(face.axis), b = second_axis(face.axis);
  for (const Link& link : traced.curves.links) {
    if (link.from < kLocalVertex) continue;
    const CoordPoint p = traced.position(link.from), q = traced.position(link.to);
    const auto gradient = exact.gradient(to_angstrom(p));
    const double left = static_cast<double>(gradient[b]) * (along(q, a) - along(p, a)) -
                        static_cast<double>(gradient[a]) * (along(q, b) - along(p, b));
    CHECK(left > 0.0);
  }
}

double radius_of(const CoordPoint& p, int axis) {
  return std::hypot(along(p, first_axis(axis)), along(p, second_axis(axis)));
}

}  // namespace

TEST_CASE("a corner of a face cut off by a sphere is one chord, with the molecule on its left") {
  const std::vector<Atom> atoms = {{0, 0, 0, 2.0, 0}};
  const GaussianField field(atoms, 0.6, 1.0);
  const ExactField exact(atoms, 0.6, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double turn : {1.0, -1.0}) {
      const Face face = turn > 0 ? face_at(axis, 0.3, 1.0, 1.9, 1.0, 1.9) : face_at(axis, 0.3, -1.9, -1.0, -1.9, -1.0);
      const Traced traced = trace(field, face);
      REQUIRE(traced.curves.links.size() == 1);
      CHECK(traced.curves.points.empty());
      check_curves(traced, face, exact);
      const CoordPoint p = traced.position(traced.curves.links[0].from), q = traced.position(traced.curves.links[0].to);
      // Round the origin counter-clockwise.
      const int a = first_axis(axis), b = second_axis(axis);
      CHECK(along(p, a) * along(q, b) - along(p, b) * along(q, a) > 0.0);
    }
  }
}

TEST_CASE("arcs that turn past both axes of the face are chords from side to side") {
  const std::vector<Atom> atoms = {{0, 0, 0, 2.0, 0}};
  const GaussianField field(atoms, 0.6, 1.0);
  const ExactField exact(atoms, 0.6, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const auto& [a_lo, a_hi, b_lo, b_hi] : {std::array{-0.5, 2.5, -0.6, 2.5}, std::array{-2.5, 0.5, -0.6, 2.5},
                                                 std::array{-0.5, 2.5, -2.5, 0.6}, std::array{-2.5, 0.5, -2.5, 0.6}}) {
      CAPTURE(axis, a_lo, b_lo);
      const Face face = face_at(axis, 0.3, a_lo, a_hi, b_lo, b_hi);
      const Traced traced = trace(field, face);
      check_curves(traced, face, exact);
      CHECK(traced.curves.points.empty());
      CHECK(traced.curves.links.size() == 1);
    }
  }
}

TEST_CASE("an arc back to its own edge keeps its turning point") {
  const std::vector<Atom> atoms = {{0, 0, 0, 2.0, 0}};
  const GaussianField field(atoms, 0.6, 1.0);
  const ExactField exact(atoms, 0.6, 1.0);
  const double radius = std::sqrt(4.0 - 0.09);
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    for (const double depth : {0.4, 0.1, 0.01, 0.001}) {
      CAPTURE(depth);
      const double cut = radius - depth;
      const double half = std::sqrt(radius * radius - cut * cut);
      for (const Face& face :
           {face_at(axis, 0.3, cut, cut + 1.0, -2.0, 2.1), face_at(axis, 0.3, -2.0, 2.1, cut, cut + 1.0),
            face_at(axis, 0.3, -cut - 1.0, -cut, -2.0, 2.1), face_at(axis, 0.3, -2.0, 2.1, -cut - 1.0, -cut)}) {
        const Traced traced = trace(field, face);
        REQUIRE(traced.roots.size() == 2);
        CHECK(traced.curves.links.size() >= 2);
        check_curves(traced, face, exact);
        check_molecule_on_left(traced, face, exact);
        double farthest = 0.0;
        for (const SurfacePoint& p : traced.curves.points) {
          CHECK(radius_of(p.position, axis) == Approx(radius).margin(2e-9));
          for (int k : {first_axis(axis), second_axis(axis)})
            farthest = std::max(farthest, std::abs(along(p.position, k)));
        }
        // Within a fiftieth of the arc from where the circle is farthest.
        CHECK(radius - farthest < 0.04 * half * half / radius);
      }
    }
  }
}

TEST_CASE("a circle that closes inside a face is found, whatever its size") {
  for (const double size : {0.9, 0.3, 0.03, 0.003}) {
    CAPTURE(size);
    // The sphere reaches through the face by little: a circle of radius `size`.
    const double height = std::sqrt(4.0 - size * size);
    for (int axis = 0; axis < 3; ++axis) {
      Atom atom{0, 0, 0, 2.0, 0};
      const GaussianField field({atom}, 0.6, 1.0);
      const Face face = face_at(axis, height, -1.0, 1.17, -1.13, 1.0);
      const Traced traced = trace(field, face);
      CHECK(traced.roots.empty());
      REQUIRE(traced.curves.points.size() >= 3);
      CHECK(traced.curves.links.size() == traced.curves.points.size());
      CHECK(curves_of(traced).size() == 1);
      const ExactField exact({atom}, 0.6, 1.0);
      check_curves(traced, face, exact);
      check_molecule_on_left(traced, face, exact);
      const double cut = to_angstrom(to_coord(height)), radius = std::sqrt((2.0 - cut) * (2.0 + cut));
      const double tolerance = 1e-9 + 1e-12 / radius;
      for (const SurfacePoint& p : traced.curves.points)
        CHECK(radius_of(p.position, axis) == Approx(radius).margin(tolerance));
      // Counter-clockwise round the molecule.
      double area = 0.0;
      for (const Link& link : traced.curves.links) {
        const CoordPoint p = traced.position(link.from), q = traced.position(link.to);
        area += 0.5 * (along(p, first_axis(axis)) * along(q, second_axis(axis)) -
                       along(p, second_axis(axis)) * along(q, first_axis(axis)));
      }
      CHECK(area > 0.3 * std::numbers::pi * radius * radius);
    }
  }
}

TEST_CASE("a hole in the molecule that closes inside a face turns clockwise") {
  std::vector<Atom> ring;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 12.0;
    ring.push_back({3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.0, 1.5, 0.0});
  }
  const GaussianField field(ring, 1.0, 1.0);
  const Face face = face_at(2, 0.0, -2.7, 2.8, -2.9, 2.6);
  const Traced traced = trace(field, face);
  CHECK(traced.roots.empty());
  check_curves(traced, face, ExactField(ring, 1.0, 1.0));
  REQUIRE(curves_of(traced).size() == 1);
  double area = 0.0;
  for (const Link& link : traced.curves.links) {
    const CoordPoint p = traced.position(link.from), q = traced.position(link.to);
    area += 0.5 * (along(p, 0) * along(q, 1) - along(p, 1) * along(q, 0));
  }
  CHECK(area < -1.0);
}

TEST_CASE("on a face with four roots, one on each side, the arcs are paired as the surface is") {
  // Two atoms on the diagonal through the middle of the face; c just below and just above the value between them.
  const double distance = 3.0, r = 1.5, decay = 0.6;
  const double critical = 2.0 * std::exp(-decay * (0.25 * distance * distance - r * r));
  const double at = 0.5 * distance / std::numbers::sqrt2;
  const std::vector<Atom> atoms = {{at, at, 0.0, r, 0.0}, {-at, -at, 0.0, r, 0.0}};
  for (const double change : {1e-2, 1e-4, 1e-6}) {
    for (const int sign : {-1, 1}) {
      CAPTURE(change, sign);
      const double isovalue = critical * (1.0 + sign * change);
      const GaussianField field(atoms, decay, isovalue);
      const Face face = face_at(2, 0.0, -0.61, 0.53, -0.57, 0.66);
      const Traced traced = trace(field, face);
      REQUIRE(traced.roots.size() == 4);
      check_curves(traced, face, ExactField(atoms, decay, isovalue));
      const auto curves = curves_of(traced);
      REQUIRE(curves.size() == 2);
      for (const auto& curve : curves) {
        const int from = traced.roots[curve.front()].boundary_side, to = traced.roots[curve.back()].boundary_side;
        const std::set<int> sides = {from, to};
        if (sign < 0) {
          // Joined: the curves cut off the corners that are outside, (high, low) and (low, high).
          CHECK((sides == std::set<int>{0, 1} || sides == std::set<int>{2, 3}));
        } else {
          CHECK((sides == std::set<int>{0, 3} || sides == std::set<int>{1, 2}));
        }
      }
    }
  }
}

TEST_CASE("fold points of an axis are where the slope along it vanishes") {
  const std::uint64_t seed = 61;
  CAPTURE(seed);
  Random random(seed);
  std::size_t folds = 0, curves = 0;
  for (int cloud = 0; cloud < 400; ++cloud) {
    CAPTURE(cloud);
    const std::vector<Atom> atoms = random_cloud(random, {8, 4.0, 0.8, 2.2, 0.1});
    const GaussianField field(atoms, 0.6, 1.2);
    const ExactField exact(atoms, 0.6, 1.2);
    const int axis = static_cast<int>(random.integer(0, 2)), fold_axis = static_cast<int>(random.integer(0, 2));
    const double a = random.uniform(-3.0, 2.0), b = random.uniform(-3.0, 2.0), size = random.uniform(0.5, 2.0);
    const Face face = face_at(axis, random.uniform(-1.5, 1.5), a, a + size, b, b + size);
    const Traced traced = trace(field, face, 1u << fold_axis);
    check_curves(traced, face, exact);
    for (const SurfacePoint& p : traced.curves.points) {
      if (!(p.fold_axes >> fold_axis & 1)) continue;
      const auto gradient = exact.gradient(to_angstrom(p.position));
      CHECK(std::abs(static_cast<double>(gradient[fold_axis])) < 1e-6);
      ++folds;
    }
    curves += curves_of(traced).size();
  }
  CHECK(folds > 20);
  CHECK(curves > 20);
}

TEST_CASE("a circle has two fold points for each axis of its face") {
  const GaussianField field({{0, 0, 0, 2.0, 0}}, 0.6, 1.0);
  const double radius = std::sqrt(4.0 - 0.09);
  for (int axis = 0; axis < 3; ++axis) {
    for (const int fold_axis : {first_axis(axis), second_axis(axis)}) {
      // Closed inside the face, and cut by it in two arcs.
      for (const Face& face : {face_at(axis, 0.3, -2.3, 2.5, -2.6, 2.4), face_at(axis, 0.3, -1.1, 1.3, -2.6, 2.4),
                               face_at(axis, 0.3, -2.3, 2.5, -1.2, 1.0)}) {
        const Traced traced = trace(field, face, 1u << fold_axis);
        const int other = 3 - axis - fold_axis;
        int folds = 0;
        for (const SurfacePoint& p : traced.curves.points) {
          if (!(p.fold_axes >> fold_axis & 1)) continue;
          CHECK(std::abs(along(p.position, fold_axis)) < 1e-6);
          CHECK(std::abs(along(p.position, other)) == Approx(radius).margin(1e-8));
          ++folds;
        }
        const bool cut_off = to_angstrom(face.hi[other]) < radius;
        CHECK(folds == (cut_off ? 0 : 2));
      }
    }
  }
}

TEST_CASE("faces of clouds: every root ends one curve with the molecule on its left, and curves stay apart") {
  const std::uint64_t seed = 62;
  CAPTURE(seed);
  Random random(seed);
  std::size_t links = 0, inner = 0, many = 0;
  for (int cloud = 0; cloud < 300; ++cloud) {
    CAPTURE(cloud);
    const double decay = random.logarithmic(0.3, 4.0);
    const std::vector<Atom> atoms = random_cloud(random, {15, 6.0, 0.7, 2.0, 0.1});
    const GaussianField field(atoms, decay, 1.0);
    const ExactField exact(atoms, decay, 1.0);
    for (int i = 0; i < 5; ++i) {
      const double a = random.uniform(-4.0, 2.0), b = random.uniform(-4.0, 2.0), size = random.logarithmic(0.3, 5.0);
      const Face face =
          face_at(static_cast<int>(random.integer(0, 2)), random.uniform(-3.0, 3.0), a, a + size, b, b + size);
      const Traced traced = trace(field, face);
      check_curves(traced, face, exact);
      links += traced.curves.links.size();
      inner += traced.curves.points.size();
      many += traced.roots.size() > 4;
    }
  }
  CHECK(links > 300);
  CHECK(inner > 100);
  CHECK(many > 10);
}

TEST_CASE("a root without another end of its curve is degenerate, not left out") {
  const GaussianField field({{0, 0, 0, 1.0, 0}}, 0.6, 1.0);
  // Three quarters of a circle, which no direction makes single-valued, and which does not close.
  const Face face = face_at(2, 0.0, -0.4, 2.0, -0.4, 2.0);
  const Traced traced = trace(field, face);
  REQUIRE(traced.roots.size() == 2);
  for (std::size_t left = 0; left < 2; ++left) {
    FaceTracer tracer(field, kLattice);
    const std::span<const FaceRoot> one(&traced.roots[left], 1);
    for (const FaceCertificate certificate : {kFaceUncertified, kFaceNoClosedCurve}) {
      CHECK_THROWS_AS(tracer.trace(face.axis, face.lo, face.hi, certificate, one), LatticeDegenerate);
    }
  }
}

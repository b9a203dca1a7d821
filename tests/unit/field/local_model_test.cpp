#include "field/local_model.h"

#include <cmath>

#include "catch2.h"
#include "field/gaussian_field.h"
#include "support/fields.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

/// A box of the model and a part of it that the view is over.
struct Question {
  Box box;
  Box part;
};

/// Boxes near the surface more often than not, whole, in parts, and flat.
Question random_question(Random& random, const FieldSample& sample, const ExactField& exact) {
  Box around = random_box(random, sample.room, 0.02 * sample.box_size, 2.0 * sample.box_size);
  const Vec3 p = random_point(random, sample.room), q = random_point(random, sample.room);
  if ((exact.psi(p) >= 0.0L) != (exact.psi(q) >= 0.0L)) {
    const Vec3 on = exact.psi(p) >= 0.0L ? surface_between(exact, p, q) : surface_between(exact, q, p);
    for (int k = 0; k < 3; ++k) {
      const double lo = around.lo[k], shift = on[k] - random.uniform(lo, around.hi[k]);
      around.lo[k] += shift;
      around.hi[k] += shift;
    }
  }
  const auto kind = random.integer(0, 3);
  if (kind == 0) return {around, around};
  if (kind == 1) return {around, random_part(random, around, 0.0)};
  if (kind == 2) return {around, random_part(random, around, 0.5)};
  const Box flat = random_part(random, around, 0.5);  // a model of a face, an edge or a point
  return {flat, random_part(random, flat, 0.2)};
}

/// Corners, middles of sides and random points of a part.
std::vector<Vec3> points_of(Random& random, const Box& part) {
  std::vector<Vec3> points = grid_points(part, 3);
  for (int i = 0; i < 20; ++i) points.push_back(random_point(random, part));
  return points;
}

/// The axes, and some directions aslant.
std::vector<Direction> some_directions(Random& random) {
  std::vector<Direction> directions = {along_axis(0), along_axis(1), along_axis(2)};
  const auto slant = [&] {
    return static_cast<std::int8_t>(random.integer(-Direction::kSlantParts, Direction::kSlantParts));
  };
  for (int axis = 0; axis < 3; ++axis) directions.push_back({static_cast<std::int8_t>(axis), 1, {slant(), slant()}});
  return directions;
}

double along(const std::array<long double, 3>& gradient, const Direction& direction) {
  const Vec3 v = direction.vector();
  return static_cast<double>(gradient[0] * v[0] + gradient[1] * v[1] + gradient[2] * v[2]);
}

/// Widths of value() over boxes around p, each half as large as the one before, and by how much they exceed the
/// width of the exact values there.
struct Widths {
  std::vector<double> whole;
  std::vector<double> excess;
};

Widths widths_around(const GaussianField& field, const ExactField& exact, const Vec3& p, double size, int halvings) {
  Widths widths;
  for (int i = 0; i <= halvings; ++i, size *= 0.5) {
    const Box box = box_around(p, 0.5 * size);
    NearAtoms near;
    field.collect_near(box, near, 60.0);
    const Range range = LocalModel(near, field.decay(), box).over_all().value();
    long double lo = 1e30L, hi = -1e30L;
    for (const Vec3& q : grid_points(box, 5)) {
      lo = std::min(lo, exact.psi(q));
      hi = std::max(hi, exact.psi(q));
    }
    widths.whole.push_back(range.hi - range.lo);
    widths.excess.push_back(range.hi - range.lo - static_cast<double>(hi - lo));
  }
  return widths;
}

}  // namespace

TEST_CASE("value() contains the exact values over boxes, parts and flat parts") {
  std::size_t finite = 0, decided = 0;
  for_each_field(31, kDecays, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    for (int i = 0; i < 300; ++i) {
      const auto [box, part] = random_question(random, sample, exact);
      NearAtoms near;
      field.collect_near(box, near, random.uniform(1.0, 25.0));
      const LocalModel model(near, field.decay(), box);
      const Range range = model.over(part).value();
      finite += range.hi - range.lo < 100.0;
      decided += range.lo > 0.0 || range.hi < 0.0;
      for (const Vec3& p : points_of(random, part)) {
        const long double psi = exact.psi(p);
        REQUIRE(range.lo <= psi);
        REQUIRE(psi <= range.hi);
      }
    }
  });
  CHECK(finite > 3000);
  CHECK(decided > 1000);
}

TEST_CASE("slope() has the sign of the exact slope wherever the surface is") {
  std::size_t claims = 0, slanted_claims = 0, points = 0;
  for_each_field(32, kDecays, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    for (int i = 0; i < 150; ++i) {
      const auto [box, part] = random_question(random, sample, exact);
      NearAtoms near;
      field.collect_near(box, near, random.uniform(5.0, 25.0));
      const LocalModel model(near, field.decay(), box);
      const LocalModel::View view = model.over(part);
      std::vector<Vec3> inside, outside;
      for (const Vec3& p : points_of(random, part)) (exact.psi(p) >= 0.0L ? inside : outside).push_back(p);
      for (const Direction& direction : some_directions(random)) {
        const Range slope = view.slope(direction);
        const int sign = slope.lo > 0.0 ? 1 : slope.hi < 0.0 ? -1 : 0;
        if (sign == 0) continue;
        ++claims;
        slanted_claims += direction.is_slanted();
        for (std::size_t n = 0; n < std::min({inside.size(), outside.size(), std::size_t{10}}); ++n) {
          const Vec3 on_surface = surface_between(exact, inside[n], outside[n]);
          REQUIRE(along(exact.gradient(on_surface), direction) * sign > 0.0);
          ++points;
        }
      }
    }
  });
  CHECK(claims > 1000);
  CHECK(slanted_claims > 500);
  CHECK(points > 5000);
}

TEST_CASE("without atoms left out slope() holds everywhere in the box, surface or not") {
  std::size_t claims = 0;
  for_each_field(33, kDecays, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    for (int i = 0; i < 100; ++i) {
      const auto [box, part] = random_question(random, sample, exact);
      NearAtoms near;
      field.collect_near(box, near, 1e9);
      const LocalModel model(near, field.decay(), box);
      const LocalModel::View view = model.over(part);
      for (const Direction& direction : some_directions(random)) {
        const Range slope = view.slope(direction);
        const int sign = slope.lo > 0.0 ? 1 : slope.hi < 0.0 ? -1 : 0;
        claims += sign != 0;
        for (const Vec3& p : points_of(random, part)) {
          if (sign != 0) REQUIRE(along(exact.gradient(p), direction) * sign > 0.0);
        }
      }
    }
  });
  CHECK(claims > 1000);
}

TEST_CASE("what is proven of parts side by side is what their views prove, and holds of the exact field") {
  std::size_t all = 0, alike = 0, free_parts = 0, claims = 0, points = 0;
  for_each_field(35, kDecays, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    for (int i = 0; i < 60; ++i) {
      const Box box = random_question(random, sample, exact).box;
      NearAtoms near;
      field.collect_near(box, near, random.uniform(5.0, 25.0));
      const LocalModel model(near, field.decay(), box);
      std::vector<Box> parts(static_cast<std::size_t>(random.integer(1, PartProofs::kMost)));
      for (Box& part : parts) part = random_part(random, box, 0.3);
      const PartProofs proofs = model.prove(parts);
      const std::vector<Direction> directions = some_directions(random);
      for (std::size_t n = 0; n < parts.size(); ++n) {
        const LocalModel::View view = model.over(parts[n]);
        all += 2;
        alike += proofs.directions[n] == view.directions();
        alike += proofs.is_surely_crossed[n] == view.is_surely_crossed();
        std::vector<Vec3> inside, outside;
        for (const Vec3& p : points_of(random, parts[n])) (exact.psi(p) >= 0.0L ? inside : outside).push_back(p);
        if (proofs.directions[n] == kAllDirections) {
          ++free_parts;
          REQUIRE((inside.empty() || outside.empty()));
        }
        for (Direction direction : directions) {
          for (const int sign : {1, -1}) {
            direction.sign = static_cast<std::int8_t>(sign);
            const bool is_proven = model.prove_along(parts, direction) >> n & 1;
            ++all;
            alike += is_proven == view.proves(direction);
            const bool is_axis = !direction.is_slanted();
            if (is_axis) alike += is_proven == ((proofs.directions[n] >> (2 * direction.axis + (sign > 0)) & 1) != 0);
            all += is_axis;
            if (!is_proven) continue;
            ++claims;
            for (std::size_t p = 0; p < std::min({inside.size(), outside.size(), std::size_t{5}}); ++p) {
              const Vec3 on_surface = surface_between(exact, inside[p], outside[p]);
              REQUIRE(along(exact.gradient(on_surface), direction) * sign > 0.0);
              ++points;
            }
          }
        }
      }
    }
  });
  CHECK(static_cast<double>(all - alike) <= 1e-3 * static_cast<double>(all));  // roundings may tip the scales
  CHECK(free_parts > 300);
  CHECK(claims > 1000);
  CHECK(points > 1000);
}

TEST_CASE("where the slope is largest and about to change its sign, boxes of every size are right about it") {
  // Two atoms at +-a with 2 d a^2 = 1.2: psi' = 2 d (a tanh(2 d a x) - x) along their axis rises a little, then
  // falls.
  const double decay = 0.5, a = std::sqrt(1.2);
  std::size_t claims = 0, boxes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<std::vector<double>, 3> at{{{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}}};
    at[axis] = {a, -a};
    const NearAtoms pair = list_of({at[0], at[1], at[2], {0.0, 0.0}});
    const auto slope_at = [&](double x) { return 2.0 * decay * (a * std::tanh(2.0 * decay * a * x) - x); };
    for (double middle = -1.2; middle <= 1.2; middle += 0.04) {
      for (double half = 0.02; half < 1.0; half *= 1.2) {
        Box box{};
        box.lo[axis] = middle - half;
        box.hi[axis] = middle + half;
        const LocalModel model(pair, decay, box);
        const Range slope = model.over_all().slope(axis);
        ++boxes;
        if (slope.lo <= 0.0 && slope.hi >= 0.0) continue;
        ++claims;
        for (int i = 0; i <= 20; ++i) {
          const double x = middle - half + 0.1 * half * i;
          CAPTURE(axis, middle, half, x);
          REQUIRE((slope.lo > 0.0 ? slope_at(x) > 0.0 : slope_at(x) < 0.0));
        }
      }
    }
  }
  CHECK(claims > boxes / 4);
}

TEST_CASE("one atom: the value is a parabola, and its bounds are close to exact") {
  const NearAtoms one = list_of({{0.5}, {0.0}, {0.0}, {2.0}});
  const double decay = 0.7;
  const Box box{{1.0, -0.25, 0.5}, {1.5, 0.5, 1.0}};
  const auto psi = [&](double x, double y, double z) { return 2.0 - decay * ((x - 0.5) * (x - 0.5) + y * y + z * z); };
  const LocalModel model(one, decay, box);
  const Range value = model.over_all().value();
  CHECK(value.hi == Approx(psi(1.0, 0.0, 0.5)).margin(1e-5));  // nearest point
  CHECK(value.lo == Approx(psi(1.5, 0.5, 1.0)).margin(1e-5));  // farthest corner
  CHECK(model.over_all().slope(0).hi == Approx(-2.0 * decay * 0.5).epsilon(1e-6));
  CHECK(model.over_all().slope(2).hi == Approx(-2.0 * decay * 0.5).epsilon(1e-6));
  CHECK(model.over_all().slope(1).lo < 0.0);
  CHECK(model.over_all().slope(1).hi > 0.0);
  CHECK(model.over_all().middle_value() == Approx(psi(1.25, 0.125, 0.75)));
  CHECK(model.over_all().middle_curvature(0) == Approx(-2.0 * decay));
}

TEST_CASE("middle_value, gradient and curvature are the exact ones, to the remainder of the model") {
  const std::uint64_t seed = 34;
  CAPTURE(seed);
  Random random(seed);
  const std::vector<Atom> atoms = random_cloud(random, {15, 5.0, 0.8, 2.2, 0.1});
  const GaussianField field(atoms, 0.6, kIsovalue);
  const ExactField exact(atoms, 0.6, kIsovalue);
  for (int i = 0; i < 50; ++i) {
    const Vec3 p = random_point(random, box_around({0, 0, 0}, 3.0));
    const Box box = box_around(p, 0.2);
    NearAtoms near;
    field.collect_near(box, near, 60.0);
    const LocalModel model(near, 0.6, box);
    Vec3 q = p;
    for (double& x : q) x += random.uniform(-0.02, 0.02);
    const LocalModel::View view = model.over({q, q});
    CHECK(view.middle_value() == Approx(static_cast<double>(exact.psi(q))).margin(1e-5));
    for (int k = 0; k < 3; ++k) {
      CHECK(view.middle_gradient()[k] == Approx(static_cast<double>(exact.gradient(q)[k])).margin(1e-3));
      Vec3 before = q, after = q;
      before[k] -= 1e-4;
      after[k] += 1e-4;
      const auto curvature = (exact.gradient(after)[k] - exact.gradient(before)[k]) / (after[k] - before[k]);
      CHECK(view.middle_curvature(k) == Approx(static_cast<double>(curvature)).margin(0.05));
    }
  }
}

TEST_CASE("bounds tighten as boxes halve: the width in the first order, what is too much of it in the second") {
  const std::uint64_t seed = 35;
  CAPTURE(seed);
  Random random(seed);
  double first = 0.0, last = 0.0;
  for (int i = 0; i < 30; ++i) {
    const std::vector<Atom> atoms = random_cloud(random, {15, 5.0, 0.8, 2.2, 0.1});
    const GaussianField field(atoms, 0.6, kIsovalue);
    const ExactField exact(atoms, 0.6, kIsovalue);
    const Vec3 p = random_point(random, box_around({0, 0, 0}, 3.0));
    const Widths widths = widths_around(field, exact, p, 0.4, 4);
    CHECK(widths.whole[4] < widths.whole[0] / 8.0);  // 16 where the field is linear
    first += widths.excess[0];
    last += widths.excess[4];
  }
  CHECK(last > 0.0);
  CHECK(last < first / 150.0);  // 4^4 = 256 in the limit
}

TEST_CASE("a model of a point is exact to rounding") {
  for_each_field(36, {0.6}, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    const double rounding = sample.what == "radii of 1000 A" ? 1e-6 : 1e-9;
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = random_point(random, sample.room);
      NearAtoms near;
      field.collect_near({p, p}, near, 60.0);
      const Range range = LocalModel(near, 0.6, {p, p}).over_all().value();
      CHECK(range.hi - range.lo < rounding);
    }
  });
}

TEST_CASE("where no atom counts only the tail is left") {
  NearAtoms none;
  none.tail = 1e-5;
  none.tail_slope = 1e-5;
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const Range value = LocalModel(none, 0.6, box).over_all().value();
  CHECK(value.hi < 0.0);
  CHECK(value.hi >= std::log(1e-5));
  const Range slope = LocalModel(none, 0.6, box).over_all().slope(0);
  CHECK(slope.lo <= 0.0);
  CHECK(slope.hi >= 0.0);
  CHECK(LocalModel(NearAtoms{}, 0.6, box).over_all().value().hi < 0.0);
}

TEST_CASE("a box far too large for the model claims nothing that is wrong") {
  Random random(37);
  const std::vector<Atom> atoms = random_cloud(random, {20, 200.0, 0.8, 35.0, 0.1});
  const ExactField exact(atoms, 2.0, kIsovalue);
  const GaussianField field(atoms, 2.0, kIsovalue);
  const Box box = box_around({0, 0, 0}, 100.0);
  NearAtoms near;
  field.collect_near(box, near);
  const LocalModel model(near, 2.0, box);
  const LocalModel::View view = model.over_all();
  const Range value = view.value();
  for (const Vec3& p : grid_points(box, 9)) {
    CHECK(value.lo <= exact.psi(p));
    CHECK(exact.psi(p) <= value.hi);
  }
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(view.slope(axis).lo <= 0.0);
    CHECK(view.slope(axis).hi >= 0.0);
  }
}

#include "boxes/brick_tables.h"

#include "catch2.h"
#include "support/fields.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

BrickTables::Planes planes_of(const Vec3& lo, double cell) {
  BrickTables::Planes planes;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < BrickTables::kPlanes; ++i) planes[k][i] = lo[k] + (i - 1) * cell;
  }
  return planes;
}

Vec3 corner_of(const BrickTables::Planes& planes, int i, int j, int k) {
  return {planes[0][i + 1], planes[1][j + 1], planes[2][k + 1]};
}

Box cell_of(const BrickTables::Planes& planes, int i, int j, int k) {
  return {corner_of(planes, i, j, k), corner_of(planes, i + 1, j + 1, k + 1)};
}

/// What reaches from the lowest corner of a box along the axes in `extent`.
Box part_of(const Box& box, unsigned extent) {
  Box part = box;
  for (int n = 0; n < 3; ++n) {
    if (!(extent >> n & 1)) part.hi[n] = part.lo[n];
  }
  return part;
}

Box box_of(const BrickTables::Planes& planes) {
  return {corner_of(planes, 0, 0, 0), corner_of(planes, kBrickCells, kBrickCells, kBrickCells)};
}

/// Whether some line through the box along the axis leaves {phi > c} (sign 1) or enters it (sign -1) on the way up.
bool passes_against(const ExactField& exact, const Box& box, int axis, int sign) {
  constexpr int kLines = 3, kSteps = 6;
  const auto place = [&](int k, double part) { return box.lo[k] + part * (box.hi[k] - box.lo[k]); };
  for (int line = 0; line < kLines * kLines; ++line) {
    Vec3 p;
    p[(axis + 1) % 3] = place((axis + 1) % 3, (line % kLines) / (kLines - 1.0));
    p[(axis + 2) % 3] = place((axis + 2) % 3, (line / kLines) / (kLines - 1.0));
    bool was_inside = false;
    for (int step = 0; step <= kSteps; ++step) {
      p[axis] = place(axis, step / double(kSteps));
      const bool inside = exact.psi(p) >= 0.0L;
      if (step > 0 && (sign > 0 ? was_inside && !inside : !was_inside && inside)) return true;
      was_inside = inside;
    }
  }
  return false;
}

}  // namespace

TEST_CASE(
    "no cell, face or edge that the surface passes through is dropped, and corners are on the side where they are") {
  const std::uint64_t seed = 46;
  CAPTURE(seed);
  Random random(seed);
  BrickTables tables;
  std::size_t crossed = 0, dropped = 0, known = 0, corners = 0, directions = 0, free_parts = 0, uncrossed_parts = 0;
  for (const FieldSample& sample : field_samples(seed)) {
    CAPTURE(sample.what);
    for (int n = 0; n < 8; ++n) {
      const double decay = random.logarithmic(0.3, 3.0), isovalue = random.logarithmic(0.3, 3.0);
      CAPTURE(decay, isovalue, n);
      const GaussianField field(sample.atoms, decay, isovalue);
      const ExactField exact(sample.atoms, decay, isovalue);
      const double cell = random.logarithmic(0.1, 1.5);
      const auto planes = planes_of(random_point(random, sample.room), cell);
      NearAtoms near;
      field.collect_near(box_of(planes), near);
      tables.build(near, decay, planes);
      for (int i = 0; i < kBrickCells; ++i) {
        for (int j = 0; j < kBrickCells; ++j) {
          for (int k = 0; k < kBrickCells; ++k) {
            const bool inside = exact.psi(corner_of(planes, i, j, k)) >= 0.0L;
            const Side side = tables.corner(i, j, k);
            ++corners;
            known += side != Side::kUnknown;
            if (side != Side::kUnknown) REQUIRE((side == Side::kInside) == inside);
            bool is_crossed = false;
            for (const Vec3& p : grid_points(cell_of(planes, i, j, k), 3)) {
              is_crossed = is_crossed || (exact.psi(p) >= 0.0L) != inside;
            }
            if (is_crossed) REQUIRE(tables.may_cross(i, j, k));
            if (tables.is_crossed(i, j, k)) REQUIRE(is_crossed);
            for (unsigned extent = 1; extent < 8 && tables.may_cross(i, j, k); ++extent) {
              CAPTURE(i, j, k, extent);
              const Box part = part_of(cell_of(planes, i, j, k), extent);
              bool part_is_crossed = false;
              const bool part_is_inside = exact.psi(part.lo) >= 0.0L;
              for (const Vec3& p : grid_points(part, 3)) {
                part_is_crossed = part_is_crossed || (exact.psi(p) >= 0.0L) != part_is_inside;
              }
              const bool is_free = tables.is_free(i, j, k, extent);
              if (is_free) REQUIRE_FALSE(part_is_crossed);
              uncrossed_parts += extent < 7 && !part_is_crossed;
              free_parts += extent < 7 && is_free;
              if (!part_is_crossed) continue;
              const unsigned proven = tables.directions(i, j, k, extent);
              for (int direction = 0; direction < 6; ++direction) {
                if (!(proven >> direction & 1)) continue;
                ++directions;
                REQUIRE_FALSE(passes_against(exact, part, direction / 2, direction % 2 ? 1 : -1));
              }
            }
            crossed += is_crossed;
            dropped += !tables.may_cross(i, j, k);
          }
        }
      }
    }
  }
  CHECK(crossed > 500);
  CHECK(dropped > 3 * crossed);
  CHECK(known > corners * 3 / 4);
  CHECK(directions > 3 * crossed);
  CHECK(free_parts > uncrossed_parts / 10);
}

TEST_CASE("corners tell nearly where an edge meets the surface, and which axis is the steepest") {
  Random random(48);
  const std::vector<Atom> atoms = random_cloud(random, {30, 4.0, 1.0, 2.0, 0.0});
  const GaussianField field(atoms, 0.6, 1.7);
  const ExactField exact(atoms, 0.6, 1.7);
  const double cell = 0.5;
  const auto planes = planes_of({1.1, -2.3, -1.7}, cell);
  NearAtoms near;
  field.collect_near(box_of(planes), near);
  BrickTables tables;
  tables.build(near, 0.6, planes);
  std::size_t roots = 0, good = 0, steep = 0;
  for (int n = 0; n < kBrickCells * kBrickCells * kBrickCells; ++n) {
    const int i = n % kBrickCells, j = n / kBrickCells % kBrickCells, k = n / kBrickCells / kBrickCells;
    CAPTURE(i, j, k);
    const Box box = cell_of(planes, i, j, k);
    Vec3 change{};  // from face to face, over all corners
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p = corner_of(planes, i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
      for (int axis = 0; axis < 3; ++axis) change[axis] += (corner >> axis & 1 ? 1 : -1) * double(exact.psi(p));
    }
    double largest = 0.0;
    for (const double by : change) largest = std::max(largest, std::abs(by));
    CHECK(std::abs(change[tables.steepest_axis(i, j, k)]) > 0.999 * largest);
    steep += largest > 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double guess = tables.zero_on_edge(i, j, k, axis);
      Vec3 p = box.lo, end = box.lo;
      end[axis] = box.hi[axis];
      const bool is_crossed = (exact.psi(p) >= 0.0L) != (exact.psi(end) >= 0.0L);
      CHECK(std::isnan(guess) == !is_crossed);
      if (!is_crossed) continue;
      ++roots;
      double lo = box.lo[axis], hi = box.hi[axis];
      for (int halving = 0; halving < 40; ++halving) {
        p[axis] = 0.5 * (lo + hi);
        ((exact.psi(p) >= 0.0L) == (exact.psi(end) >= 0.0L) ? hi : lo) = p[axis];
      }
      good += std::abs(guess - lo) < 0.02 * cell;
    }
  }
  CHECK(steep > 100);
  CHECK(roots > 100);
  CHECK(double(good) > 0.9 * double(roots));
}

TEST_CASE("a brick near atoms of any number: blocks of atoms add up") {
  Random random(47);
  const std::vector<Atom> atoms = random_cloud(random, {1500, 6.0, 0.2, 0.6, 0.0});
  const GaussianField field(atoms, 0.6, 20.0);
  const ExactField exact(atoms, 0.6, 20.0);
  const auto planes = planes_of({-4.1, -3.9, -4.0}, 1.0);
  NearAtoms near;
  field.collect_near(box_of(planes), near);
  REQUIRE(near.size() > 1000);
  BrickTables tables;
  tables.build(near, 0.6, planes);
  for (int i = 0; i <= kBrickCells; ++i) {
    const bool inside = exact.psi(corner_of(planes, i, i, 8 - i)) >= 0.0L;
    CHECK(tables.corner(i, i, 8 - i) == (inside ? Side::kInside : Side::kOutside));
  }
}

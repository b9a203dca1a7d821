#include "field/gaussian_field.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "catch2.h"
#include "core/vectors.h"
#include "support/fields.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

/// The atoms that are not in the list, told by their centres.
std::vector<Atom> left_out(const std::vector<Atom>& atoms, const NearAtoms& near) {
  std::map<std::tuple<double, double, double>, int> kept;
  for (std::size_t i = 0; i < near.size(); ++i) ++kept[{near.x[i], near.y[i], near.z[i]}];
  std::vector<Atom> rest;
  for (const Atom& a : atoms) {
    const auto it = kept.find({a.x, a.y, a.z});
    if (it == kept.end() || it->second == 0) {
      rest.push_back(a);
    } else {
      --it->second;
    }
  }
  return rest;
}

/// Tail bounds against the exact sums over the atoms left out. @return how many those are
std::size_t check_tail(const std::vector<Atom>& atoms, double decay, const NearAtoms& near, const Box& box,
                       Random& random) {
  const std::vector<Atom> rest = left_out(atoms, near);
  CHECK(rest.size() + near.size() == atoms.size());
  if (rest.empty()) {
    CHECK(near.tail == 0.0);
    return 0;
  }
  const ExactField exact(rest, decay, kIsovalue);
  for (int i = 0; i < 20; ++i) {
    // Corners first: the nearest point of a box is often one.
    Vec3 p = random_point(random, box);
    for (int k = 0; k < 3; ++k) p[k] = i < 8 ? (i >> k & 1 ? box.hi : box.lo)[k] : p[k];
    const long double value = exact.relative(p);
    REQUIRE(value <= near.tail);
    for (const long double g : exact.gradient(p)) REQUIRE(std::abs(g * value) <= near.tail_slope);
  }
  return rest.size();
}

bool same_bits(const NearAtoms& a, const NearAtoms& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w && a.tail == b.tail && a.tail_slope == b.tail_slope;
}

}  // namespace

TEST_CASE("the atoms left out add no more than the tail to the field and its slope") {
  std::size_t out = 0;
  for_each_field(11, kDecays, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    for (int i = 0; i < 100; ++i) {
      const Box box = random_box(random, sample.room, 0.01, 4.0);
      const double cut = random.uniform(-2.0, 40.0);
      CAPTURE(cut);
      NearAtoms near;
      field.collect_near(box, near, cut);
      out += check_tail(sample.atoms, field.decay(), near, box, random);
    }
  });
  CHECK(out > 10000);
}

TEST_CASE("the tail counts clusters of far atoms as a whole, and still bounds them") {
  const std::uint64_t seed = 12;
  CAPTURE(seed);
  Random random(seed);
  std::vector<Atom> atoms = random_cloud(random, {40, 5.0, 0.8, 2.0, 0.2});
  for (int cluster = 0; cluster < 5; ++cluster) {
    for (Atom a : random_cloud(random, {100, 4.0, 0.0, 2.5, 0.2})) {
      a.x += 9.0 + 2.0 * cluster;
      atoms.push_back(a);
    }
  }
  const GaussianField field(atoms, 0.5, kIsovalue);
  std::size_t out = 0;
  for (int i = 0; i < 100; ++i) {
    const Box box = random_box(random, box_around({0, 0, 0}, 4.0), 0.1, 4.0);
    NearAtoms near;
    field.collect_near(box, near, random.uniform(0.0, 25.0));
    out += check_tail(atoms, 0.5, near, box, random);
  }
  CHECK(out > 10000);
}

TEST_CASE("among many atoms the tail is not much more than they can add") {
  std::vector<Atom> atoms;  // as close as in a protein
  for (int i = 0; i < 32 * 32 * 32; ++i) atoms.push_back({2.1 * (i % 32), 2.1 * (i / 32 % 32), 2.1 * (i / 1024), 1.6});
  const double decay = 0.6;
  const GaussianField field(atoms, decay, kIsovalue);
  for (const double size : {0.1, 2.0, 8.0}) {
    CAPTURE(size);
    const Box box{{30.0, 31.0, 32.0}, {30.0 + size, 31.0 + size, 32.0 + size}};
    NearAtoms near;
    field.collect_near(box, near);
    double at_most = 0.0;
    for (const Atom& a : left_out(atoms, near)) {
      const double dx = gap(a.x, box.lo[0], box.hi[0]), dy = gap(a.y, box.lo[1], box.hi[1]),
                   dz = gap(a.z, box.lo[2], box.hi[2]);
      at_most += std::exp(decay * (a.radius * a.radius - dx * dx - dy * dy - dz * dz)) / kIsovalue;
    }
    CHECK(near.tail >= at_most);
    CHECK(near.tail <= 2.0 * at_most);
  }
}

TEST_CASE("restricting a list to a part of its box keeps the bound") {
  for_each_field(13, {0.8}, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    for (int i = 0; i < 50; ++i) {
      const Box box = random_box(random, sample.room, 0.5, 6.0);
      const Box part = random_part(random, box, 0.2);
      NearAtoms parent, child, direct;
      const double cut = random.uniform(1.0, 25.0);
      field.collect_near(box, parent, cut);
      child.restrict_from(parent, part, field.decay(), cut);
      check_tail(sample.atoms, field.decay(), child, part, random);
      field.collect_near(part, direct, cut);
      CHECK(child.size() == direct.size());
    }
  });
}

TEST_CASE("with no cut every atom is in the list, with its log-weight") {
  Random random(14);
  const std::vector<Atom> atoms = random_cloud(random, {300, 30.0, 0.0, 2.0, 0.3});
  const GaussianField field(atoms, 0.7, kIsovalue);
  CHECK(field.size() == atoms.size());
  NearAtoms near;
  field.collect_near({{0, 0, 0}, {1, 1, 1}}, near, 1e9);
  CHECK(near.size() == atoms.size());
  CHECK(near.tail == 0.0);
  CHECK(left_out(atoms, near).empty());
  std::vector<double> weights;
  for (const Atom& a : atoms) weights.push_back(0.7 * a.radius * a.radius - std::log(kIsovalue));
  std::vector<double> found(near.w.begin(), near.w.begin() + static_cast<std::ptrdiff_t>(near.size()));
  std::sort(weights.begin(), weights.end());
  std::sort(found.begin(), found.end());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(weights[i]).epsilon(1e-14));
}

TEST_CASE("lists have the same bits for any order of the atoms in the file") {
  const std::uint64_t seed = 15;
  CAPTURE(seed);
  Random random(seed);
  std::vector<Atom> atoms = random_cloud(random, {200, 15.0, 0.5, 2.2, 0.1});
  for (int i = 0; i < 20; ++i) atoms.push_back(atoms[7 * i]);                    // doubles,
  for (int i = 0; i < 20; ++i) atoms.push_back({atoms[5 * i].x, 0, 0, 1.5, 0});  // ties in x,
  for (int i = 0; i < 5; ++i) atoms.push_back({1, 1, 1, 0.5 * i, 0});            // and in all but the radius
  const GaussianField field(atoms, 0.6, kIsovalue);
  for (int order = 0; order < 5; ++order) {
    std::vector<Atom> shuffled = atoms;
    random.shuffle(shuffled);
    const GaussianField other(shuffled, 0.6, kIsovalue);
    CHECK(field.bounding_box().lo == other.bounding_box().lo);
    CHECK(field.bounding_box().hi == other.bounding_box().hi);
    for (int i = 0; i < 50; ++i) {
      const Box box = random_box(random, box_around({0, 0, 0}, 8.0), 0.1, 8.0);
      NearAtoms a, b;
      field.collect_near(box, a);
      other.collect_near(box, b);
      CHECK(same_bits(a, b));
    }
  }
}

TEST_CASE("crude bounds hold at every point of the box") {
  std::size_t inside = 0, outside = 0;
  for_each_field(16, kDecays, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    for (int i = 0; i < 100; ++i) {
      Box room = sample.room;
      for (int k = 0; k < 3; ++k) room.lo[k] -= 5.0, room.hi[k] += 5.0;
      const Box box = random_box(random, room, 0.1, 6.0);
      NearAtoms near;
      field.collect_near(box, near);
      const CrudeBounds bounds = crude_bounds(near, box, field.decay());
      inside += bounds.inside;
      outside += bounds.upper < 1.0;
      for (const Vec3& p : grid_points(box, 4)) {
        const long double psi = exact.psi(p);
        if (psi < 600.0L) REQUIRE(std::exp(psi) <= bounds.upper);  // beyond, upper is clamped and large anyway
        if (bounds.inside) REQUIRE(psi > 0.0L);
      }
    }
  });
  CHECK(inside > 50);
  CHECK(outside > 50);
}

TEST_CASE("crude bounds of one atom are its values at the nearest and the farthest point") {
  const double w = 1.2, decay = 0.5;
  NearAtoms atoms = list_of({{0.0}, {0.0}, {0.0}, {w}});
  const Box box{{1, -1, 2}, {2, 2, 3}};  // nearest (1, 0, 2), farthest (2, 2, 3)
  const CrudeBounds bounds = crude_bounds(atoms, box, decay);
  CHECK(bounds.upper == Approx(std::exp(w - 0.5 * 5.0)).epsilon(1e-7));
  CHECK_FALSE(bounds.inside);
  atoms.w[0] = 0.5 * 17.0 + 1e-6;
  CHECK(crude_bounds(atoms, box, decay).inside);
  atoms.w[0] = 0.5 * 17.0 - 1e-6;
  CHECK_FALSE(crude_bounds(atoms, box, decay).inside);
}

TEST_CASE("there is no surface outside the bounding box") {
  for_each_field(17, kDecays, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    const Box bounds = field.bounding_box();
    for (int i = 0; i < 300; ++i) {
      Vec3 p = random_point(random, bounds);
      const auto axis = random.integer(0, 2);
      p[axis] = random.integer(0, 1) ? bounds.hi[axis] : bounds.lo[axis];
      REQUIRE(exact.psi(p) < 0.0L);
    }
  });
  // And it is no larger than it must be: one atom's is its sphere, but for the share of 1 / n.
  const Box bounds = GaussianField({{1, 2, 3, 2.0, 0}}, 0.5, 1.0).bounding_box();
  CHECK(bounds.hi[0] - 1.0 < sphere_radius(2.0, 0.5, 0.5) + 1e-3);
  CHECK(bounds.hi[0] - 1.0 >= 2.0);
}

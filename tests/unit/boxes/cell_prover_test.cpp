#include "boxes/cell_prover.h"

#include "boxes/brick_cells.h"
#include "catch2.h"
#include "support/fields.h"
#include "support/lattices.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

using Kind = CellCertificate::Kind;

/// What is wrong with a certificate as far as a dense look at the cell tells; empty: nothing.
std::string refute(const CellCertificate& certificate, const ExactField& exact, const Box& box, int samples) {
  if (certificate.kind == Kind::kUncertified) return {};
  const std::vector<Vec3> points = grid_points(box, samples);
  std::vector<bool> inside;
  for (const Vec3& p : points) inside.push_back(exact.psi(p) >= 0.0L);
  if (certificate.kind == Kind::kExcluded) {
    const bool one_side = std::all_of(inside.begin(), inside.end(), [&](bool b) { return b == inside[0]; });
    return one_side ? "" : "an excluded cell has a change of sign";
  }
  // Along the direction: from outside to inside where phi grows, and never back.
  const auto [axis, sign, slant] = certificate.direction;
  const Vec3 along = certificate.direction.vector();
  const double step = (box.hi[axis] - box.lo[axis]) / (samples - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vec3 next = points[i];
    bool in_box = true;
    for (int k = 0; k < 3; ++k) {
      next[k] += step * along[k];
      in_box = in_box && next[k] >= box.lo[k] && next[k] <= box.hi[k];
    }
    if (!in_box) continue;
    const bool next_inside = exact.psi(next) >= 0.0L;
    if (inside[i] == next_inside) continue;
    if (next_inside != (sign > 0)) return "the surface is crossed against the certificate";
    const Vec3 on = inside[i] ? surface_between(exact, points[i], next) : surface_between(exact, next, points[i]);
    const auto gradient = exact.gradient(on);
    const double slope = static_cast<double>(gradient[0] * along[0] + gradient[1] * along[1] + gradient[2] * along[2]);
    if (slope * sign <= 0.0) return "the slope on the surface is against the certificate";
  }
  return {};
}

CellCertificate certify(const GaussianField& field, const Box& box, int depth) {
  NearAtoms near;
  field.collect_near(box, near);
  CellProver prover(field.decay());
  return prover.certify(near, LocalModel(near, field.decay(), box), depth);
}

}  // namespace

TEST_CASE("no certificate is refuted by a dense look at its cell") {
  const std::uint64_t seed = 42;
  CAPTURE(seed);
  Random random(seed);
  std::size_t excluded = 0, monotone = 0, slanted = 0, uncertified = 0;
  for (int cloud = 0; cloud < 20; ++cloud) {
    const double decay = random.logarithmic(0.3, 3.0), isovalue = random.logarithmic(0.5, 2.0);
    const std::vector<Atom> atoms = random_cloud(random, {12, 6.0, 0.8, 2.2, 0.1});
    const GaussianField field(atoms, decay, isovalue);
    const ExactField exact(atoms, decay, isovalue);
    for (int i = 0; i < 100; ++i) {
      const Box box = box_around(random_point(random, box_around({0, 0, 0}, 5.0)), random.logarithmic(0.05, 2.0));
      const CellCertificate certificate = certify(field, box, 3);
      excluded += certificate.kind == Kind::kExcluded;
      monotone += certificate.kind == Kind::kMonotone;
      uncertified += certificate.kind == Kind::kUncertified;
      slanted += certificate.direction.is_slanted();
      CAPTURE(decay, isovalue, int(certificate.direction.axis), int(certificate.direction.sign));
      REQUIRE(refute(certificate, exact, box, 9) == "");
    }
  }
  CHECK(excluded > 100);
  CHECK(monotone > 100);
  CHECK(slanted > 5);
  CHECK(uncertified > 0);
}

TEST_CASE("cells with radii of 35 and 1000 A have certificates that hold") {
  for_each_field(43, {0.6}, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    std::size_t certified = 0;
    for (int i = 0; i < 60; ++i) {
      const Box box = box_around(random_point(random, sample.room), 0.2);
      const CellCertificate certificate = certify(field, box, 3);
      certified += certificate.kind != Kind::kUncertified;
      REQUIRE(refute(certificate, exact, box, 7) == "");
    }
    CHECK(certified > 50);
  });
}

TEST_CASE("on a sphere the axis of the certificate is one that the sphere is single-valued along") {
  const GaussianField field({{0, 0, 0, 2.0, 0}}, 0.6, 1.0);
  const Box top{{-0.3, -0.3, 1.8}, {0.3, 0.3, 2.4}};
  const CellCertificate certificate = certify(field, top, 3);
  CHECK(certificate.kind == Kind::kMonotone);
  CHECK(certificate.direction.axis == 2);
  CHECK(certificate.direction.sign == -1);
  CHECK(certify(field, {{0.5, -2.4, -0.3}, {1.1, -1.8, 0.3}}, 3).direction.axis == 1);
  CHECK(certify(field, {{0.5, -2.4, -0.3}, {1.1, -1.8, 0.3}}, 3).direction.sign == 1);
  CHECK(certify(field, box_around({0, 0, 0}, 0.5), 3).kind == Kind::kExcluded);
  CHECK(certify(field, box_around({4, 0, 0}, 0.5), 3).kind == Kind::kExcluded);
  CHECK(certify(field, box_around({0, 0, 0}, 3.0), 4).kind == Kind::kUncertified);
}

TEST_CASE("where the surface bends round all axes, a slanted direction is found in the midst of its gradients") {
  // The octant of a sphere round its corner: the gradient is along each of the axes somewhere, and a little beyond.
  const GaussianField field({{0, 0, 0, 2.0, 0}}, 0.6, 1.0);
  const CellCertificate certificate = certify(field, {{-0.2, -0.2, -0.2}, {2.1, 2.1, 2.1}}, 4);
  CHECK(certificate.kind == Kind::kMonotone);
  CHECK(certificate.single_axes == 0);
  REQUIRE(certificate.direction.is_slanted());
  const Vec3 along = certificate.direction.vector();
  for (int k = 0; k < 3; ++k) CHECK(along[k] * certificate.direction.sign < 0.0);
}

TEST_CASE("a proof through sub-boxes finds the axis of a cell that bounds over the whole cell do not show") {
  const GaussianField field({{0, 0, 0, 2.0, 0}, {0, 0, 0.5, 2.0, 0}}, 0.6, 1.0);
  const Box upper_half{{-2.5, -2.5, 0.4}, {2.5, 2.5, 5.4}};  // somewhat less: single-valued along z alone
  CHECK(certify(field, upper_half, 0).kind == CellCertificate::Kind::kUncertified);
  const CellCertificate found = certify(field, upper_half, 8);
  CHECK(found.kind == CellCertificate::Kind::kMonotone);
  CHECK(found.direction.axis == 2);
  CHECK(found.direction.sign == -1);
}

TEST_CASE("walking bricks finds every cell that the surface passes through, and each once") {
  const std::uint64_t seed = 44;
  CAPTURE(seed);
  Random random(seed);
  std::size_t crossed = 0;
  for (int cloud = 0; cloud < 6; ++cloud) {
    const double decay = random.logarithmic(0.3, 3.0), spacing = random.logarithmic(0.2, 1.5);
    CAPTURE(decay, spacing);
    const std::vector<Atom> atoms = random_cloud(random, {8, 5.0, 0.8, 2.2, 0.1});
    const GaussianField field(atoms, decay, 1.2);
    const ExactField exact(atoms, decay, 1.2);
    const Lattice lattice = lattice_of(spacing);
    std::vector<FineIndex> cells;
    BrickWalker walker(field, lattice);
    for (const BrickIndex& brick : find_bricks(field, lattice)) {
      walker.walk(brick, [&](const BrickWalker::Cell& cell) {
        cells.push_back(cell.lo);
        CHECK(cell.certificate.kind != Kind::kExcluded);
        CHECK(cell.model.box().lo == cell_box(lattice, {cell.lo, 0}).lo);
        CHECK(cell.model.get().box().hi == cell_box(lattice, {cell.lo, 0}).hi);
      });
    }
    std::sort(cells.begin(), cells.end());
    CHECK(std::adjacent_find(cells.begin(), cells.end()) == cells.end());
    for (int i = 0; i < 1500; ++i) {
      const Vec3 p = random_point(random, box_around({0, 0, 0}, 4.0)),
                 q = random_point(random, box_around({0, 0, 0}, 6.0));
      if (exact.psi(p) < 0.0L || exact.psi(q) >= 0.0L) continue;
      const CellKey cell = cell_at(lattice, surface_between(exact, p, q));
      REQUIRE(std::binary_search(cells.begin(), cells.end(), cell.lo));
      ++crossed;
    }
    const std::vector<std::size_t> levels = walker.boxes_by_level();
    CHECK(levels[0] >= cells.size());
  }
  CHECK(crossed > 500);
}

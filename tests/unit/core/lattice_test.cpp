#include "core/lattice.h"

#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "catch2.h"
#include "support/random.h"

using namespace gaussmesh;
using testing::Random;

namespace {

/// A coordinate in decimal, with its nine digits behind the point.
std::string decimal(Coord c) {
  const Coord size = c < 0 ? -c : c;
  std::ostringstream text;
  text << (c < 0 ? "-" : "") << size / 1000000000 << '.' << std::setw(9) << std::setfill('0') << size % 1000000000;
  return text.str();
}

const Lattice kLattice{122070, {185965001, 207105002, -118035003}};

}  // namespace

TEST_CASE("a coordinate in A is what a reader makes of its nine decimals") {
  for (const Coord c : {Coord{0}, Coord{1}, Coord{-1}, Coord{999999999}, Coord{-1000000001}, Coord{1234567890123456}}) {
    CHECK(to_angstrom(c) == std::strtod(decimal(c).c_str(), nullptr));
  }
  const std::uint64_t seed = 1;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 200000; ++i) {
    // All sizes up to the limit of coordinates, 1e6 A, and a little more.
    const Coord c = random.integer(-2000000000000000, 2000000000000000) >> random.integer(0, 50);
    if (to_angstrom(c) != std::strtod(decimal(c).c_str(), nullptr)) FAIL(decimal(c));
  }
}

TEST_CASE("neighbouring coordinates stay apart in A within the limits of coordinates") {
  for (const Coord c : {Coord{0}, Coord{1000000000000000}, Coord{-1000000000000000}, Coord{3000000000000000}}) {
    CHECK(to_angstrom(c) < to_angstrom(c + 1));
  }
}

TEST_CASE("lattice planes are equally far apart, also below zero") {
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(kLattice.plane(axis, 0) == kLattice.offset[axis]);
    for (const std::int64_t n : {std::int64_t{-1000000000}, -kFinePerCell - 1, std::int64_t{-1}, std::int64_t{0},
                                 std::int64_t{1}, kFinePerCell, std::int64_t{1000000000}}) {
      CHECK(kLattice.plane(axis, n + 1) - kLattice.plane(axis, n) == kLattice.step);
    }
  }
  CHECK(kLattice.cell_size() == Approx(122070e-9 * static_cast<double>(kFinePerCell)));
}

TEST_CASE("the eight children of a cell fill it") {
  const CellKey cell{{-kFinePerCell, 2 * kFinePerCell, 0}, 0};
  for (const CellKey& parent : {cell, child_cell(cell, 5), child_cell(child_cell(cell, 2), 7)}) {
    std::set<FineIndex> corners;
    for (int c = 0; c < 8; ++c) {
      const CellKey child = child_cell(parent, c);
      CHECK(child.level == parent.level + 1);
      const FineIndex hi = cell_hi(child);
      for (int k = 0; k < 3; ++k) {
        CHECK(hi[k] - child.lo[k] == fine_size(parent.level) / 2);
        CHECK(child.lo[k] >= parent.lo[k]);
        CHECK(hi[k] <= cell_hi(parent)[k]);
        CHECK((child.lo[k] > parent.lo[k]) == bool(c >> k & 1));
      }
      corners.insert(child.lo);
    }
    CHECK(corners.size() == 8);
  }
}

TEST_CASE("cells that touch share their planes to the last bit") {
  const CellKey cell{{-kFinePerCell, 2 * kFinePerCell, 0}, 0};
  for (int k = 0; k < 3; ++k) {
    const CellKey next{moved(cell.lo, k, kFinePerCell), 0};
    CHECK(cell_box(kLattice, cell).hi[k] == cell_box(kLattice, next).lo[k]);
    const CellKey small = child_cell(child_cell(next, 0), 0);
    CHECK(cell_box(kLattice, cell).hi[k] == cell_box(kLattice, small).lo[k]);
  }
}

TEST_CASE("a cell of the finest level is one step wide") {
  CellKey cell{{0, 0, 0}, 0};
  while (cell.level < kMaxLevel) cell = child_cell(cell, 7);
  CHECK(fine_size(cell.level) == 1);
  CHECK(cell.lo == FineIndex{kFinePerCell - 1, kFinePerCell - 1, kFinePerCell - 1});
}

TEST_CASE("rounding down finds the cell below, on either side of zero") {
  for (const std::int64_t size : {std::int64_t{1}, std::int64_t{8}, kFinePerCell}) {
    for (std::int64_t n = -3 * size; n <= 3 * size; n += size > 8 ? size / 7 : 1) {
      const std::int64_t low = round_down(n, size);
      CHECK(low % size == 0);
      CHECK(low <= n);
      CHECK(n < low + size);
    }
  }
}

TEST_CASE("hashes of what lies in one cell of the level above are different neighbours") {
  for (const CellKey& around : {CellKey{{0, 0, 0}, 0}, CellKey{{-3 * kFinePerCell, 0, 5 * kFinePerCell}, 0},
                                CellKey{{-fine_size(4), fine_size(4), 7 * fine_size(4)}, 4}}) {
    std::vector<std::size_t> hashes;
    for (int c = 0; c < 8; ++c) {
      const CellKey child = child_cell(around, c);
      for (unsigned kind = 0; kind < 3; ++kind) hashes.push_back(lattice_hash<3>(child.lo, child.level, kind));
    }
    std::sort(hashes.begin(), hashes.end());
    for (std::size_t i = 1; i < hashes.size(); ++i) CHECK(hashes[i] == hashes[0] + i);
  }
}

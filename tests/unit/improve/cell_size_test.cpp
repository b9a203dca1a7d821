// Cells are as large as the triangles to come allow.
#include "improve/cell_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch2.h"
#include "support/meshing.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

constexpr double kDecay = 0.6;

double cell_for(const std::vector<Atom>& atoms, double spacing, double tolerance = 0.0) {
  return suitable_cell_size(
      sample_sizes(GaussianField(atoms, kDecay, 1.0), {.spacing = spacing, .tolerance = tolerance}), spacing);
}

MeshOptions options_for(double spacing) {
  MeshOptions options;
  options.decay = kDecay;
  options.isovalue = 1.0;
  options.spacing = spacing;
  return options;
}

}  // namespace

TEST_CASE("where the spacing is what limits triangles it is the size of the cells") {
  CHECK(cell_for({{1, 2, 3, 2.0, 0}}, 0.5) == 0.5);
  CHECK(cell_for(atom_ring(12, 5.0, 1.5), 0.2) == 0.2);
}

TEST_CASE("on a sphere cells follow the size that its curvature or the tolerance asks for") {
  const double radius = 2.0, tolerance = 1e-3;
  const std::vector<Atom> sphere = {{1, 2, 3, radius, 0}};
  const double by_curvature = cell_for(sphere, 100.0), by_tolerance = cell_for(sphere, 1.0, tolerance);
  CHECK(by_curvature == Approx(kTurnPerEdge * radius).epsilon(1e-3));
  CHECK(by_tolerance < 0.1 * by_curvature);
  CHECK(cell_for(sphere, 1.0, 4.0 * tolerance) == Approx(2.0 * by_tolerance).epsilon(1e-3));
  CHECK(cell_for({{1, 2, 3, 2.0 * radius, 0}}, 100.0) == Approx(2.0 * by_curvature).epsilon(1e-3));
  CHECK(cell_for(sphere, 100.0, tolerance) == by_tolerance);  // however far below the spacing that is
}

TEST_CASE("where there are creases cells are no larger than a part of an atom, whatever the spacing") {
  constexpr double kRadius = 1.7;
  const auto cell_of_grid = [](double distance, double spacing) {
    std::vector<Atom> grid;
    for (int i = 0; i < 64; ++i) {
      grid.push_back({distance * (i % 4), distance * (i / 4 % 4), distance * (i / 16), kRadius, 0});
    }
    return cell_for(grid, spacing);
  };
  CHECK(cell_of_grid(3.0, 4.0) < 0.5 * kRadius);
  CHECK(cell_of_grid(3.0, 1.0) == cell_of_grid(3.0, 4.0));
  CHECK(cell_of_grid(3.0, 0.4) == 0.4);
  CHECK(cell_of_grid(1.5, 4.0) > 0.5 * kRadius);  // a smooth surface
}

TEST_CASE("large spheres count by their area: small ones beside them do not make cells small") {
  std::vector<Atom> atoms = {{0, 0, 0, 50.0, 0}};
  for (int i = 0; i < 100; ++i) atoms.push_back({60.0 + 4.0 * i, 0, 0, 1.5, 0});
  CHECK(cell_for(atoms, 20.0) == 20.0);
}

TEST_CASE("the order of the atoms does not matter") {
  std::vector<Atom> atoms = atom_ring(12, 5.0, 1.5);
  const double cell = cell_for(atoms, 5.0);
  CHECK(cell < 5.0);
  std::reverse(atoms.begin(), atoms.end());
  CHECK(cell_for(atoms, 5.0) == cell);
}

TEST_CASE("where no place of the surface is found the spacing is left as it is") {
  CHECK(cell_for({{0, 0, 0, 0.0, 0}, {1, 0, 0, 0.0, 0}}, 5.0) == 5.0);
}

TEST_CASE("the area of a sphere is known, that of many atoms about") {
  const auto area_of = [](const std::vector<Atom>& atoms) {
    return sample_sizes(GaussianField(atoms, kDecay, 1.0), {}).area;
  };
  const double sphere = area_of({{1, 2, 3, 2.0, 0}});
  CHECK(sphere == Approx(16.0 * std::numbers::pi).epsilon(1e-6));
  CHECK(area_of({{0, 0, 0, 2.0, 0}, {1e4, 0, 0, 2.0, 0}}) == Approx(2.0 * sphere).epsilon(1e-6));
  const std::vector<Atom> ring = atom_ring(12, 5.0, 1.5);
  const double exact = mesh_surface(ring, options_for(0.5)).report.check.area;
  CHECK(area_of(ring) > 0.6 * exact);
  CHECK(area_of(ring) < 1.1 * exact);
}

TEST_CASE("a crease does not make more of the least number of triangles, even where a sample lies on it") {
  // The crease is across the direction of one of the samples.
  const double radius = 1000.0, spacing = 50.0;
  const std::vector<Atom> pair = {{0, 0, 0, radius, 0},
                                  {860.374350504662, -96.256007881888, 245.948689649533, radius, 0}};
  const SizeSamples samples = sample_sizes(GaussianField(pair, kDecay, 1.7), {.spacing = spacing});
  CHECK(samples.sizes.front() == Approx(kLeastSize * spacing));
  CHECK(least_triangle_count(samples) < 1.1 * triangles_on(samples.area, spacing));
}

TEST_CASE("what is said to be the least number of triangles is not much more than there are") {
  const std::vector<Atom> ring = atom_ring(12, 5.0, 1.5);
  for (const double spacing : {0.3, 1.0, 3.0}) {
    CAPTURE(spacing);
    const SizeSamples samples = sample_sizes(GaussianField(ring, kDecay, 1.0), {.spacing = spacing});
    const std::size_t triangles = mesh_surface(ring, options_for(spacing)).mesh.triangles.size();
    CHECK(least_triangle_count(samples) < 1.3 * static_cast<double>(triangles));
    CHECK(least_triangle_count(samples) > 0.3 * static_cast<double>(triangles));
  }
}

#include "improve/cell_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "improve/block_field.h"

namespace gaussmesh {
namespace {

constexpr int kSamples = 256;

/// The cell in sizes that a quarter of the surface does not reach: of smaller cells there are more, and larger ones are
/// split for the proof and leave more triangles to improvement.
constexpr double kCellInSmallSizes = 1.6;

/// Most cells with a crease between atoms are split if they are larger than this in radii of the atoms; creases are
/// there where a tenth of the surface wants small triangles. Still smaller cells save no time, and triangles get less
/// even.
constexpr double kCellInRadii = 0.45;

/// They are no less than this in sizes that a tenth of the surface exceeds: blocks of cells are to hold large triangles
/// too.
constexpr double kCellInLargeSizes = 0.2;

/// Radius (A), squared, of the sphere that an atom alone would have.
double radius_sq(const GaussianField& field, std::size_t atom) {
  return std::max(field.atoms().w[atom], 0.0) / field.decay();
}

/// Number i of directions that go evenly round the sphere, on a spiral.
Vec3 direction(int i) {
  const double z = 1.0 - (2.0 * i + 1.0) / kSamples;
  const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0)), across = std::sqrt(1.0 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

struct Sample {
  double size;           ///< wanted edge (A)
  double area_in_areas;  ///< the atom's share of the surface there, by that of its sphere
};

/// Of the place of the surface near to the sphere of an atom, in a direction from its centre.
std::optional<Sample> sample_near(const GaussianField& field, std::size_t atom, const Vec3& direction,
                                  const SizeTargets& targets) {
  constexpr double kLeastCosine = 0.2;    // of a surface that is seen from the centre at a slant
  constexpr double kReachInWidths = 2.0;  // of the Gaussians: neighbours push the surface out by less
  const double radius = std::sqrt(radius_sq(field, atom));
  const double farthest = std::min(radius, kReachInWidths / std::sqrt(field.decay()));
  const WeightedCentres& atoms = field.atoms();
  const Vec3 centre{atoms.x[atom], atoms.y[atom], atoms.z[atom]}, start = centre + radius * direction;
  const Vec3 reach{farthest, farthest, farthest};
  BlockField near(field, {start - reach, start + reach});
  const std::optional<Place> place = near.project(start, farthest, Accuracy::kRough);
  if (!place) return std::nullopt;  // buried
  const double size = wanted_size(principal_curvatures(near.jet(place->at)), targets);
  // Seen from the centre the surface is in one place. Shares of atoms are their parts of phi, which is c, so that all
  // atoms together count a place once.
  const std::optional<Place> seen = near.project_along(direction, start, farthest);
  if (!seen) return Sample{size, 0.0};
  const Vec3 out = seen->at - centre;
  const double distance_sq = dot(out, out), share = std::exp(atoms.w[atom] - field.decay() * distance_sq);
  const double cosine = std::max(dot(out, seen->normal) / std::sqrt(distance_sq), kLeastCosine);
  return Sample{size, share * distance_sq / (radius * radius * cosine)};
}

}  // namespace

double area_of_spheres(const GaussianField& field) {
  double sum = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i) sum += radius_sq(field, i);
  return 4.0 * std::numbers::pi * sum;
}

SizeSamples sample_sizes(const GaussianField& field, const SizeTargets& targets) {
  SizeSamples samples;
  const double area = area_of_spheres(field) / kSamples;
  // As many samples as the area of its sphere has a share in that of all: some atoms have several and many none.
  double passed = 0.0;
  int sample = 0;
  std::vector<double> radii;
  for (std::size_t i = 0; i < field.size(); ++i) {
    passed += 4.0 * std::numbers::pi * radius_sq(field, i);
    for (; sample < kSamples && (sample + 0.5) * area < passed; ++sample) {
      const auto found = sample_near(field, i, direction(sample), targets);
      if (!found) continue;
      samples.sizes.push_back(found->size);
      radii.push_back(std::sqrt(radius_sq(field, i)));
      samples.area += area * found->area_in_areas;
    }
  }
  std::sort(samples.sizes.begin(), samples.sizes.end());
  std::sort(radii.begin(), radii.end());
  if (!radii.empty()) samples.radius = radii[radii.size() / 2];
  return samples;
}

double suitable_cell_size(const SizeSamples& samples, double spacing) {
  const std::vector<double>& sizes = samples.sizes;
  if (sizes.empty()) return spacing;
  const auto quantile = [&](double share) {
    return sizes[static_cast<std::size_t>(share * static_cast<double>(sizes.size()))];
  };
  const double across_creases = std::max(quantile(0.1), kCellInRadii * samples.radius);
  const double cell = std::min(kCellInSmallSizes * quantile(0.25), across_creases);
  return std::min(std::max(cell, kCellInLargeSizes * quantile(0.9)), spacing);
}

double least_triangle_count(const SizeSamples& samples) {
  constexpr std::size_t kByChance = 4;  // so many samples may lie on a crease that is a thousandth of the surface
  double most = 0.0;
  for (std::size_t i = std::min(kByChance, samples.sizes.size() / 2); i < samples.sizes.size(); ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(samples.sizes.size());
    most = std::max(most, triangles_on(share * samples.area, samples.sizes[i]));
  }
  return most;
}

}  // namespace gaussmesh

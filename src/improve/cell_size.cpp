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

/// It is no less than this in sizes that a tenth of the surface exceeds: blocks of cells are to hold large triangles
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

/// The wanted size at the place of the surface near to the sphere of an atom, in a direction from its centre.
std::optional<double> size_near(const GaussianField& field, std::size_t atom, const Vec3& direction,
                                const SizeTargets& targets) {
  constexpr double kReachInWidths = 2.0;  // of the Gaussians: neighbours push the surface out by less
  const double radius = std::sqrt(radius_sq(field, atom));
  const double farthest = std::min(radius, kReachInWidths / std::sqrt(field.decay()));
  const WeightedCentres& atoms = field.atoms();
  const Vec3 start = Vec3{atoms.x[atom], atoms.y[atom], atoms.z[atom]} + radius * direction;
  const Vec3 reach{farthest, farthest, farthest};
  BlockField near(field, {start - reach, start + reach});
  const std::optional<Place> place = near.project(start, farthest, Accuracy::kRough);
  if (!place) return std::nullopt;  // buried
  return wanted_size(principal_curvatures(near.jet(place->at)).larger, targets);
}

/// Wanted sizes at places that are spread evenly over the surface, more or less.
std::vector<double> sample_sizes(const GaussianField& field, const SizeTargets& targets) {
  double all = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i) all += radius_sq(field, i);
  // As many samples as the area of its sphere has a share in that of all: some atoms have several and many none.
  double passed = 0.0;
  int sample = 0;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < field.size(); ++i) {
    passed += radius_sq(field, i);
    for (; sample < kSamples && (sample + 0.5) * all < passed * kSamples; ++sample) {
      if (const auto size = size_near(field, i, direction(sample), targets)) sizes.push_back(*size);
    }
  }
  return sizes;
}

}  // namespace

double suitable_cell_size(const GaussianField& field, const SizeTargets& targets) {
  std::vector<double> sizes = sample_sizes(field, targets);
  if (sizes.empty()) return targets.spacing;
  std::sort(sizes.begin(), sizes.end());
  const double small = sizes[sizes.size() / 4], large = sizes[9 * sizes.size() / 10];
  return std::min(std::max(kCellInSmallSizes * small, kCellInLargeSizes * large), targets.spacing);
}

}  // namespace gaussmesh

// Molecules of the kinds that bounds must hold for, each with the place where its surface is.
#pragma once

#include <numeric>
#include <string>
#include <vector>

#include "catch2.h"
#include "field/gaussian_field.h"
#include "support/exact_field.h"
#include "support/sampling.h"

namespace gaussmesh::testing {

struct FieldSample {
  std::string what;
  std::vector<Atom> atoms;
  Box room;               ///< boxes to test are around points in here
  double box_size = 1.0;  ///< typical for the molecule (A)
};

/// Atoms of usual radii, some of radius 0, one of 35 A among them, three of about 1000 A, and all the same far
/// away.
inline std::vector<FieldSample> field_samples(std::uint64_t seed) {
  Random random(seed);
  std::vector<FieldSample> samples;
  samples.push_back({"usual radii", random_cloud(random, {20, 6.0, 0.8, 2.2, 0.1}), box_around({0, 0, 0}, 5.0), 1.0});
  samples.push_back(
      {"all radii zero", random_cloud(random, {30, 4.0, 0.8, 2.2, 1.0}), box_around({0, 0, 0}, 3.0), 1.0});

  samples.push_back({"one radius of 35 A", random_cloud(random, {12, 5.0, 0.8, 2.2, 0.1}), {}, 1.0});
  samples.back().atoms.push_back({36.0, 3.0, -4.0, 35.0, 0.0});
  samples.back().room = box_around({0.5, 0.0, 0.0}, 3.0);

  samples.push_back({"radii of 1000 A", {}, {}, 2.0});
  samples.back().atoms = {{-800.0, 0.0, 3.0, 1000.0, 0.0}, {1100.0, 5.0, 0.0, 900.0, 0.0}, {200.0, 2.0, 3.0, 1.7, 0.0}};
  samples.back().room = box_around({200.0, 0.0, 0.0}, 4.0);

  samples.push_back({"at 10^6 A", random_cloud(random, {15, 6.0, 0.8, 2.2, 0.1}), {}, 1.0});
  for (Atom& a : samples.back().atoms) a.x += 999990.0, a.y -= 999990.0, a.z += 500000.0;
  samples.back().room = box_around({999990.0, -999990.0, 500000.0}, 5.0);
  return samples;
}

/// All of the atoms, none left out.
inline NearAtoms list_of(const WeightedCentres& atoms) {
  std::vector<std::uint32_t> all(atoms.x.size());
  std::iota(all.begin(), all.end(), 0u);
  NearAtoms list;
  list.take(atoms, all, atoms.x.size());
  return list;
}

inline const std::vector<double> kDecays = {0.4, 0.6, 1.0, 2.0};
inline constexpr double kIsovalue = 1.3;

/// A molecule and its field, for random questions to it.
struct FieldCase {
  const FieldSample& sample;
  GaussianField field;
  ExactField exact;
  Random& random;
};

/// Calls visit(FieldCase) for each of field_samples(seed) with each of the decays and kIsovalue. All of them take their
/// random numbers from one row, which starts with the seed.
template <typename Visit>
void for_each_field(std::uint64_t seed, const std::vector<double>& decays, const Visit& visit) {
  CAPTURE(seed);
  Random random(seed);
  for (const FieldSample& sample : field_samples(seed)) {
    for (const double decay : decays) {
      CAPTURE(sample.what, decay);
      visit(FieldCase{sample, {sample.atoms, decay, kIsovalue}, {sample.atoms, decay, kIsovalue}, random});
    }
  }
}

}  // namespace gaussmesh::testing

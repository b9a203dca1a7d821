#include "pipeline/critical_places.h"

#include <algorithm>
#include <cmath>

#include "core/number_text.h"
#include "core/place_text.h"
#include "pipeline/critical_point.h"

namespace gaussmesh {

std::vector<CriticalPlace> critical_places(const GaussianField& field, const std::vector<UncertifiedPlace>& uncertified,
                                           double isovalue) {
  constexpr double kSamePoint = 1e-3;     // A
  constexpr double kNearCritical = 1e-3;  // |log(phi / c)|; where it is more, the cells are too coarse for the surface
  std::vector<CriticalPlace> places;
  for (const UncertifiedPlace& place : uncertified) {
    const CriticalPoint critical = find_critical_point(field, place.place);
    if (!critical.converged || !(std::abs(std::log(critical.relative_value)) < kNearCritical)) continue;
    const bool known = std::any_of(places.begin(), places.end(), [&](const CriticalPlace& other) {
      double distance = 0.0;
      for (int k = 0; k < 3; ++k) distance = std::max(distance, std::abs(other.point[k] - critical.point[k]));
      return distance < kSamePoint;
    });
    if (!known) places.push_back({critical.point, critical.relative_value * isovalue});
  }
  return places;
}

std::string coarse_message(const std::vector<UncertifiedPlace>& places) {
  std::string message = "the surface is finer than the smallest parts of cells, of " +
                        number_text(places.front().size, 3) + " A, at " + place_text(places.front().place);
  if (places.size() > 1) message += " and " + std::to_string(places.size() - 1) + " more places";
  return message + ". No proof of topology is possible there; choose a smaller spacing.";
}

std::string critical_message(const std::vector<CriticalPlace>& places, double isovalue, double smallest_part) {
  constexpr double kLargePart = 1e-5;  // A; boxes that are no larger mostly do, where any do
  const CriticalPlace& first = places.front();
  std::string message = "c = " + number_text(isovalue, 15) + " is too near a critical value of phi: at " +
                        place_text(first.point) + " the surface is singular at c = " + number_text(first.value, 15) +
                        ", " + number_text(std::abs(isovalue - first.value), 3) + " away";
  if (places.size() > 1) message += ", and at " + std::to_string(places.size() - 1) + " more places";
  message += ". No proof of topology is possible there";
  if (smallest_part > kLargePart) {
    message += " with cells whose smallest parts are of " + number_text(smallest_part, 2) + " A";
  }
  return message + "; choose another c, " + (smallest_part > kLargePart ? "a smaller spacing, " : "") +
         "or --allow-uncertified.";
}

}  // namespace gaussmesh

#include "pipeline/finer_traces.h"

#include <algorithm>
#include <cmath>

namespace gaussmesh {
namespace {

constexpr int kMostTraces = 3;

/// Where more than this part of the vertices is bad, and cells are larger than this part of the triangles wanted there,
/// these are what the proof has left of cells that are too large for it: then all cells are made smaller by a factor.
constexpr double kMostBad = 0.5, kLargeCell = 0.5, kSmallerCells = 0.25;

/// How often cells are halved: as often as makes them no larger than so many of the edges that are wanted there, and
/// at least so often in the first trace and in those after it.
constexpr double kCellInSizes = 2.0;
constexpr int kFirstLevel = 3, kLaterLevel = 5, kMostLevel = 15;
static_assert(kMostLevel < kMaxLevel);

}  // namespace

bool FinerTraces::demand(const LeftBad& bad, std::size_t vertices, TraceDemands& demands) {
  if (bad.places.empty() || traces_ == kMostTraces) return false;
  double least_size = bad.places.front().size, largest_size = least_size;
  for (const BadPlace& place : bad.places) {
    least_size = std::min(least_size, place.size);
    largest_size = std::max(largest_size, place.size);
  }
  if (static_cast<double>(bad.corners) > kMostBad * static_cast<double>(vertices) &&
      demands.spacing > kLargeCell * largest_size) {
    demands.spacing *= kSmallerCells;
    ++traces_;
    last_corners_ = bad.corners;
    return true;
  }
  if (!may_help(bad, least_size, vertices)) return false;
  const int least_level = traces_ == 0 ? kFirstLevel : kLaterLevel;
  for (const BadPlace& place : bad.places) {
    const double halvings = std::ceil(std::log2(demands.spacing / (kCellInSizes * place.size)));
    const int level = static_cast<int>(std::clamp<double>(halvings, least_level, kMostLevel));
    demands.fine_places.push_back({place.at, level});
  }
  ++traces_;
  last_corners_ = bad.corners;
  last_least_size_ = least_size;
  return true;
}

bool FinerTraces::may_help(const LeftBad& bad, double least_size, std::size_t vertices) const {
  constexpr double kFinerBy = 0.5, kFewerBy = 0.75;
  constexpr double kFew = 0.02;  // of the vertices: they are tried once more in any case
  if (traces_ == 0) return true;
  const auto corners = static_cast<double>(bad.corners);
  const bool is_gain =
      least_size < kFinerBy * last_least_size_ || corners < kFewerBy * static_cast<double>(last_corners_);
  // Otherwise no triangles may be small enough for this surface.
  return is_gain || (traces_ == 1 && corners <= kFew * static_cast<double>(vertices));
}

}  // namespace gaussmesh

#include "verify/surface_feet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "gaussmesh/error.h"
#include "verify/number_text.h"
#include "verify/vector3.h"

namespace gaussmesh::verify {
namespace {

constexpr std::size_t kPointsInBlock = 64;  // they share a list of atoms
constexpr double kBlockWidths = 3.0;        // and lie in a box of at most so many widths of a Gaussian
constexpr double kLeftOut = 1e-4;           // atoms of less than so much of the precision are left out (1/A)

/// Points in lanes.
struct PointLanes {
  Lanes x{}, y{}, z{};
};

/// Sums over atoms of w, w (x - x_i) and w |x - x_i|^2, w = exp(decay (r_i^2 - |x - x_i|^2)) / isovalue, for the
/// points x in the lanes.
struct MomentLanes {
  Lanes sum{}, x{}, y{}, z{}, square{};
};

struct AtomView {
  const double* x;
  const double* y;
  const double* z;
  const double* radius_sq;
  std::size_t size;
};

/// Exponents beyond this are as good as this, and would overflow.
constexpr double kLargestExponent = 700.0;

/// Takes x to within +-kLargestExponent, and makes an error of at most 2^-52 of that. There are no comparisons in
/// it, which compilers take out of the lanes where these are wider than the processor's.
inline void clamp_exponent(Lanes& x) {
  constexpr std::int64_t kNoSign = std::numeric_limits<std::int64_t>::max();
  const Lanes above_least = x + kLargestExponent;
  const Lanes above_most = x - kLargestExponent;
  x = 0.5 * ((Lanes)((LaneBits)above_least & kNoSign) - (Lanes)((LaneBits)above_most & kNoSign));
}

GAUSSMESH_LANE_CLONES
void sum_moments(const AtomView& atoms, const PointLanes& points, double decay, double log_isovalue,
                 MomentLanes& result) {
  Lanes sum{}, sum_x{}, sum_y{}, sum_z{}, square{};
  for (std::size_t i = 0; i < atoms.size; ++i) {
    const Lanes dx = points.x - atoms.x[i];
    const Lanes dy = points.y - atoms.y[i];
    const Lanes dz = points.z - atoms.z[i];
    const Lanes distance_sq = dx * dx + dy * dy + dz * dz;
    Lanes weight = decay * (atoms.radius_sq[i] - distance_sq) - log_isovalue;
    clamp_exponent(weight);
    exponentiate(weight);
    sum += weight;
    sum_x += weight * dx;
    sum_y += weight * dy;
    sum_z += weight * dz;
    square += weight * distance_sq;
  }
  result = {sum, sum_x, sum_y, sum_z, square};
}

/// The largest exponent r_i^2 - |x - x_i|^2 of each atom at any point x of `place`.
GAUSSMESH_LANE_CLONES
void find_largest_exponents(const AtomView& atoms, const BoundingBox& place, double* exponents) {
  for (std::size_t i = 0; i < atoms.size; ++i) {
    const double dx = std::max({0.0, place.low[0] - atoms.x[i], atoms.x[i] - place.high[0]});
    const double dy = std::max({0.0, place.low[1] - atoms.y[i], atoms.y[i] - place.high[1]});
    const double dz = std::max({0.0, place.low[2] - atoms.z[i], atoms.z[i] - place.high[2]});
    exponents[i] = atoms.radius_sq[i] - (dx * dx + dy * dy + dz * dz);
  }
}

/// A power of two that is at least exp(x).
double power_above(double x) {
  constexpr double kLog2e = 1.4426950408889634;
  constexpr double kLeast = -1000.0;  // of the exponents of normal doubles
  const auto exponent = static_cast<int>(std::max(kLeast, x * kLog2e));
  return std::ldexp(1.0, exponent + 1);
}

/// log(phi / c), its slope and a bound of its second derivatives, all at one point.
struct LocalLevel {
  double log_ratio = 0.0;
  Point gradient{};
  double slope = 0.0;
  double curvature = 0.0;
  bool is_good = false;  // neither too far from the surface for the atoms left out, nor of no slope
};

LocalLevel level_at(const MomentLanes& moments, std::size_t lane, double decay) {
  constexpr double kLeastSum = 1e-2;
  constexpr double kMostSum = 1e200;
  LocalLevel level;
  const double sum = moments.sum[lane];
  if (!(sum > kLeastSum && sum < kMostSum)) return level;
  const Point mean{moments.x[lane] / sum, moments.y[lane] / sum, moments.z[lane] / sum};
  for (int k = 0; k < 3; ++k) level.gradient[k] = -2 * decay * mean[k];
  level.slope = length(level.gradient);
  const double excess = sum - 1.0;
  level.log_ratio = std::abs(excess) < 1e-4 ? excess * (1 - excess * (0.5 - excess / 3)) : std::log(sum);
  level.curvature = curvature_bound(decay, moments.square[lane] / sum, mean);
  level.is_good = level.slope > 0.0;
  return level;
}

/// How the points in the lanes are getting on.
struct Walk {
  std::array<Point, kLanes> at{};
  std::array<bool, kLanes> arrived{};
  std::array<bool, kLanes> lost{};

  bool is_over(std::size_t count) const {
    for (std::size_t lane = 0; lane < count; ++lane)
      if (!arrived[lane] && !lost[lane]) return false;
    return true;
  }
};

/// Lanes beyond `count` repeat the first point.
PointLanes in_lanes(const Walk& walk, std::size_t count) {
  PointLanes points;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Point& p = walk.at[lane < count ? lane : 0];
    points.x[lane] = p[0];
    points.y[lane] = p[1];
    points.z[lane] = p[2];
  }
  return points;
}

BoundingBox widened(BoundingBox box, double margin) {
  for (int k = 0; k < 3; ++k) {
    box.low[k] -= margin;
    box.high[k] += margin;
  }
  return box;
}

bool is_short(const BoundingBox& box, double side) {
  return box.high[0] - box.low[0] <= side && box.high[1] - box.low[1] <= side && box.high[2] - box.low[2] <= side;
}

void require_positive(double value, const char* what) {
  if (!(value > 0.0) || std::isinf(value))
    throw OptionError(std::string(what) + ": expected a number > 0, got '" + text_of(value) + "'");
}

}  // namespace

void FootFinder::AtomArrays::make_room(std::size_t count) {
  if (count <= x.size()) return;
  for (std::vector<double>* array : {&x, &y, &z, &radius_sq}) array->resize(2 * count);
}

void FootFinder::AtomArrays::append(const Atom& atom) {
  x[size] = atom.x;
  y[size] = atom.y;
  z[size] = atom.z;
  radius_sq[size++] = atom.radius * atom.radius;
}

AtomTree tree_for_surface(const std::vector<Atom>& atoms, double decay, double isovalue) {
  require_positive(decay, "decay");
  require_positive(isovalue, "isovalue");
  if (atoms.empty()) throw OptionError("atoms: expected at least one, got 'none'");
  return AtomTree(atoms);
}

FootFinder::FootFinder(const AtomTree& tree, double decay, double isovalue, double reach, double precision)
    : tree_(tree),
      decay_(decay),
      log_isovalue_(std::log(isovalue)),
      reach_(reach),
      precision_(precision),
      least_share_(-std::log(kLeftOut * precision)),
      slow_field_(tree, decay) {}

void FootFinder::find(std::span<const Point> starts, std::span<Foot> feet) {
  const double widest = kBlockWidths / std::sqrt(decay_);
  for (std::size_t begin = 0, end = 0; begin < starts.size(); begin = end) {
    BoundingBox box;
    for (end = begin; end < std::min(begin + kPointsInBlock, starts.size()); ++end) {
      BoundingBox larger = box;
      larger.include(starts[end]);
      if (end > begin && !is_short(larger, widest)) break;
      box = larger;
    }
    find_block(starts.subspan(begin, end - begin), box, feet.subspan(begin, end - begin));
  }
}

void FootFinder::find_block(std::span<const Point> starts, const BoundingBox& box, std::span<Foot> feet) {
  gather(widened(box, reach_));
  for (std::size_t begin = 0; begin < starts.size(); begin += kLanes) {
    const std::size_t count = std::min(kLanes, starts.size() - begin);
    find_in_lanes(starts.subspan(begin, count), feet.subspan(begin, count));
  }
}

void FootFinder::gather(const BoundingBox& place) {
  visited_.size = 0;
  left_out_ = 0.0;
  tree_.for_each_group_reaching(
      place, (log_isovalue_ - least_share_) / decay_, decay_,
      [&](std::span<const Atom> atoms) {
        visited_.make_room(visited_.size + atoms.size());
        for (const Atom& atom : atoms) visited_.append(atom);
      },
      [&](double exponent, std::size_t count) {
        left_out_ += static_cast<double>(count) * power_above(decay_ * exponent - log_isovalue_);
      });
  choose(visited_, place, near_);
  left_out_ += static_cast<double>(visited_.size) * std::exp(-least_share_);  // what is not chosen, now or later
  const double largest_radius_sq =
      *std::max_element(near_.radius_sq.begin(), near_.radius_sq.begin() + std::max<std::size_t>(near_.size, 1));
  rounding_ = 0x1p-50 * (2 * decay_ * largest_radius_sq + least_share_ + 2 * std::abs(log_isovalue_)) +
              0x1p-52 * kLargestExponent;
}

/// Takes those atoms that count in `place`.
void FootFinder::choose(const AtomArrays& from, const BoundingBox& place, AtomArrays& to) {
  if (largest_.size() < from.size) largest_.resize(2 * from.size);
  find_largest_exponents({from.x.data(), from.y.data(), from.z.data(), from.radius_sq.data(), from.size}, place,
                         largest_.data());
  const double least = (log_isovalue_ - least_share_) / decay_;
  to.make_room(from.size + 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < from.size; ++i) {
    to.x[count] = from.x[i];
    to.y[count] = from.y[i];
    to.z[count] = from.z[i];
    to.radius_sq[count] = from.radius_sq[i];
    count += largest_[i] >= least;
  }
  to.size = count;
}

void FootFinder::find_in_lanes(std::span<const Point> starts, std::span<Foot> feet) {
  constexpr int kMostSteps = 8;
  Walk walk;
  BoundingBox box;
  for (std::size_t lane = 0; lane < starts.size(); ++lane) box.include(walk.at[lane] = starts[lane]);
  const BoundingBox place = widened(box, reach_);
  choose(near_, place, chosen_);
  const AtomView atoms{chosen_.x.data(), chosen_.y.data(), chosen_.z.data(), chosen_.radius_sq.data(), chosen_.size};
  for (int step = 0; step < kMostSteps && !walk.is_over(starts.size()); ++step) {
    MomentLanes moments;
    sum_moments(atoms, in_lanes(walk, starts.size()), decay_, log_isovalue_, moments);
    for (std::size_t lane = 0; lane < starts.size(); ++lane) {
      if (walk.arrived[lane] || walk.lost[lane]) continue;
      const LocalLevel level = level_at(moments, lane, decay_);
      if (step == 0) feet[lane].gradient = level.gradient;
      const double wanted = -level.log_ratio / level.slope;
      walk.lost[lane] = !level.is_good || !(std::abs(wanted) <= reach_);
      if (walk.lost[lane]) continue;
      Point& at = walk.at[lane];
      for (int k = 0; k < 3; ++k) at[k] += wanted / level.slope * level.gradient[k];
      const double error = level.curvature * wanted * wanted / 2 + rounding_ + left_out_ * std::exp(-level.log_ratio);
      walk.arrived[lane] = error < precision_ * level.slope;
      walk.lost[lane] = !boxes_meet(place, {at, at});
      // The first step is the distance itself: no rounding of coordinates is in it.
      const double distance = step == 0 ? std::abs(wanted) : length(difference(at, starts[lane]));
      if (walk.arrived[lane]) feet[lane] = {at, distance, feet[lane].gradient};
    }
  }
  for (std::size_t lane = 0; lane < starts.size(); ++lane)
    if (!walk.arrived[lane] || walk.lost[lane]) feet[lane] = find_slowly(starts[lane]);
}

/// A step may be a quarter of a Gaussian's width long, so as not to leap where the gradient is small; this grows
/// with every step, so that the way from far outside is not long either.
Foot FootFinder::find_slowly(const Point& start) {
  constexpr int kMostSteps = 100;
  double longest = 0.25 / std::sqrt(decay_);
  LogValue log_phi = slow_field_.at(start);
  Foot foot{start, std::numeric_limits<double>::infinity(), log_phi.gradient};
  for (int step = 0; step < kMostSteps; ++step, longest *= 1.5, log_phi = slow_field_.at(foot.place)) {
    const double slope = length(log_phi.gradient);
    const double wanted = (log_isovalue_ - log_phi.value) / slope;
    if (!std::isfinite(wanted)) break;
    const double taken = std::clamp(wanted, -longest, longest);
    Point& x = foot.place;
    for (int k = 0; k < 3; ++k) x[k] += taken / slope * log_phi.gradient[k];
    const double rounding = 1e-12 * std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    if (log_phi.curvature * taken * taken / 2 < precision_ * slope || std::abs(taken) < rounding) {
      foot.distance = length(difference(x, start));
      break;
    }
  }
  return foot;
}

}  // namespace gaussmesh::verify

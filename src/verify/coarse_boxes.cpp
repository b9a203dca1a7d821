#include "verify/coarse_boxes.h"

#include <algorithm>
#include <limits>

#include "verify/lanes.h"

namespace gaussmesh::verify {
namespace {

constexpr float kSteps = 255.0f;

typedef std::uint8_t Steps __attribute__((vector_size(32)));
typedef std::int8_t Answers __attribute__((vector_size(32)));

struct BoxArrays {
  std::array<const std::uint8_t*, 3> low;
  std::array<const std::uint8_t*, 3> high;
};

GAUSSMESH_LANE_CLONES
void compare_boxes(const BoxArrays& boxes, std::size_t i, std::size_t first, std::size_t end, std::uint8_t* meets) {
  Steps low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    low[k] = Steps{} + boxes.low[k][i];
    high[k] = Steps{} + boxes.high[k][i];
  }
  for (std::size_t j = first; j < end; j += sizeof(Steps)) {
    Answers meet = Answers{} + std::int8_t{1};
    for (int k = 0; k < 3; ++k) {
      Steps other_low, other_high;
      std::memcpy(&other_low, boxes.low[k] + j, sizeof other_low);
      std::memcpy(&other_high, boxes.high[k] + j, sizeof other_high);
      meet &= (other_low <= high[k]) & (low[k] <= other_high);
    }
    std::memcpy(meets + j, &meet, sizeof meet);
  }
}

/// The sides along one axis of boxes round three corners each.
GAUSSMESH_LANE_CLONES
void find_sides(const float* a, const float* b, const float* c, float per_length, std::size_t count, std::uint8_t* low,
                std::uint8_t* high) {
  for (std::size_t i = 0; i < count; ++i) {
    const float least = std::min(a[i], std::min(b[i], c[i])) * per_length;
    const float most = std::max(a[i], std::max(b[i], c[i])) * per_length;
    low[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(std::min(kSteps, std::max(0.0f, least))));
    high[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(std::min(kSteps, std::max(0.0f, most))));
  }
}

}  // namespace

void CoarseBoxes::start(const BoundingBox& place) {
  size_ = 0;
  origin_ = place.low;
  for (int k = 0; k < 3; ++k) {
    const auto length = static_cast<float>(place.high[k] - place.low[k]);
    // Beyond single precision all boxes have the same sides, and all seem to meet.
    const float steps = kSteps / length;
    per_length_[k] = length > 0.0f && steps > 0.0f && steps < std::numeric_limits<float>::infinity() ? steps : 0.0f;
  }
}

void CoarseBoxes::make_room() {
  room_ = std::max(4 * kAtOnce, 2 * room_);
  for (std::vector<float>& corner : corners_) corner.resize(room_);
  for (int k = 0; k < 3; ++k) {
    low_[k].resize(room_);
    high_[k].resize(room_);
  }
  meets_.resize(room_);
}

void CoarseBoxes::finish() {
  for (int k = 0; k < 3; ++k)
    find_sides(corners_[k].data(), corners_[3 + k].data(), corners_[6 + k].data(), per_length_[k], size_,
               low_[k].data(), high_[k].data());
}

void CoarseBoxes::compare(std::size_t i, std::size_t first) {
  compare_boxes({{low_[0].data(), low_[1].data(), low_[2].data()}, {high_[0].data(), high_[1].data(), high_[2].data()}},
                i, first, size_, meets_.data());
}

}  // namespace gaussmesh::verify

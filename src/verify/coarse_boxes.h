// Boxes of triangles set against each other in bytes, many at a time: the first question before any exact one.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "verify/bounding_box.h"

namespace gaussmesh::verify {

/// A list of triangles' boxes in steps of 1/255 of the box round a place, one array for each of their sides.
/// Rounding keeps the order of numbers, so that two boxes that meet there still do; some that do not may seem to.
class CoarseBoxes {
 public:
  /// Empties the list, and sets the place.
  void start(const BoundingBox& place);

  std::size_t size() const { return size_; }

  void append(const Point& a, const Point& b, const Point& c) {
    if (size_ == room_) make_room();
    const std::array<const Point*, 3> points{&a, &b, &c};
    for (int corner = 0; corner < 3; ++corner)
      for (int k = 0; k < 3; ++k)
        corners_[3 * corner + k][size_] = static_cast<float>((*points[corner])[k] - origin_[k]);
    ++size_;
  }

  /// Makes the boxes of what is in the list.
  void finish();

  /// Calls visit(j) for every j > i whose box seems to meet that of i, in rising order.
  template <class Visit>
  void for_each_meeting(std::size_t i, const Visit& visit) {
    const std::size_t first = (i + 1) / kAtOnce * kAtOnce;
    compare(i, first);
    for (std::size_t group = first; group < size_; group += kAtOnce) {
      std::uint64_t meeting = bits_of(meets_.data() + group);
      if (group <= i) meeting &= ~std::uint64_t{1} << (i - group);
      if (size_ - group < kAtOnce) meeting &= (std::uint64_t{1} << (size_ - group)) - 1;
      for (; meeting != 0; meeting &= meeting - 1) visit(group + static_cast<std::size_t>(std::countr_zero(meeting)));
    }
  }

 private:
  static constexpr std::size_t kAtOnce = 64;

  /// 64 bytes, each 0 or 1, as bits: the product brings the eight of a word together in its highest byte.
  static std::uint64_t bits_of(const std::uint8_t* bytes) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < kAtOnce; i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + i, sizeof word);
      if (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
      bits |= (word * 0x0102040810204080u >> 56) << i;
    }
    return bits;
  }

  void make_room();
  void compare(std::size_t i, std::size_t first);

  Point origin_{};
  std::array<float, 3> per_length_{};             // steps
  std::array<std::vector<float>, 9> corners_;     // x, y, z of the first corners, of the second, of the third
  std::array<std::vector<std::uint8_t>, 3> low_;  // of a length that kAtOnce divides, as the others
  std::array<std::vector<std::uint8_t>, 3> high_;
  std::vector<std::uint8_t> meets_;  // 1 where a box meets the one in hand
  std::size_t size_ = 0;
  std::size_t room_ = 0;
};

}  // namespace gaussmesh::verify

#include "verify/morton_order.h"

#include <array>

namespace gaussmesh {
namespace {

constexpr int kBitsPerAxis = 10;
constexpr int kDigitBits = 10;  // of the radix sort: three passes over the 30 bits of a cell
constexpr int kDigits = 3;

/// Moves the ten low bits of `x` three places apart.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 16) & 0x030000FFu;
  x = (x | x << 8) & 0x0300F00Fu;
  x = (x | x << 4) & 0x030C30C3u;
  x = (x | x << 2) & 0x09249249u;
  return x;
}

}  // namespace

std::uint32_t morton_cell(const BoundingBox& box, const Point& point) {
  constexpr double kLast = (1 << kBitsPerAxis) - 1;
  const double side = std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
  std::uint32_t cell = 0;
  for (int k = 0; k < 3; ++k) {
    const double place = (point[k] - box.low[k]) / side * kLast;
    cell |= spread_bits(static_cast<std::uint32_t>(std::min(kLast, place))) << k;
  }
  return cell;
}

void sort_by_cell(std::vector<MortonKey>& keys) {
  constexpr std::size_t kWorthDigits = 500;  // keys; fewer are sorted faster by comparing
  if (keys.size() < kWorthDigits) {
    std::stable_sort(keys.begin(), keys.end(),
                     [](const MortonKey& a, const MortonKey& b) { return a.cell < b.cell; });
    return;
  }
  constexpr std::uint32_t kMask = (1u << kDigitBits) - 1;
  std::vector<MortonKey> sorted(keys.size());
  for (int shift = 0; shift < kDigits * kDigitBits; shift += kDigitBits) {
    std::array<std::size_t, (1u << kDigitBits) + 1> start{};
    for (const MortonKey& key : keys) ++start[(key.cell >> shift & kMask) + 1];
    for (std::size_t digit = 1; digit < start.size(); ++digit) start[digit] += start[digit - 1];
    for (const MortonKey& key : keys) sorted[start[key.cell >> shift & kMask]++] = key;
    keys.swap(sorted);
  }
}

}  // namespace gaussmesh

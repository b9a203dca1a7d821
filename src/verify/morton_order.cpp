#include "verify/morton_order.h"

#include <omp.h>

#include <array>
#include <utility>

namespace gaussmesh::verify {
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

/// One pass of the radix sort, by the digit from bit `shift` on. Each thread counts a part of the keys, and then moves
/// that: equal digits keep their order for any number of threads.
void sort_by_digit(std::span<const MortonKey> from, std::span<MortonKey> to, int shift) {
  constexpr std::uint32_t kValues = 1u << kDigitBits;
  const auto most = static_cast<std::size_t>(omp_get_max_threads());
  std::vector<std::array<std::size_t, kValues>> place(most);  // by thread and digit: where the next key goes
#pragma omp parallel if (from.size() > kKeysForThreads)
  {
    const auto threads = static_cast<std::size_t>(omp_get_num_threads());
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    const auto mine = from.subspan(from.size() * thread / threads,
                                   from.size() * (thread + 1) / threads - from.size() * thread / threads);
    auto& next = place[thread];
    for (const MortonKey& key : mine) ++next[key.cell >> shift & (kValues - 1)];
#pragma omp barrier
#pragma omp single
    for (std::size_t value = 0, sum = 0; value < kValues; ++value)
      for (auto& of_thread : place) sum += std::exchange(of_thread[value], sum);
    for (const MortonKey& key : mine) to[next[key.cell >> shift & (kValues - 1)]++] = key;
  }
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

void sort_by_cell(std::span<MortonKey> keys) {
  constexpr std::size_t kWorthDigits = 500;  // keys; fewer are sorted faster by comparing
  if (keys.size() < kWorthDigits) {
    std::stable_sort(keys.begin(), keys.end(), [](const MortonKey& a, const MortonKey& b) { return a.cell < b.cell; });
    return;
  }
  const auto buffer = std::make_unique_for_overwrite<MortonKey[]>(keys.size());
  std::span<MortonKey> from = keys, to(buffer.get(), keys.size());
  for (int digit = 0; digit < kDigits; ++digit, std::swap(from, to)) sort_by_digit(from, to, digit * kDigitBits);
  static_assert(kDigits % 2 == 1);
#pragma omp parallel for schedule(static) if (keys.size() > kKeysForThreads)
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = from[i];
}

}  // namespace gaussmesh::verify

// By hash tables, each for those points whose hashes begin alike: small enough for the cache, and for a thread
// each.

#include "verify/duplicates.h"

#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>

#include "verify/exact_orientation.h"
#include "verify/parallel.h"

namespace gaussmesh::verify {
namespace {

constexpr std::size_t kParts = 256;

/// Equal points have equal hashes, 0 and -0 too. The multiplier is that of the SplitMix64 generator's first step.
std::uint64_t hash_of(const Point& point) {
  std::uint64_t hash = 0;
  for (const double x : point) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0xBF58476D1CE4E5B9u;
    hash ^= hash >> 31;
  }
  return hash;
}

std::size_t part_of(const Point& point) { return hash_of(point) >> 56; }

/// The numbers of the points, those of a part together.
struct Parts {
  std::vector<std::uint32_t> numbers;
  std::array<std::size_t, kParts + 1> start{};

  std::span<const std::uint32_t> part(std::size_t i) const {
    return {numbers.data() + start[i], start[i + 1] - start[i]};
  }
};

Parts part_points(const std::vector<Point>& points) {
  Parts parts;
  parts.numbers.resize(points.size());
  std::vector<std::uint8_t> part(points.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < points.size(); ++i) part[i] = static_cast<std::uint8_t>(part_of(points[i]));
  for (const std::uint8_t p : part) ++parts.start[p + 1];
  for (std::size_t p = 0; p < kParts; ++p) parts.start[p + 1] += parts.start[p];
  auto next = parts.start;
  for (std::size_t i = 0; i < points.size(); ++i) parts.numbers[next[part[i]]++] = static_cast<std::uint32_t>(i);
  return parts;
}

/// With open addresses in `table`.
std::size_t count_in_part(const std::vector<Point>& points, std::span<const std::uint32_t> numbers,
                          std::vector<std::uint32_t>& table) {
  constexpr std::uint32_t kFree = ~0u;
  table.assign(std::bit_ceil(2 * numbers.size() + 1), kFree);
  std::size_t duplicates = 0;
  for (const std::uint32_t i : numbers) {
    const Point& p = points[i];
    if (!is_exact_coordinate(p[0]) || !is_exact_coordinate(p[1]) || !is_exact_coordinate(p[2])) continue;
    std::size_t slot = hash_of(p) & (table.size() - 1);
    while (table[slot] != kFree && points[table[slot]] != p) slot = (slot + 1) & (table.size() - 1);
    if (table[slot] == kFree) {
      table[slot] = i;
    } else {
      ++duplicates;
    }
  }
  return duplicates;
}

}  // namespace

std::size_t count_duplicates(const std::vector<Point>& points) {
  const Parts parts = part_points(points);
  std::array<std::size_t, kParts> duplicates{};
  parallel_for_workers(kParts, [&] {
    return [&, table = std::vector<std::uint32_t>()](std::size_t i) mutable {
      duplicates[i] = count_in_part(points, parts.part(i), table);
    };
  });
  return std::accumulate(duplicates.begin(), duplicates.end(), std::size_t{0});
}

}  // namespace gaussmesh::verify

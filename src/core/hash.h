// One hash of whole numbers, for all tables.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gaussmesh {

/// Takes one number more into a hash: call it for each of them, and spread_hash() at the end.
inline std::uint64_t add_to_hash(std::uint64_t hash, std::int64_t number) {
  return (hash ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15ull + (hash >> 29);
}

/// Brings the upper bits into the lower ones, which tables look at.
inline std::uint64_t spread_hash(std::uint64_t hash) { return hash ^ (hash >> 32); }

/// Of places in a grid.
struct IndexHash {
  std::size_t operator()(const std::array<std::int64_t, 3>& index) const {
    std::uint64_t hash = 0;
    for (const std::int64_t i : index) hash = add_to_hash(hash, i);
    return spread_hash(hash);
  }
};

}  // namespace gaussmesh

// Which of n things belong together: a forest in which each set is a tree.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace gaussmesh {

/// Cost: practically constant for each call [Tarjan 1975]; 4 bytes a thing.
class DisjointSets {
 public:
  /// Each of `count` things is alone at first.
  explicit DisjointSets(std::size_t count = 0) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  /// One more thing, alone.
  void add() { parent_.push_back(static_cast<std::uint32_t>(parent_.size())); }

  /// The one that stands for the set that a thing is in.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite(std::uint32_t i, std::uint32_t j) { parent_[find(i)] = find(j); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace gaussmesh

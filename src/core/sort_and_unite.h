// Lists as sets.
#pragma once

#include <algorithm>
#include <vector>

namespace gaussmesh {

/// Puts the entries in rising order, each once.
template <typename T>
void sort_and_unite(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace gaussmesh

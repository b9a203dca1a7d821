// The cheapest triangulation of a polygon, whatever a triangle costs.
#pragma once

#include <limits>
#include <vector>

namespace gaussmesh {

inline constexpr double kImpossible = std::numeric_limits<double>::infinity();

/// Dynamic programming over all triangulations of a polygon with corners 0 .. n - 1 (Klincsek 1980).
/// Keeps buffers. Cost: O(n^3).
class MinimalTriangulation {
 public:
  /// @param free(i, j)     whether corners i < j, not neighbours, may be joined
  /// @param cost(i, j, k)  cost of a triangle, i < j < k; kImpossible forbids it
  /// @return               the least sum of costs, kImpossible if there is no triangulation
  template <typename Free, typename Cost>
  double solve(int n, const Free& free, const Cost& cost) {
    n_ = n;
    cost_.assign(static_cast<std::size_t>(n) * n, kImpossible);
    choice_.assign(static_cast<std::size_t>(n) * n, -1);
    for (int i = 0; i + 1 < n; ++i) cost_[i * n + i + 1] = 0.0;
    for (int width = 2; width < n; ++width) {
      for (int i = 0; i + width < n; ++i) {
        const int k = i + width;
        if (width < n - 1 && !free(i, k)) continue;
        for (int j = i + 1; j < k; ++j) {
          const double parts = cost_[i * n + j] + cost_[j * n + k];
          if (parts >= cost_[i * n + k]) continue;
          const double total = parts + cost(i, j, k);
          if (total >= cost_[i * n + k]) continue;
          cost_[i * n + k] = total;
          choice_[i * n + k] = j;
        }
      }
    }
    return n < 3 ? kImpossible : cost_[n - 1];
  }

  /// Calls visit(i, j, k) for the triangles of the last solution, which exists; they turn as the polygon does.
  template <typename Visit>
  void visit(const Visit& visit_triangle) const {
    visit_range(0, n_ - 1, visit_triangle);
  }

 private:
  template <typename Visit>
  void visit_range(int i, int k, const Visit& visit_triangle) const {
    if (k - i < 2) return;
    const int j = choice_[i * n_ + k];
    visit_range(i, j, visit_triangle);
    visit_triangle(i, j, k);
    visit_range(j, k, visit_triangle);
  }

  int n_ = 0;
  std::vector<double> cost_;
  std::vector<int> choice_;
};

}  // namespace gaussmesh

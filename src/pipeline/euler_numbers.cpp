#include "pipeline/euler_numbers.h"

#include <algorithm>

#include "core/disjoint_sets.h"

namespace gaussmesh {

std::vector<std::int64_t> euler_numbers(const TriangleMesh& mesh) {
  DisjointSets connected(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    connected.unite(a, b);
    connected.unite(a, c);
  }
  std::vector<std::int64_t> twice(mesh.vertices.size(), 0);  // by the vertex that stands for the component
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) twice[connected.find(v)] += 2;
  for (const Triangle& triangle : mesh.triangles) --twice[connected.find(triangle[0])];
  std::vector<std::int64_t> numbers;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (connected.find(v) == v) numbers.push_back(twice[v] / 2);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::vector<std::int64_t> euler_numbers(const std::vector<MeshComponent>& components) {
  std::vector<std::int64_t> numbers;
  for (const MeshComponent& component : components) numbers.push_back(component.chi);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace gaussmesh

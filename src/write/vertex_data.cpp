// What formats can hold of a vertex beside its place: normals, nearest atoms, components.
#include "gaussmesh/vertex_data.h"

#include <algorithm>

#include "core/parallel.h"
#include "gaussmesh/error.h"
#include "verify/atom_tree.h"
#include "verify/vector3.h"

namespace gaussmesh {

using namespace verify;

std::vector<std::uint32_t> find_nearest_atoms(const TriangleMesh& mesh, const std::vector<Atom>& atoms, int threads) {
  if (atoms.empty()) throw OptionError("atoms: expected at least one, got 'none'");
  constexpr std::size_t kBlock = 1024;
  const AtomTree tree(atoms);
  std::vector<std::uint32_t> nearest(mesh.vertices.size());
  parallel_for((nearest.size() + kBlock - 1) / kBlock, thread_count(threads), [&](std::size_t block) {
    const std::size_t end = std::min((block + 1) * kBlock, nearest.size());
    for (std::size_t v = block * kBlock; v < end; ++v) nearest[v] = tree.nearest(mesh.vertices[v]);
  });
  return nearest;
}

std::vector<std::uint32_t> find_vertex_components(const TriangleMesh& mesh, const MeshCheck& check) {
  std::vector<std::uint32_t> components(mesh.vertices.size(), kNoComponent);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (check.component_of[t] == kNoComponent) continue;
    for (const std::uint32_t v : mesh.triangles[t]) components[v] = check.component_of[t];
  }
  return components;
}

std::vector<Normal> average_normals(const TriangleMesh& mesh) {
  std::vector<Point> sums(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point normal =
        cross(difference(mesh.vertices[b], mesh.vertices[a]), difference(mesh.vertices[c], mesh.vertices[a]));
    for (const std::uint32_t v : {a, b, c}) {
      for (int k = 0; k < 3; ++k) sums[v][k] += normal[k];
    }
  }
  std::vector<Normal> normals(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double size = length(sums[v]);
    for (int k = 0; k < 3; ++k) normals[v][k] = size > 0.0 ? static_cast<float>(sums[v][k] / size) : 0.0f;
  }
  return normals;
}

}  // namespace gaussmesh

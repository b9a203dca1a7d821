// Parts of a mesh by its components: some of them, or each for itself.
#include "gaussmesh/select_components.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/sort_and_unite.h"

namespace gaussmesh {
namespace {

/// Whether a component or one that it lies in is a cavity smaller than `min_volume`.
bool is_left_out(const MeshCheck& check, std::uint32_t component, double min_volume) {
  for (std::optional<std::uint32_t> c = component; c; c = check.components[*c].parent) {
    if (check.components[*c].is_cavity() && -check.components[*c].volume < min_volume) return true;
  }
  return false;
}

}  // namespace

ComponentList leave_out_cavities(const MeshCheck& check, double min_volume) {
  ComponentList list;
  for (std::uint32_t c = 0; c < check.components.size(); ++c)
    if (!is_left_out(check, c, min_volume)) list.push_back(c);
  return list;
}

ComponentList outsides_first(const MeshCheck& check) {
  ComponentList list(check.components.size());
  std::iota(list.begin(), list.end(), 0u);
  std::stable_partition(list.begin(), list.end(), [&](std::uint32_t c) { return !check.components[c].is_cavity(); });
  return list;
}

MeshCheck reorder_components(MeshCheck check, const ComponentList& order) {
  std::vector<std::uint32_t> place_of(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) place_of[order[i]] = i;
  std::vector<MeshComponent> components;
  for (const std::uint32_t c : order) {
    MeshComponent component = check.components[c];
    if (component.parent) component.parent = place_of[*component.parent];
    components.push_back(component);
  }
  check.components = std::move(components);
  for (std::uint32_t& c : check.component_of)
    if (c != kNoComponent) c = place_of[c];
  return check;
}

namespace {

/// Adds a vertex with what is known of it.
void add_vertex(const TriangleMesh& mesh, const VertexData& data, std::size_t vertex, std::uint32_t component,
                MeshFile& part) {
  part.mesh.vertices.push_back(mesh.vertices[vertex]);
  part.data.components.push_back(component);
  if (!data.normals.empty()) part.data.normals.push_back(data.normals[vertex]);
  if (!data.atoms.empty()) part.data.atoms.push_back(data.atoms[vertex]);
}

/// Numbers of triangles, those of one component after those of another.
struct SortedTriangles {
  std::vector<std::size_t> begin;  ///< of each component, and the end of the last
  std::vector<std::uint32_t> triangles;
};

SortedTriangles sort_by_component(const MeshCheck& check) {
  SortedTriangles sorted;
  sorted.begin.resize(check.components.size() + 1);
  for (const std::uint32_t c : check.component_of)
    if (c != kNoComponent) ++sorted.begin[c + 1];
  std::partial_sum(sorted.begin.begin(), sorted.begin.end(), sorted.begin.begin());
  sorted.triangles.resize(sorted.begin.back());
  std::vector<std::size_t> place = sorted.begin;
  for (std::uint32_t t = 0; t < check.component_of.size(); ++t)
    if (const std::uint32_t c = check.component_of[t]; c != kNoComponent) sorted.triangles[place[c]++] = t;
  return sorted;
}

}  // namespace

void split_components(const TriangleMesh& mesh, const VertexData& data, const MeshCheck& check,
                      const std::function<void(std::uint32_t component, const MeshFile& part)>& take) {
  const SortedTriangles sorted = sort_by_component(check);
  std::vector<std::uint32_t> number(mesh.vertices.size());
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t component = 0; component < check.components.size(); ++component) {
    const auto begin = sorted.triangles.begin() + static_cast<std::ptrdiff_t>(sorted.begin[component]);
    const auto end = sorted.triangles.begin() + static_cast<std::ptrdiff_t>(sorted.begin[component + 1]);
    vertices.clear();
    for (auto t = begin; t != end; ++t)
      vertices.insert(vertices.end(), mesh.triangles[*t].begin(), mesh.triangles[*t].end());
    sort_and_unite(vertices);
    MeshFile part;
    part.data.atom_count = data.atom_count;
    for (const std::uint32_t v : vertices) {
      number[v] = static_cast<std::uint32_t>(part.mesh.vertices.size());
      add_vertex(mesh, data, v, 0, part);
    }
    for (auto t = begin; t != end; ++t) {
      const auto& [a, b, c] = mesh.triangles[*t];
      part.mesh.triangles.push_back({number[a], number[b], number[c]});
    }
    take(component, part);
  }
}

MeshFile extract_components(const TriangleMesh& mesh, const VertexData& data, const MeshCheck& check,
                            const ComponentList& components) {
  std::vector<std::uint32_t> place_of(check.components.size(), kNoComponent);
  for (std::uint32_t i = 0; i < components.size(); ++i) place_of[components[i]] = i;
  const auto place = [&](std::size_t triangle) {
    const std::uint32_t component = check.component_of[triangle];
    return component == kNoComponent ? kNoComponent : place_of[component];
  };
  std::vector<std::uint32_t> component_of(mesh.vertices.size(), kNoComponent);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (place(t) == kNoComponent) continue;
    for (const std::uint32_t v : mesh.triangles[t]) component_of[v] = place(t);
  }
  MeshFile part;
  part.data.atom_count = data.atom_count;
  std::vector<std::uint32_t> number(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (component_of[v] == kNoComponent) continue;
    number[v] = static_cast<std::uint32_t>(part.mesh.vertices.size());
    add_vertex(mesh, data, v, component_of[v], part);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (place(t) == kNoComponent) continue;
    part.mesh.triangles.push_back({number[a], number[b], number[c]});
  }
  return part;
}

}  // namespace gaussmesh

// The judge's order of business: parts that cannot be judged are counted and set aside, then everything else is
// asked of the rest.

#include "gaussmesh/check_mesh.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "gaussmesh/error.h"
#include "verify/component_geometry.h"
#include "verify/duplicates.h"
#include "verify/edge_topology.h"
#include "verify/exact_orientation.h"
#include "verify/flat_fans.h"
#include "verify/intersections.h"
#include "verify/shape.h"
#include "verify/triangle_tree.h"

namespace gaussmesh {

using namespace verify;

namespace {

void require_countable(std::size_t count, const char* what) {
  if (count > kMostParts)
    throw OptionError("mesh: expected at most " + std::to_string(kMostParts) + " " + what + ", got '" +
                      std::to_string(count) + "'");
}

bool is_exact_point(const Point& p) {
  return is_exact_coordinate(p[0]) && is_exact_coordinate(p[1]) && is_exact_coordinate(p[2]);
}

/// Why a triangle cannot be judged.
enum class TriangleFault { kNone, kBadIndex, kRepeatedVertex, kBadCoordinate };

TriangleFault fault_of(const TriangleMesh& mesh, const Triangle& triangle) {
  for (const std::uint32_t vertex : triangle)
    if (vertex >= mesh.vertices.size()) return TriangleFault::kBadIndex;
  const auto& [a, b, c] = triangle;
  if (a == b || b == c || c == a) return TriangleFault::kRepeatedVertex;
  for (const std::uint32_t vertex : triangle)
    if (!is_exact_point(mesh.vertices[vertex])) return TriangleFault::kBadCoordinate;
  return TriangleFault::kNone;
}

/// The triangles that can be judged: their numbers, and how many others there are of two faults.
struct UsableTriangles {
  std::vector<std::uint32_t> numbers;
  std::size_t bad_indices = 0;
  std::size_t repeated_vertices = 0;
};

UsableTriangles find_usable_triangles(const TriangleMesh& mesh) {
  UsableTriangles result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const TriangleFault fault = fault_of(mesh, mesh.triangles[t]);
    if (fault == TriangleFault::kNone) result.numbers.push_back(static_cast<std::uint32_t>(t));
    result.bad_indices += fault == TriangleFault::kBadIndex;
    result.repeated_vertices += fault == TriangleFault::kRepeatedVertex;
  }
  return result;
}

/// @param bad_coordinates  how many vertices have such
bool all_are_usable(const TriangleMesh& mesh, std::size_t bad_coordinates) {
  if (bad_coordinates != 0) return false;
  std::size_t faults = 0;
#pragma omp parallel for schedule(static) reduction(+ : faults)
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    faults += std::max({a, b, c}) >= mesh.vertices.size() || a == b || b == c || c == a;
  }
  return faults == 0;
}

std::size_t count_bad_coordinates(const std::vector<Point>& points) {
  std::size_t count = 0;
#pragma omp parallel for schedule(static) reduction(+ : count)
  for (std::size_t i = 0; i < points.size(); ++i) count += !is_exact_point(points[i]);
  return count;
}

MeshComponent describe(const ComponentTopology& topology, const ComponentGeometry& geometry) {
  MeshComponent component;
  component.triangles = topology.triangles;
  component.vertices = topology.vertices;
  component.chi = topology.chi;
  component.genus = (2 - topology.chi) / 2;
  component.area = geometry.area;
  component.volume = geometry.volume;
  component.closed = topology.closed;
  component.depth = geometry.around.size();
  const int wanted_sign = component.is_cavity() ? -1 : 1;
  component.inverted = topology.closed && geometry.volume_sign != wanted_sign;
  return component;
}

void add_edge_topology(const EdgeTopology& topology, MeshCheck& check) {
  check.boundary_edges = topology.boundary_edges;
  check.nonmanifold_edges = topology.nonmanifold_edges;
  check.misoriented_edges = topology.misoriented_edges;
  check.nonmanifold_vertices = topology.nonmanifold_vertices;
  check.isolated_vertices = topology.isolated_vertices;
}

/// The component that a component lies directly inside of: the one at the next smaller depth. Where components
/// cross each other there may be none.
std::optional<std::uint32_t> parent_of(const ComponentGeometry& component,
                                       const std::vector<ComponentGeometry>& geometry) {
  for (const std::uint32_t other : component.around)
    if (geometry[other].around.size() + 1 == component.around.size()) return other;
  return std::nullopt;
}

/// Numbers of the components, largest area first.
std::vector<std::uint32_t> sort_by_area(const std::vector<ComponentGeometry>& geometry) {
  std::vector<std::uint32_t> order(geometry.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return geometry[a].area > geometry[b].area; });
  return order;
}

void add_components(EdgeTopology& topology, const std::vector<ComponentGeometry>& geometry, MeshCheck& check) {
  const std::vector<std::uint32_t> order = sort_by_area(geometry);
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  for (std::size_t c = 0; c < geometry.size(); ++c) {
    check.chi += topology.components[c].chi;
    check.area += geometry[c].area;
    check.volume += geometry[c].volume;
  }
  for (const std::uint32_t c : order) {
    check.components.push_back(describe(topology.components[c], geometry[c]));
    check.inverted_components += check.components.back().inverted;
    if (const auto parent = parent_of(geometry[c], geometry)) check.components.back().parent = place[*parent];
  }
  check.component_of = std::move(topology.component_of);
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < check.component_of.size(); ++t) check.component_of[t] = place[check.component_of[t]];
}

/// What is read off the stars of the vertices; these themselves are needed no longer.
struct Connections {
  EdgeTopology topology;
  FanFacts fans;
};

Connections find_connections(const TriangleMesh& mesh) {
  const VertexStars stars(mesh);
  Connections result;
  result.topology = find_edge_topology(mesh, stars);
  result.fans = find_flat_fans(mesh, stars, result.topology);
  return result;
}

/// Judges a mesh in which every triangle has three different vertices, all there, with exact coordinates.
MeshCheck check_usable(const TriangleMesh& mesh) {
  MeshCheck check = measure_shape(mesh);
  Connections connections = find_connections(mesh);
  EdgeTopology& topology = connections.topology;
  add_edge_topology(topology, check);
  check.degenerate_triangles =
      static_cast<std::size_t>(std::count(connections.fans.turns.begin(), connections.fans.turns.end(), Turns{0}));
  const TriangleTree tree(mesh);
  add_components(topology, measure_components(mesh, topology, tree), check);
  Intersections intersections = find_intersections(mesh, tree, connections.fans);
  check.intersecting_pairs = intersections.pairs;
  check.intersecting_examples = std::move(intersections.examples);
  return check;
}

/// Judges what can be judged of a mesh in which some triangles cannot.
MeshCheck check_usable_part(const TriangleMesh& mesh) {
  const UsableTriangles usable = find_usable_triangles(mesh);
  TriangleMesh part{mesh.vertices, {}};
  for (const std::uint32_t number : usable.numbers) part.triangles.push_back(mesh.triangles[number]);
  MeshCheck check = check_usable(part);
  std::vector<std::uint32_t> component_of(mesh.triangles.size(), kNoComponent);
  for (std::size_t i = 0; i < usable.numbers.size(); ++i) component_of[usable.numbers[i]] = check.component_of[i];
  check.component_of = std::move(component_of);
  check.bad_indices = usable.bad_indices;
  check.degenerate_triangles += usable.repeated_vertices;
  for (auto& [a, b] : check.intersecting_examples) {
    a = usable.numbers[a];
    b = usable.numbers[b];
  }
  return check;
}

}  // namespace

MeshCheck check_mesh(const TriangleMesh& mesh) {
  require_countable(mesh.triangles.size(), "triangles");
  require_countable(mesh.vertices.size(), "vertices");
  const std::size_t bad_coordinates = count_bad_coordinates(mesh.vertices);
  MeshCheck check = all_are_usable(mesh, bad_coordinates) ? check_usable(mesh) : check_usable_part(mesh);
  check.vertices = mesh.vertices.size();
  check.triangles = mesh.triangles.size();
  check.bad_coordinates = bad_coordinates;
  check.duplicate_vertices = count_duplicates(mesh.vertices);
  return check;
}

bool MeshCheck::fit_for_solver() const {
  const std::size_t defects = bad_indices + bad_coordinates + boundary_edges + nonmanifold_edges + misoriented_edges +
                              nonmanifold_vertices + isolated_vertices + duplicate_vertices + degenerate_triangles +
                              intersecting_pairs + inverted_components;
  return triangles > 0 && defects == 0;
}

}  // namespace gaussmesh

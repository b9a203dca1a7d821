// Everything is read off the stars of the vertices, one after another. The edges at a vertex are found by sorting
// the far ends of its triangles' sides; an edge is counted at the lower of its two vertices.

#include "verify/edge_topology.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace gaussmesh {
namespace {

/// The triangles at each vertex, in one array.
class VertexStars {
 public:
  explicit VertexStars(const TriangleMesh& mesh)
      : start_(mesh.vertices.size() + 1), triangles_(3 * mesh.triangles.size()) {
    for (const Triangle& triangle : mesh.triangles)
      for (const std::uint32_t vertex : triangle) ++start_[vertex];
    std::inclusive_scan(start_.begin(), start_.end(), start_.begin());
    for (std::size_t t = mesh.triangles.size(); t-- > 0;)  // backwards, so that each star is in rising order
      for (const std::uint32_t vertex : mesh.triangles[t])
        triangles_[--start_[vertex]] = static_cast<std::uint32_t>(t);
  }

  std::span<const std::uint32_t> star(std::size_t vertex) const {
    return {triangles_.data() + start_[vertex], start_[vertex + 1] - start_[vertex]};
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> triangles_;
};

/// A side of a triangle at a vertex, seen from there.
struct Spoke {
  std::uint32_t to = 0;     // the vertex at its far end
  std::uint32_t place = 0;  // of the triangle in the star
  bool leaves = false;      // whether the triangle runs through it away from the vertex
};

/// The sides of the triangles round one vertex, sorted by far end: those of one edge stand together.
class SpokeList {
 public:
  void fill(const TriangleMesh& mesh, std::span<const std::uint32_t> star, std::uint32_t vertex) {
    spokes_.clear();
    for (std::uint32_t place = 0; place < star.size(); ++place) {
      const Triangle& triangle = mesh.triangles[star[place]];
      const int k = triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
      spokes_.push_back({triangle[(k + 1) % 3], place, true});
      spokes_.push_back({triangle[(k + 2) % 3], place, false});
    }
    std::sort(spokes_.begin(), spokes_.end(),
              [](const Spoke& a, const Spoke& b) { return a.to != b.to ? a.to < b.to : a.place < b.place; });
  }

  /// Calls visit(spokes) for each edge.
  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    for (std::size_t begin = 0, end = 0; begin < spokes_.size(); begin = end) {
      while (end < spokes_.size() && spokes_[end].to == spokes_[begin].to) ++end;
      visit(std::span<const Spoke>(spokes_).subspan(begin, end - begin));
    }
  }

  /// Whether the triangles are one closed fan. Every edge must have two spokes.
  bool is_one_fan() {
    twin_.resize(spokes_.size());
    first_at_.assign(spokes_.size() / 2, spokes_.size());
    for (std::size_t i = 0; i < spokes_.size(); ++i) {
      std::size_t& first = first_at_[spokes_[i].place];
      if (first == spokes_.size()) {
        first = i;
      } else {
        twin_[i] = first;
        twin_[first] = i;
      }
    }
    std::size_t triangles = 0;
    std::size_t at = 0;
    do {
      at = twin_[at ^ 1];  // across the edge, then through the triangle there to its other edge
      ++triangles;
    } while (at != 0);
    return 2 * triangles == spokes_.size();
  }

 private:
  std::vector<Spoke> spokes_;
  std::vector<std::size_t> twin_;      // the other spoke of the same triangle
  std::vector<std::size_t> first_at_;  // place of a triangle in the star -> its first spoke
};

/// An edge that is not in exactly two triangles running through it in opposite directions.
struct IrregularEdge {
  std::uint32_t triangle = 0;  // one that it is in
  std::uint32_t triangles = 0;
};

/// What one run of vertices adds.
struct Tally {
  EdgeTopology counts;
  std::vector<IrregularEdge> irregular_edges;
  std::vector<std::uint32_t> nonmanifold_vertices;
};

void count_edge(std::span<const Spoke> edge, std::uint32_t triangle, Tally& tally) {
  if (edge.size() == 2 && edge[0].leaves != edge[1].leaves) return;
  if (edge.size() == 1) ++tally.counts.boundary_edges;
  if (edge.size() == 2) ++tally.counts.misoriented_edges;
  if (edge.size() > 2) ++tally.counts.nonmanifold_edges;
  tally.irregular_edges.push_back({triangle, static_cast<std::uint32_t>(edge.size())});
}

void count_vertex(std::span<const std::uint32_t> star, std::uint32_t vertex, SpokeList& spokes, Tally& tally) {
  if (star.empty()) {
    ++tally.counts.isolated_vertices;
    return;
  }
  bool all_in_two = true;
  spokes.for_each_edge([&](std::span<const Spoke> edge) {
    all_in_two = all_in_two && edge.size() == 2;
    if (vertex < edge.front().to) count_edge(edge, star[edge.front().place], tally);
  });
  if (!all_in_two || !spokes.is_one_fan()) tally.nonmanifold_vertices.push_back(vertex);
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

Tally count_all(const TriangleMesh& mesh, const VertexStars& stars) {
  constexpr std::size_t kVerticesInChunk = 4096;  // one chunk is one thread's work; each has its own result
  const std::size_t chunks = (mesh.vertices.size() + kVerticesInChunk - 1) / kVerticesInChunk;
  std::vector<Tally> tallies(chunks);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    SpokeList spokes;
    const std::size_t end = std::min((chunk + 1) * kVerticesInChunk, mesh.vertices.size());
    for (std::size_t v = chunk * kVerticesInChunk; v < end; ++v) {
      const auto vertex = static_cast<std::uint32_t>(v);
      spokes.fill(mesh, stars.star(v), vertex);
      count_vertex(stars.star(v), vertex, spokes, tallies[chunk]);
    }
  }
  Tally all;
  for (const Tally& tally : tallies) {
    all.counts.boundary_edges += tally.counts.boundary_edges;
    all.counts.misoriented_edges += tally.counts.misoriented_edges;
    all.counts.nonmanifold_edges += tally.counts.nonmanifold_edges;
    all.counts.isolated_vertices += tally.counts.isolated_vertices;
    append(all.irregular_edges, tally.irregular_edges);
    append(all.nonmanifold_vertices, tally.nonmanifold_vertices);
  }
  all.counts.nonmanifold_vertices = all.nonmanifold_vertices.size();
  return all;
}

/// Sets of triangles that grow together; each is known by its lowest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Puts the triangles that share an edge into one set. Round a manifold vertex that is all of them.
DisjointSets unite_neighbours(const TriangleMesh& mesh, const VertexStars& stars,
                              const std::vector<std::uint32_t>& nonmanifold_vertices) {
  DisjointSets sets(mesh.triangles.size());
  SpokeList spokes;
  auto next = nonmanifold_vertices.begin();
  for (std::uint32_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
    const auto star = stars.star(vertex);
    if (next == nonmanifold_vertices.end() || *next != vertex) {
      for (const std::uint32_t triangle : star) sets.unite(star.front(), triangle);
      continue;
    }
    ++next;
    spokes.fill(mesh, star, vertex);
    spokes.for_each_edge([&](std::span<const Spoke> edge) {
      for (const Spoke& spoke : edge) sets.unite(star[edge.front().place], star[spoke.place]);
    });
  }
  return sets;
}

/// Numbers the components in the order of their first triangles.
void label_components(DisjointSets sets, EdgeTopology& result) {
  for (std::uint32_t t = 0; t < result.component_of.size(); ++t) {
    const std::uint32_t first = sets.find(t);
    if (first == t) {
      result.component_of[t] = static_cast<std::uint32_t>(result.components.size());
      result.components.emplace_back();
    } else {
      result.component_of[t] = result.component_of[first];
    }
    ++result.components[result.component_of[t]].triangles;
  }
}

void count_component_vertices(const VertexStars& stars, std::size_t vertices, EdgeTopology& result) {
  std::vector<std::uint32_t> present;
  for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
    present.clear();
    for (const std::uint32_t triangle : stars.star(vertex)) present.push_back(result.component_of[triangle]);
    std::sort(present.begin(), present.end());
    present.erase(std::unique(present.begin(), present.end()), present.end());
    for (const std::uint32_t component : present) ++result.components[component].vertices;
  }
}

/// Each edge in m triangles takes m of the 3 F sides; so 2 E = 3 F + sum (2 - m), over the irregular ones alone.
void count_component_edges(const Tally& tally, EdgeTopology& result) {
  std::vector<std::int64_t> missing_sides(result.components.size());
  for (const IrregularEdge& edge : tally.irregular_edges) {
    const std::uint32_t component = result.component_of[edge.triangle];
    missing_sides[component] += 2 - static_cast<std::int64_t>(edge.triangles);
    result.components[component].closed = false;
  }
  for (std::size_t c = 0; c < result.components.size(); ++c) {
    ComponentTopology& component = result.components[c];
    const auto faces = static_cast<std::int64_t>(component.triangles);
    const std::int64_t edges = (3 * faces + missing_sides[c]) / 2;
    component.chi = static_cast<std::int64_t>(component.vertices) - edges + faces;
  }
}

}  // namespace

EdgeTopology find_edge_topology(const TriangleMesh& mesh) {
  const VertexStars stars(mesh);
  const Tally tally = count_all(mesh, stars);
  EdgeTopology result = tally.counts;
  result.component_of.resize(mesh.triangles.size());
  label_components(unite_neighbours(mesh, stars, tally.nonmanifold_vertices), result);
  count_component_vertices(stars, mesh.vertices.size(), result);
  count_component_edges(tally, result);
  return result;
}

}  // namespace gaussmesh

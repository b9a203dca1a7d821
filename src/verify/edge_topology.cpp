// Everything is read off the stars of the vertices, one after another. Nearly all are one closed fan, which a walk
// round the vertex shows. At the others the edges are found by sorting the far ends of the triangles' sides; an
// edge is counted at the lower of its two vertices, and no edge that is not in two triangles ends at a closed fan.

#include "verify/edge_topology.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <span>
#include <utility>

#include "verify/parallel.h"

namespace gaussmesh::verify {
namespace {

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
      const auto [next, last] = others(mesh.triangles[star[place]], vertex);
      spokes_.push_back({next, place, true});
      spokes_.push_back({last, place, false});
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

/// Whether the triangles at `vertex` are one closed fan in which all turn the same way: from the triangle that runs
/// from the vertex to a and on to b, the walk goes to the one that runs to b first. If it is back where it began
/// after as many steps as there are triangles, and not before, it has been in each once; so of any two triangles no
/// two run to the same vertex, and every edge here is in two triangles that run through it in opposite directions.
bool is_closed_fan(const TriangleMesh& mesh, std::span<const std::uint32_t> star, std::uint32_t vertex) {
  constexpr std::size_t kMost = 32;  // triangles; a larger star takes the other way
  if (star.empty() || star.size() > kMost) return false;
  std::array<std::uint32_t, kMost> from{};
  std::array<std::uint32_t, kMost> to{};
  for (std::size_t i = 0; i < star.size(); ++i) {
    const auto [next, last] = others(mesh.triangles[star[i]], vertex);
    from[i] = next;
    to[i] = last;
  }
  std::size_t at = 0;
  for (std::size_t step = 1; step <= star.size(); ++step) {
    const auto found = std::find(from.begin(), from.begin() + star.size(), to[at]);
    at = static_cast<std::size_t>(found - from.begin());
    if (at == star.size()) return false;
    if (at == 0) return step == star.size();
  }
  return false;
}

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

void count_vertex(const TriangleMesh& mesh, std::span<const std::uint32_t> star, std::uint32_t vertex,
                  SpokeList& spokes, Tally& tally) {
  if (star.empty()) {
    ++tally.counts.isolated_vertices;
    return;
  }
  if (is_closed_fan(mesh, star, vertex)) return;
  spokes.fill(mesh, star, vertex);
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

/// One chunk is one thread's work.
constexpr std::size_t kVerticesInChunk = 4096;

Tally count_all(const TriangleMesh& mesh, const VertexStars& stars) {
  std::vector<Tally> tallies(chunk_count(mesh.vertices.size(), kVerticesInChunk));
  parallel_for_chunks(mesh.vertices.size(), kVerticesInChunk,
                      [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                        SpokeList spokes;
                        for (std::size_t v = begin; v < end; ++v) {
                          count_vertex(mesh, stars.star(v), static_cast<std::uint32_t>(v), spokes, tallies[chunk]);
                        }
                      });
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

/// Sets of triangles that grow together, on several threads at once; each is known by its lowest member, so that
/// what comes out does not depend on who came first.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  void unite(std::uint32_t i, std::uint32_t j) {
    for (i = find(i), j = find(j); i != j; i = find(i), j = find(j)) {
      if (i < j) std::swap(i, j);
      std::uint32_t root = i;
      if (at(i).compare_exchange_strong(root, j, std::memory_order_relaxed)) return;
    }
  }

  /// The parent of each triangle: never larger than itself, and itself only for the lowest of a set.
  std::vector<std::uint32_t> take_parents() && { return std::move(parent_); }

 private:
  std::atomic_ref<std::uint32_t> at(std::uint32_t i) { return std::atomic_ref<std::uint32_t>(parent_[i]); }
  std::uint32_t parent_of(std::uint32_t i) { return at(i).load(std::memory_order_relaxed); }

  std::uint32_t find(std::uint32_t i) {
    for (std::uint32_t parent = parent_of(i); parent != i; parent = parent_of(i)) {
      const std::uint32_t above = parent_of(parent);
      if (above != parent) at(i).store(above, std::memory_order_relaxed);
      i = above;
    }
    return i;
  }

  std::vector<std::uint32_t> parent_;
};

/// Puts the triangles that share an edge into one set. Round a manifold vertex that is all of them.
void unite_star(const TriangleMesh& mesh, const VertexStars& stars, std::uint32_t vertex, bool is_manifold,
                SpokeList& spokes, DisjointSets& sets) {
  const auto star = stars.star(vertex);
  if (is_manifold) {
    for (const std::uint32_t triangle : star) sets.unite(star.front(), triangle);
    return;
  }
  spokes.fill(mesh, star, vertex);
  spokes.for_each_edge([&](std::span<const Spoke> edge) {
    for (const Spoke& spoke : edge) sets.unite(star[edge.front().place], star[spoke.place]);
  });
}

DisjointSets unite_neighbours(const TriangleMesh& mesh, const VertexStars& stars,
                              const std::vector<std::uint32_t>& nonmanifold_vertices) {
  DisjointSets sets(mesh.triangles.size());
  parallel_for_chunks(stars.vertex_count(), kVerticesInChunk, [&](std::size_t, std::size_t begin, std::size_t end) {
    SpokeList spokes;
    for (std::size_t v = begin; v < end; ++v) {
      const auto vertex = static_cast<std::uint32_t>(v);
      const bool is_manifold = nonmanifold_vertices.empty() ||
                               !std::binary_search(nonmanifold_vertices.begin(), nonmanifold_vertices.end(), vertex);
      unite_star(mesh, stars, vertex, is_manifold, spokes, sets);
    }
  });
  return sets;
}

/// Numbers the components in the order of their first triangles: a parent has its number before its children.
void label_components(DisjointSets sets, EdgeTopology& result) {
  result.component_of = std::move(sets).take_parents();
  for (std::uint32_t t = 0; t < result.component_of.size(); ++t) {
    std::uint32_t& component = result.component_of[t];
    if (component == t) {
      component = static_cast<std::uint32_t>(result.components.size());
      result.components.emplace_back();
    } else {
      component = result.component_of[component];
    }
    ++result.components[component].triangles;
  }
}

/// Only at a vertex that is not manifold can components touch.
void count_component_vertices(const VertexStars& stars, const std::vector<std::uint32_t>& nonmanifold_vertices,
                              EdgeTopology& result) {
  std::vector<std::uint32_t> present;
  auto next = nonmanifold_vertices.begin();
  for (std::size_t vertex = 0; vertex < stars.vertex_count(); ++vertex) {
    const auto star = stars.star(vertex);
    present.clear();
    if (next != nonmanifold_vertices.end() && *next == vertex) {
      ++next;
      for (const std::uint32_t triangle : star) present.push_back(result.component_of[triangle]);
      std::sort(present.begin(), present.end());
      present.erase(std::unique(present.begin(), present.end()), present.end());
    } else if (!star.empty()) {
      present.push_back(result.component_of[star.front()]);
    }
    for (const std::uint32_t component : present) ++result.components[component].vertices;
  }
}

/// Each edge in m triangles takes m of the 3 F sides; so 2 E = 3 F + sum (2 - m), over the irregular ones alone.
void count_component_edges(const std::vector<IrregularEdge>& irregular_edges, EdgeTopology& result) {
  std::vector<std::int64_t> missing_sides(result.components.size());
  for (const IrregularEdge& edge : irregular_edges) {
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

EdgeTopology find_edge_topology(const TriangleMesh& mesh, const VertexStars& stars) {
  Tally tally = count_all(mesh, stars);
  EdgeTopology result = std::move(tally.counts);
  label_components(unite_neighbours(mesh, stars, tally.nonmanifold_vertices), result);
  count_component_vertices(stars, tally.nonmanifold_vertices, result);
  count_component_edges(tally.irregular_edges, result);
  result.nonmanifold = std::move(tally.nonmanifold_vertices);
  return result;
}

}  // namespace gaussmesh::verify

// What must hold of the triangles of any one cell.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "catch2.h"
#include "gaussmesh/check_mesh.h"
#include "patch/patch_triangulator.h"

namespace gaussmesh::testing {

struct PatchFacts {
  std::size_t triangles = 0;
  int chi = 0;               ///< V - E + F, over the vertices that triangles use
  std::size_t boundary = 0;  ///< edges in one triangle
};

/// The patch as a mesh of its own: vertices of the loops first, then its inner points.
inline TriangleMesh patch_mesh(const Patch& patch, const std::vector<Loop>& loops,
                               std::map<std::uint32_t, std::uint32_t>& number) {
  TriangleMesh mesh;
  const auto add = [&](std::uint32_t vertex, const SurfacePoint& point) {
    if (!number.try_emplace(vertex, static_cast<std::uint32_t>(mesh.vertices.size())).second) return;
    mesh.vertices.push_back(to_angstrom(point.position));
  };
  for (const Loop& loop : loops) {
    for (const LoopVertex& v : loop) add(v.vertex, v.point);
  }
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    add(kLocalVertex + static_cast<std::uint32_t>(i), patch.points[i]);
  }
  for (Triangle t : patch.triangles) {
    for (std::uint32_t& v : t) v = number.at(v);
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// Checks that the patch has exactly the loops as its boundary, that inner edges join two triangles turned alike
/// and lie in no face of the cell, and that no two triangles meet.
inline PatchFacts check_patch(const Patch& patch, const std::vector<Loop>& loops) {
  REQUIRE(patch.complete);
  std::map<std::uint32_t, std::uint32_t> number;
  const TriangleMesh mesh = patch_mesh(patch, loops, number);
  std::vector<unsigned> faces(mesh.vertices.size(), 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> on_boundary;
  for (const Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      faces[number.at(loop[i].vertex)] = loop[i].faces;
      ++on_boundary[{number.at(loop[i].vertex), number.at(loop[(i + 1) % loop.size()].vertex)}];
    }
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  std::map<std::uint32_t, int> used;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      ++directed[{t[i], t[(i + 1) % 3]}];
      ++used[t[i]];
    }
  }
  PatchFacts facts;
  facts.triangles = mesh.triangles.size();
  for (const auto& [edge, count] : directed) {
    CHECK(count == 1);
    const bool has_twin = directed.contains({edge.second, edge.first});
    CHECK(has_twin == !on_boundary.contains(edge));
    if (has_twin) CHECK((faces[edge.first] & faces[edge.second]) == 0);
    if (!has_twin) ++facts.boundary;
  }
  CHECK(facts.boundary == on_boundary.size());
  const std::size_t edges = (directed.size() + facts.boundary) / 2;
  facts.chi = static_cast<int>(used.size()) - static_cast<int>(edges) + static_cast<int>(facts.triangles);
  const MeshCheck check = check_mesh(mesh);
  CHECK(check.intersecting_pairs == 0);
  CHECK(check.degenerate_triangles == 0);
  CHECK(check.nonmanifold_edges == 0);
  CHECK(check.misoriented_edges == 0);
  return facts;
}

}  // namespace gaussmesh::testing

// TetGen .smesh: nodes, here or in a .node file; facets; holes and regions are passed over.

#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

constexpr std::string_view kNode = "a node: its number, in order from 0 or 1, and three finite coordinates";
constexpr std::string_view kFacet = "a triangle, '3' and three node numbers";
constexpr std::size_t kShortestLine = 8;  // bytes, of a node or a facet: "0 0 0 0\n"

/// The nodes; returns the number of the first.
std::uint32_t read_nodes(MeshLines& lines, TriangleMesh& mesh) {
  lines.require_next("the number of nodes, and 3");
  const auto count = lines.integer<std::size_t>(0, "the number of nodes, and 3");
  if (lines.fields().size() > 1 && lines.integer<int>(1, "the number of nodes, and 3") != 3)
    lines.fail("nodes in 3 dimensions");
  mesh.vertices.reserve(lines.at_most(count, kShortestLine));
  std::uint32_t base = 0;
  for (std::size_t i = 0; i < count; ++i) {
    lines.require_next(kNode);
    const auto number = lines.integer<std::uint32_t>(0, kNode);
    if (i == 0) base = number;
    if (base > 1 || number != base + i) lines.fail(kNode);
    mesh.vertices.push_back(lines.point(1, kNode));
  }
  return base;
}

/// The facets behind the nodes.
void read_facets(MeshLines& lines, std::uint32_t base, TriangleMesh& mesh) {
  lines.require_next("the number of facets");
  const auto count = lines.integer<std::size_t>(0, "the number of facets");
  mesh.triangles.reserve(lines.at_most(count, kShortestLine));
  for (std::size_t i = 0; i < count; ++i) {
    lines.require_next(kFacet);
    if (lines.integer<int>(0, kFacet) != 3) lines.fail(kFacet);
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = lines.vertex(k + 1, base, kFacet);
    mesh.triangles.push_back(triangle);
  }
}

}  // namespace

MeshFile parse_smesh(std::string_view text, std::string_view name) {
  MeshLines lines(text, name);
  MeshFile file;
  const std::uint32_t base = read_nodes(lines, file.mesh);
  if (file.mesh.vertices.empty())
    lines.fail("nodes", "; those in a .node file are read from beside a .smesh file that is named");
  read_facets(lines, base, file.mesh);
  return file;
}

MeshFile parse_smesh(std::string_view text, std::string_view name, std::string_view nodes,
                     std::string_view nodes_name) {
  MeshLines node_lines(nodes, nodes_name);
  MeshFile file;
  const std::uint32_t base = read_nodes(node_lines, file.mesh);
  MeshLines lines(text, name);
  lines.require_next("the number of nodes, 0");
  read_facets(lines, base, file.mesh);
  leave_out_unused_vertices(file.mesh);  // those that TetGen put inside of solids
  return file;
}

}  // namespace gaussmesh

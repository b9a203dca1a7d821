// TetGen .smesh: nodes, facets; holes and regions are passed over.

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

}  // namespace

MeshFile parse_smesh(std::string_view text, std::string_view name) {
  MeshLines lines(text, name);
  MeshFile file;
  const std::uint32_t base = read_nodes(lines, file.mesh);
  lines.require_next("the number of facets");
  const auto count = lines.integer<std::size_t>(0, "the number of facets");
  file.mesh.triangles.reserve(lines.at_most(count, kShortestLine));
  for (std::size_t i = 0; i < count; ++i) {
    lines.require_next(kFacet);
    if (lines.integer<int>(0, kFacet) != 3) lines.fail(kFacet);
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = lines.vertex(k + 1, base, kFacet);
    file.mesh.triangles.push_back(triangle);
  }
  return file;
}

}  // namespace gaussmesh

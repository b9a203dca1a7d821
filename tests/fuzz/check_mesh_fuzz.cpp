// Any bytes are a mesh or an InputError; any mesh is judged without a crash, the same whichever way round.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "gaussmesh/check_mesh.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_mesh.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

/// Turning all triangles inside out changes no defect but the inverted components.
void judge_both_ways(gaussmesh::TriangleMesh mesh) {
  const gaussmesh::MeshCheck check = gaussmesh::check_mesh(mesh);
  for (gaussmesh::Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  const gaussmesh::MeshCheck turned = gaussmesh::check_mesh(mesh);
  require(check.intersecting_pairs == turned.intersecting_pairs);
  require(check.degenerate_triangles == turned.degenerate_triangles);
  require(check.misoriented_edges == turned.misoriented_edges);
  require(check.nonmanifold_vertices == turned.nonmanifold_vertices);
  require(check.components.size() == turned.components.size());
  require(check.chi == turned.chi);
  require(!(check.fit_for_solver() && turned.fit_for_solver()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostTriangles = 200;  // more only cost time
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const gaussmesh::TriangleMesh mesh = gaussmesh::parse_mesh(text, "fuzz.off").mesh;
    if (mesh.triangles.size() <= kMostTriangles) judge_both_ways(mesh);
  } catch (const gaussmesh::InputError&) {
  }
  return 0;
}

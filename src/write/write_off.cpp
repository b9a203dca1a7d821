// OFF: `OFF`, `NV NF 0`, coordinates, `3 i j k`. No comments, blank lines or colours, lines under 98 characters:
// the dialect that AFMPB, DAFMPB, TetGen and meshio all read.
//
// https://shape.cs.princeton.edu/benchmark/documentation/off_format.html

#include "write/mesh_writer.h"

namespace gaussmesh {

void write_off(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  file.write("OFF\n" + std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.triangles.size()) + " 0\n");
  write_records(file, mesh.vertices.size(), kLongestPoint,
                [&](char* p, std::size_t i) { return put_point(p, mesh.vertices[i], '\n'); });
  write_records(file, mesh.triangles.size(), 2 + 3 * kLongestIndex,
                [&](char* p, std::size_t i) { return put_triangle(put_text(p, "3 "), mesh.triangles[i], 0, '\n'); });
}

}  // namespace gaussmesh

// Wavefront OBJ: `v`, `vn`, and faces counted from 1.
//
// http://paulbourke.net/dataformats/obj/

#include "write/mesh_writer.h"

namespace gaussmesh {

void write_obj(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  const std::vector<Normal>& normals = view.data.normals;
  write_records(file, mesh.vertices.size(), 2 + kLongestPoint,
                [&](char* p, std::size_t i) { return put_point(put_text(p, "v "), mesh.vertices[i], '\n'); });
  write_records(file, normals.size(), 3 + kLongestPoint,
                [&](char* p, std::size_t i) { return put_normal(put_text(p, "vn "), normals[i], '\n'); });
  if (normals.empty()) {
    write_records(file, mesh.triangles.size(), 2 + 3 * kLongestIndex,
                  [&](char* p, std::size_t i) { return put_triangle(put_text(p, "f "), mesh.triangles[i], 1, '\n'); });
    return;
  }
  const auto put_corner = [](char* p, std::uint32_t v) {
    p = put_text(put_integer(p, std::uint64_t{v} + 1), "//");
    return put_integer(p, std::uint64_t{v} + 1);
  };
  write_records(file, mesh.triangles.size(), 2 + 3 * (2 * kLongestIndex + 1), [&](char* p, std::size_t i) {
    return put_row(put_text(p, "f "), mesh.triangles[i], ' ', '\n', put_corner);
  });
}

}  // namespace gaussmesh

// PLY, binary and ascii: vertices with normal, atom and component where they are known.
//
// http://paulbourke.net/dataformats/ply/

#include <bit>

#include "write/mesh_writer.h"

namespace gaussmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written as it is in memory");

std::string header(const MeshView& view, const char* encoding) {
  const VertexData& data = view.data;
  std::string text = std::string("ply\nformat ") + encoding + " 1.0\ncomment gaussmesh, lengths in A\nelement vertex " +
                     std::to_string(view.mesh.vertices.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!data.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!data.atoms.empty()) text += "property uint atom\n";
  if (!data.components.empty()) text += "property uint component\n";
  return text + "element face " + std::to_string(view.mesh.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

}  // namespace

void write_ply_binary(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  const VertexData& data = view.data;
  file.write(header(view, "binary_little_endian"));
  write_records(file, mesh.vertices.size(), sizeof(Point) + sizeof(Normal) + 8, [&](char* p, std::size_t i) {
    p = put_bytes(p, mesh.vertices[i]);
    if (!data.normals.empty()) p = put_bytes(p, data.normals[i]);
    if (!data.atoms.empty()) p = put_bytes(p, data.atoms[i]);
    if (!data.components.empty()) p = put_bytes(p, data.components[i]);
    return p;
  });
  write_records(file, mesh.triangles.size(), 1 + sizeof(Triangle), [&](char* p, std::size_t i) {
    *p++ = 3;
    return put_bytes(p, mesh.triangles[i]);
  });
}

void write_ply_ascii(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  const VertexData& data = view.data;
  file.write(header(view, "ascii"));
  write_records(file, mesh.vertices.size(), 2 * kLongestPoint + 2 * kLongestIndex, [&](char* p, std::size_t i) {
    p = put_point(p, mesh.vertices[i], ' ');
    if (!data.normals.empty()) p = put_normal(p, data.normals[i], ' ');
    for (const std::vector<std::uint32_t>* numbers : {&data.atoms, &data.components}) {
      if (numbers->empty()) continue;
      p = put_integer(p, (*numbers)[i]);
      *p++ = ' ';
    }
    p[-1] = '\n';
    return p;
  });
  write_records(file, mesh.triangles.size(), 2 + 3 * kLongestIndex,
                [&](char* p, std::size_t i) { return put_triangle(put_text(p, "3 "), mesh.triangles[i], 0, '\n'); });
}

}  // namespace gaussmesh

// MSMS: a file of vertices, a file of faces.
//
// Sanner, Olson, Spehner, Biopolymers 38:305 (1996); the columns are those of the MSMS manual: x y z, normal,
// number of an analytical face, sphere, type; three vertices from 1, type, number of an analytical face. There are
// no analytical faces here, so their numbers are 0 at vertices, and the component at faces; all types are 3, "in a
// contact face". TABI-PB wants the header, whose third line begins with the count; PyGBe, pbj and VMD want none. Some
// versions of TABI-PB read as many charges as it has spheres: these are all atoms, whether a vertex is near or not.

#include "write/mesh_writer.h"

namespace gaussmesh {
namespace {

constexpr std::string_view kContact = "3";

/// How many spheres there are: at least as many as the vertices tell of.
std::size_t sphere_count(const VertexData& data) {
  const auto last = std::max_element(data.atoms.begin(), data.atoms.end());
  return std::max(data.atom_count, last == data.atoms.end() ? 0 : std::size_t{*last} + 1);
}

void write_header(const MeshView& view, WholeFile& file, const std::string& what, std::size_t count) {
  if (!view.msms_header) return;
  file.write("# " + what + " of a Gaussian surface, written by gaussmesh\n#count spheres density probe\n" +
             std::to_string(count) + " " + std::to_string(sphere_count(view.data)) + " 0.00 0.00\n");
}

}  // namespace

void write_msms_vertices(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  const std::vector<std::uint32_t>& atoms = view.data.atoms;
  const std::vector<Normal> averages = view.data.normals.empty() ? average_normals(mesh) : std::vector<Normal>{};
  const std::vector<Normal>& normals = view.data.normals.empty() ? averages : view.data.normals;
  write_header(view, file, "vertices", mesh.vertices.size());
  write_records(file, mesh.vertices.size(), 2 * kLongestPoint + 2 + kLongestIndex + 2, [&](char* p, std::size_t i) {
    p = put_point(p, mesh.vertices[i], ' ');
    p = put_normal(p, normals[i], ' ');
    p = put_text(p, "0 ");
    p = put_integer(p, atoms.empty() ? 0 : std::uint64_t{atoms[i]} + 1);
    *p++ = ' ';
    p = put_text(p, kContact);
    *p++ = '\n';
    return p;
  });
}

void write_msms_faces(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  write_header(view, file, "faces", mesh.triangles.size());
  write_records(file, mesh.triangles.size(), 4 * kLongestIndex + 2, [&](char* p, std::size_t i) {
    p = put_triangle(p, mesh.triangles[i], 1, ' ');
    p = put_text(p, kContact);
    *p++ = ' ';
    p = put_integer(p, view.tag(mesh.triangles[i]));
    *p++ = '\n';
    return p;
  });
}

}  // namespace gaussmesh

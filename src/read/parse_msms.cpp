// MSMS: `x y z nx ny nz face sphere type` and `v1 v2 v3 type face`, from 1, behind three lines of header or none.

#include "gaussmesh/error.h"
#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

constexpr std::string_view kVertex =
    "a vertex: its coordinates and normal, six finite numbers, perhaps face and sphere";
constexpr std::string_view kFace = "a face: three vertex numbers from 1";
constexpr std::size_t kSphereField = 7;

/// Calls read_line() for each line behind the header.
///
/// A header is two lines of comment, then the counts. Without the comments there is none: counts would look like a
/// face.
template <class ReadLine>
void read_lines(std::string_view text, std::string_view name, const char* what, const ReadLine& read_line) {
  require_content(text, name);
  const bool has_header = text.starts_with('#');
  MeshLines lines(text, name);
  std::size_t announced = 0, count = 0;
  if (has_header) {
    lines.require_next(std::string("the number of ") + what);
    announced = lines.integer<std::size_t>(0, std::string("the number of ") + what);
  }
  for (; lines.next(); ++count) read_line(lines);
  if (has_header && announced != count) {
    throw InputError(std::string(name) + ": expected " + std::to_string(announced) + " " + what +
                     ", as the header says, got " + std::to_string(count));
  }
}

std::uint32_t sphere_of(const MeshLines& lines) {
  return lines.fields().size() > kSphereField ? lines.integer<std::uint32_t>(kSphereField, kVertex) : 0;
}

}  // namespace

MeshFile parse_msms(std::string_view vertices, std::string_view vertices_name, std::string_view faces,
                    std::string_view faces_name) {
  MeshFile file;
  read_lines(require_text(vertices, vertices_name), vertices_name, "vertices", [&](const MeshLines& lines) {
    file.mesh.vertices.push_back(lines.point(0, kVertex));
    file.data.normals.push_back(to_normal(lines.point(3, kVertex)));
    if (const std::uint32_t sphere = sphere_of(lines)) file.data.atoms.push_back(sphere - 1);
  });
  if (file.data.atoms.size() != file.mesh.vertices.size()) file.data.atoms.clear();
  read_lines(require_text(faces, faces_name), faces_name, "faces", [&](const MeshLines& lines) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = lines.vertex(k, 1, kFace);
    file.mesh.triangles.push_back(triangle);
  });
  return file;
}

}  // namespace gaussmesh

// MSMS: `x y z nx ny nz face sphere type` and `v1 v2 v3 type face`, from 1, behind three lines of header or none.

#include "gaussmesh/error.h"
#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

constexpr std::string_view kVertex =
    "a vertex: its coordinates and normal, six finite numbers, perhaps face and sphere";
constexpr std::string_view kFace = "a face: three vertex numbers from 1";
constexpr std::size_t kSphereField = 7;

/// What the third line of a header says.
struct Header {
  std::size_t count = 0;
  std::size_t spheres = 0;  ///< 0: not said
};

Header read_header(MeshLines& lines, const std::string& expected) {
  lines.require_next(expected);
  const auto fields = lines.fields();
  const auto spheres = fields.size() > 1 ? parse_integer<std::size_t>(fields[1]) : std::nullopt;
  return {lines.integer<std::size_t>(0, expected), spheres.value_or(0)};
}

/// Calls read_line() for each line behind the header. @return how many spheres that says there are, or 0
///
/// A header is two lines of comment, then the counts. Without the comments there is none: counts would look like a
/// face.
template <class ReadLine>
std::size_t read_lines(std::string_view text, std::string_view name, const char* what, const ReadLine& read_line) {
  require_content(text, name);
  const bool has_header = text.starts_with('#');
  MeshLines lines(text, name);
  const Header header = has_header ? read_header(lines, std::string("the number of ") + what) : Header{};
  std::size_t count = 0;
  for (; lines.next(); ++count) read_line(lines);
  if (has_header && header.count != count) {
    throw InputError(std::string(name) + ": expected " + std::to_string(header.count) + " " + what +
                     ", as the header says, got " + std::to_string(count));
  }
  return header.spheres;
}

std::uint32_t sphere_of(const MeshLines& lines) {
  return lines.fields().size() > kSphereField ? lines.integer<std::uint32_t>(kSphereField, kVertex) : 0;
}

}  // namespace

MeshFile parse_msms(std::string_view vertices, std::string_view vertices_name, std::string_view faces,
                    std::string_view faces_name) {
  MeshFile file;
  const auto read_vertex = [&](const MeshLines& lines) {
    file.mesh.vertices.push_back(lines.point(0, kVertex));
    file.data.normals.push_back(to_normal(lines.point(3, kVertex)));
    if (const std::uint32_t sphere = sphere_of(lines)) file.data.atoms.push_back(sphere - 1);
  };
  file.data.atom_count = read_lines(require_text(vertices, vertices_name), vertices_name, "vertices", read_vertex);
  if (file.data.atoms.size() != file.mesh.vertices.size()) file.data.atoms.clear();
  read_lines(require_text(faces, faces_name), faces_name, "faces", [&](const MeshLines& lines) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = lines.vertex(k, 1, kFace);
    file.mesh.triangles.push_back(triangle);
  });
  return file;
}

}  // namespace gaussmesh

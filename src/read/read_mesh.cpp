// Which format a mesh file is in.

#include "gaussmesh/read_mesh.h"

#include <algorithm>
#include <array>
#include <limits>

#include "gaussmesh/error.h"
#include "read/mesh_text.h"
#include "text/read_file.h"

namespace gaussmesh {
namespace {

/// A format, and how it is known.
struct Kind {
  std::string_view extension;
  MeshFile (*parse)(std::string_view bytes, std::string_view name);
};

MeshFile parse_obj_bytes(std::string_view bytes, std::string_view name) {
  return parse_obj(require_text(bytes, name), name);
}

MeshFile parse_smesh_bytes(std::string_view bytes, std::string_view name) {
  return parse_smesh(require_text(bytes, name), name);
}

/// PLY, Gmsh and VTP are known by their first bytes, whatever their names.
constexpr std::array<Kind, 4> kKinds = {
    {{".off", parse_off}, {".stl", parse_stl}, {".obj", parse_obj_bytes}, {".smesh", parse_smesh_bytes}}};

/// Whether a line begins with the word.
bool has_line(std::string_view bytes, std::string_view word) {
  LineReader lines(bytes);
  while (const auto line = lines.next()) {
    if (trim(*line).starts_with(word)) return true;
  }
  return false;
}

/// `4 3 0 0`, perhaps with fewer numbers behind: nodes, dimensions, attributes, markers. What else begins with whole
/// numbers has coordinates there, or five fields.
bool begins_smesh(std::span<const std::string_view> fields) {
  if (fields.size() < 2 || fields.size() > 4 || fields[1] != "3") return false;
  return std::all_of(fields.begin(), fields.end(), [](auto field) { return parse_integer<std::uint32_t>(field); });
}

/// The format of what has no extension that tells, as standard input has none.
MeshFile parse_by_content(std::string_view bytes, std::string_view name) {
  constexpr std::array<std::string_view, 8> kObjKeywords = {"v", "vn", "vt", "o", "g", "s", "mtllib", "usemtl"};
  if (is_binary_stl(bytes)) return parse_stl(bytes, name);
  MeshLines lines(bytes, name);
  if (lines.next()) {
    const std::string_view first = lines.fields()[0];
    if (first.ends_with("OFF")) return parse_off(bytes, name);
    if (first == "solid" && (has_line(bytes, "facet") || has_line(bytes, "endsolid"))) return parse_stl(bytes, name);
    if (std::find(kObjKeywords.begin(), kObjKeywords.end(), first) != kObjKeywords.end())
      return parse_obj_bytes(bytes, name);
    if (begins_smesh(lines.fields())) return parse_smesh_bytes(bytes, name);
  }
  lines.fail("a mesh in OFF, PLY, OBJ, STL, VTP, Gmsh .msh or TetGen .smesh",
             "; MSMS is known by the extensions .vert and .face alone");
}

/// `name`, which has the extension `from`, with `to` in its place: from a.vert.gz to a.face.gz.
std::string sibling(std::string name, std::string_view from, std::string_view to) {
  return name.replace(without_gzip(name).size() - from.size(), from.size(), to);
}

std::string read_mesh_file(const std::filesystem::path& path) { return read_file(path, ReadFor::kMesh); }

/// Reads the file of MSMS that is named and the one beside it.
MeshFile read_msms(const std::string& name) {
  const bool is_vertices = has_extension(name, ".vert");
  const std::string other = is_vertices ? sibling(name, ".vert", ".face") : sibling(name, ".face", ".vert");
  const std::string named_text = read_mesh_file(name);
  if (!std::filesystem::exists(other)) {
    throw InputError(name + ": expected MSMS, with " + (is_vertices ? "faces" : "vertices") + " in '" + other +
                     "', got no such file" + (is_vertices ? "" : "; of TetGen, .smesh files are read"));
  }
  const std::string other_text = read_mesh_file(other);
  return is_vertices ? parse_msms(named_text, name, other_text, other)
                     : parse_msms(other_text, other, named_text, name);
}

/// Reads a .smesh, and the .node file beside it where it says that it has no nodes.
MeshFile read_smesh(const std::string& name) {
  const std::string text = read_mesh_file(name);
  MeshLines lines(text, name);
  const bool has_no_nodes = lines.next() && begins_smesh(lines.fields()) && lines.fields()[0] == "0";
  const std::string nodes = sibling(name, ".smesh", ".node");
  if (!has_no_nodes || !std::filesystem::exists(nodes)) return parse_mesh(text, name);
  const std::string nodes_text = read_mesh_file(nodes);
  return parse_smesh(require_text(text, name), name, require_text(nodes_text, nodes), nodes);
}

}  // namespace

void leave_out_unused_vertices(TriangleMesh& mesh) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(mesh.vertices.size(), kUnused);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle)
      if (v < place.size()) place[v] = 0;
  std::vector<Point> used;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == kUnused) continue;
    place[v] = static_cast<std::uint32_t>(used.size());
    used.push_back(mesh.vertices[v]);
  }
  for (Triangle& triangle : mesh.triangles)
    for (std::uint32_t& v : triangle) v = v < place.size() ? place[v] : kUnused;
  mesh.vertices = std::move(used);
}

void require_content(std::string_view bytes, std::string_view name) {
  if (bytes.find_first_not_of(" \t\v\f\r\n") == std::string_view::npos) {
    throw InputError(std::string(name) + ": expected a mesh, got nothing: the file is empty");
  }
}

MeshFile parse_mesh(std::string_view bytes, std::string_view name) {
  require_content(bytes, name);
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return parse_ply(bytes, name);
  if (bytes.starts_with("$MeshFormat") || bytes.starts_with("$Comments")) return parse_gmsh(bytes, name);
  if (bytes.starts_with("<?xml") || bytes.starts_with("<VTKFile")) return parse_vtp(bytes, name);
  for (const Kind& kind : kKinds) {
    if (has_extension(name, kind.extension)) return kind.parse(bytes, name);
  }
  return parse_by_content(bytes, name);
}

MeshFile read_mesh(std::istream& input, std::string_view name) {
  return parse_mesh(read_stream(input, name, ReadFor::kMesh), name);
}

MeshFile read_mesh(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (has_extension(name, ".vert") || has_extension(name, ".face")) return read_msms(name);
  if (has_extension(name, ".smesh")) return read_smesh(name);
  return parse_mesh(read_mesh_file(path), name);
}

}  // namespace gaussmesh

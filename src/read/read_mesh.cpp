// Which format a mesh file is in.

#include "gaussmesh/read_mesh.h"

#include "gaussmesh/error.h"
#include "read/mesh_text.h"
#include "text/read_file.h"

namespace gaussmesh {
namespace {

/// `name` with `from` before the last dot - or before a .gz - replaced by `to`: from a.vert.gz to a.face.gz.
std::string sibling(std::string name, std::string_view from, std::string_view to) {
  const std::size_t ending = has_extension(name, from) && !name.ends_with(from) ? name.size() - 3 : name.size();
  return name.replace(ending - from.size(), from.size(), to);
}

}  // namespace

MeshFile parse_mesh(std::string_view bytes, std::string_view name) {
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return parse_ply(bytes, name);
  if (bytes.starts_with("$MeshFormat") || bytes.starts_with("$Comments")) return parse_gmsh(bytes, name);
  if (has_extension(name, ".stl")) return parse_stl(bytes, name);
  if (has_extension(name, ".obj")) return parse_obj(require_text(bytes, name), name);
  if (has_extension(name, ".smesh")) return parse_smesh(require_text(bytes, name), name);
  if (bytes.starts_with("<?xml") || bytes.starts_with("<VTKFile"))
    throw InputError(std::string(name) + ":1: expected a mesh in a format that is read, got XML; VTP is only written");
  return parse_off(require_text(bytes, name), name);
}

MeshFile read_mesh(std::istream& input, std::string_view name) { return parse_mesh(read_stream(input, name), name); }

MeshFile read_mesh(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (has_extension(name, ".vert") || has_extension(name, ".face")) {
    const bool is_vertices = has_extension(name, ".vert");
    const std::string vertices = is_vertices ? name : sibling(name, ".face", ".vert");
    const std::string faces = is_vertices ? sibling(name, ".vert", ".face") : name;
    return parse_msms(read_file(vertices), vertices, read_file(faces), faces);
  }
  return parse_mesh(read_file(path), name);
}

}  // namespace gaussmesh

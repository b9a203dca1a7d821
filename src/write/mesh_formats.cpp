#include "write/mesh_formats.h"

#include <algorithm>

#include "gaussmesh/error.h"
#include "gaussmesh/nearest_name.h"
#include "text/read_file.h"

namespace gaussmesh {
namespace {

using enum HeldData;

constexpr std::array<FormatEntry, 11> kFormats = {{
    {"off", {".off"}, "vertices and triangles (AFMPB, DAFMPB, TetGen, bempp)", kNothing, {{{"", write_off}}}},
    {"msms",
     {".vert", ".face"},
     "two files, with normals and nearest atoms (TABI-PB, PyGBe, pbj, VMD)",
     kAll,
     {{{".vert", write_msms_vertices}, {".face", write_msms_faces}}}},
    {"ply", {".ply"}, "binary, with normals, nearest atoms, components (MeshLab)", kAll, {{{"", write_ply_binary}}}},
    {"ply-ascii", {}, "the same as text", kAll, {{{"", write_ply_ascii}}}},
    {"obj", {".obj"}, "with normals (ChimeraX, Blender)", kNormals, {{{"", write_obj}}}},
    {"stl", {".stl"}, "binary; 32-bit coordinates, vertices not shared", kNothing, {{{"", write_stl_binary}}}},
    {"stl-ascii", {}, "the same as text, with all decimals (TetGen)", kNothing, {{{"", write_stl_ascii}}}},
    {"gmsh22", {".msh"}, "Gmsh 2.2, a tag for each component, vertex data (bempp)", kAll, {{{"", write_gmsh_22}}}},
    {"gmsh41", {}, "the same as Gmsh 4.1", kAll, {{{"", write_gmsh_41}}}},
    {"smesh",
     {".smesh"},
     "TetGen, with a hole in each cavity, a region in each solid",
     kNothing,
     {{{"", write_smesh}}}},
    {"vtp", {".vtp"}, "VTK, with normals, nearest atoms, components (ParaView)", kAll, {{{"", write_vtp}}}},
}};

/// For messages.
std::string listed(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

const FormatEntry& find_by_name(const std::string& name) {
  std::vector<std::string_view> names;
  for (const FormatEntry& entry : kFormats) {
    if (entry.name == name) return entry;
    names.push_back(entry.name);
  }
  throw OptionError("format: expected " + listed(names) + ", got '" + name + "'" + did_you_mean(name, names));
}

const FormatEntry& find_by_extension(const std::filesystem::path& path) {
  const std::string extension = lower_case(std::filesystem::path(without_gzip(path.native())).extension().string());
  std::vector<std::string_view> extensions;
  for (const FormatEntry& entry : kFormats) {
    for (const std::string_view known : entry.extensions) {
      if (known.empty()) continue;
      if (known == extension) return entry;
      extensions.push_back(known);
    }
  }
  throw OptionError(path.string() + ": expected a format by name, or the extension " + listed(extensions) + ", got '" +
                    extension + "'" + did_you_mean(extension, extensions));
}

}  // namespace

const std::vector<MeshFormat>& mesh_formats() {
  static const std::vector<MeshFormat> formats = [] {
    std::vector<MeshFormat> list;
    for (const FormatEntry& entry : kFormats) {
      list.push_back({entry.name, {}, entry.description, entry.held});
      for (const std::string_view extension : entry.extensions)
        if (!extension.empty()) list.back().extensions.push_back(extension);
    }
    return list;
  }();
  return formats;
}

const FormatEntry& find_format(const std::filesystem::path& path, const WriteOptions& options) {
  const bool is_standard_output = path == "-";
  const bool is_named = !options.format.empty();
  const FormatEntry& entry = is_named             ? find_by_name(options.format)
                             : is_standard_output ? kFormats.front()
                                                  : find_by_extension(path);
  if (is_standard_output && entry.parts[1].write != nullptr) {
    throw OptionError("format '" + options.format + "': expected a file name, got '-'; it makes two files");
  }
  return entry;
}

const MeshFormat& format_of(const std::filesystem::path& path, const WriteOptions& options) {
  const auto place = &find_format(path, options) - kFormats.data();
  return mesh_formats()[static_cast<std::size_t>(place)];
}

std::filesystem::path part_path(const std::filesystem::path& path, const FormatPart& part) {
  if (part.extension.empty()) return path;
  std::filesystem::path result = without_gzip(path.native());
  const std::string ending = path.native().substr(result.native().size());
  const std::string own = lower_case(result.extension().string());
  if (own == part.extension) return path;  // in capitals too: what is named is what is written
  if (own == ".vert" || own == ".face") result.replace_extension();
  return (result += part.extension) += ending;
}

}  // namespace gaussmesh

// The table of formats, and which of them a file is to be written in.
#pragma once

#include <array>
#include <filesystem>

#include "gaussmesh/write_mesh.h"
#include "write/mesh_writer.h"

namespace gaussmesh {

/// One of the files that a format makes.
struct FormatPart {
  std::string_view extension;  ///< put in the place of the path's own; empty: the path as it is
  void (*write)(const MeshView& view, WholeFile& file) = nullptr;
};

/// MeshFormat, and how it is written. Formats have one extension or two, or none; the rest of the array is empty.
struct FormatEntry {
  std::string_view name;
  std::array<std::string_view, 2> extensions;
  std::string_view description;
  HeldData held;
  std::array<FormatPart, 2> parts;
};

/// The format that `options` name, or else the path's extension, in any case.
///
/// @throws OptionError if there is no such format, naming the nearest, or it cannot go to standard output
const FormatEntry& find_format(const std::filesystem::path& path, const WriteOptions& options);

/// Where a part of the format goes.
std::filesystem::path part_path(const std::filesystem::path& path, const FormatPart& part);

}  // namespace gaussmesh

// Writing meshes.
#pragma once

#include <filesystem>

#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// Writes OFF: `OFF`, `NV NF 0`, then `x y z` with nine decimals and `3 i j k`; no comments, no blank lines. This is the
/// dialect that AFMPB, TetGen and meshio all read, and nine decimals are exactly the coordinates in memory.
///
/// The file appears whole or not at all: it is written beside its place and renamed.
/// @throws InputError if the file cannot be written; an old file is then left as it was
void write_off(const TriangleMesh& mesh, const std::filesystem::path& path);

/// Writes text to a file in the same way.
void write_text(const std::string& text, const std::filesystem::path& path);

}  // namespace gaussmesh

// What the commands that judge, measure and convert meshes have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "gaussmesh/atom.h"
#include "gaussmesh/check_mesh.h"
#include "gaussmesh/read_mesh.h"
#include "gaussmesh/write_mesh.h"

namespace gaussmesh::app {

using Json = nlohmann::ordered_json;

/// printf into a string; a line is never longer than the buffer, 256 characters.
[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...);

/// `1 pair`, `2 pairs`.
std::string counted(std::size_t count, const char* one, const char* many);

/// `4 vertices, 4 triangles`.
std::string size_text(const MeshCheck& mesh);

/// Whether every component has an inside.
bool all_are_closed(const MeshCheck& mesh);

/// A table of the components, and their sums.
std::string components_text(const MeshCheck& mesh);
Json components_json(const MeshCheck& mesh);

/// Reads the mesh; `-` is standard input. @throws InputError
MeshFile read_mesh_argument(const std::string& path);

/// JSON as it is written, with a newline at the end; names that are not UTF-8 are made so.
std::string json_text(const Json& json);

/// Writes the JSON if a file is named, together with `files`, and prints the text to `out`: "-" puts the JSON on
/// standard output in place of the text. @throws InputError if one of them cannot be written; then there are no files
void put_report(const std::string& text, const std::string& json, const std::optional<std::string>& json_file,
                std::ostream& out = std::cout, OutputFiles files = {});

/// The option that names the file.
void add_json_option(CLI::App& command, std::optional<std::string>& file);

}  // namespace gaussmesh::app

#include "report_parts.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <iostream>

#include "output_options.h"
#include "validators.h"

namespace gaussmesh::app {
namespace {

const char* kind_of(const MeshComponent& component) {
  if (!component.closed) return "not closed";
  return component.is_cavity() ? "cavity" : "outside";
}

}  // namespace

std::string line(const char* format, ...) {
  char buffer[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string size_text(const MeshCheck& mesh) {
  return counted(mesh.vertices, "vertex", "vertices") + ", " + counted(mesh.triangles, "triangle", "triangles");
}

bool all_are_closed(const MeshCheck& mesh) {
  return std::all_of(mesh.components.begin(), mesh.components.end(), [](const MeshComponent& c) { return c.closed; });
}

std::string components_text(const MeshCheck& mesh) {
  constexpr std::size_t kMost = 20;
  std::string text = line("Components: %zu, Euler number %lld, area %.8g A^2, volume %.8g A^3\n",
                          mesh.components.size(), static_cast<long long>(mesh.chi), mesh.area, mesh.volume);
  text += "  kind         triangles    vertices   handles        area/A^2      volume/A^3\n";
  for (std::size_t i = 0; i < std::min(kMost, mesh.components.size()); ++i) {
    const MeshComponent& c = mesh.components[i];
    text += line("  %-10s %11zu %11zu %9lld %15.8g %15.8g%s\n", kind_of(c), c.triangles, c.vertices,
                 static_cast<long long>(c.genus), c.area, c.volume, c.inverted ? "  inside out" : "");
  }
  if (mesh.components.size() > kMost) text += line("  and %zu smaller ones\n", mesh.components.size() - kMost);
  return text;
}

Json components_json(const MeshCheck& mesh) {
  Json list = Json::array();
  for (const MeshComponent& c : mesh.components)
    list.push_back({{"kind", kind_of(c)},
                    {"depth", c.depth},
                    {"inverted", c.inverted},
                    {"triangles", c.triangles},
                    {"vertices", c.vertices},
                    {"chi", c.chi},
                    {"genus", c.genus},
                    {"area_A2", c.area},
                    {"volume_A3", c.volume}});
  return list;
}

MeshFile read_mesh_argument(const std::string& path) {
  return path == "-" ? read_mesh(std::cin, "standard input") : read_mesh(path);
}

std::string json_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

void put_report(const std::string& text, const std::string& json, const std::optional<std::string>& json_file,
                std::ostream& out, OutputFiles files) {
  const bool json_to_terminal = json_file == "-";
  if (json_file && !json_to_terminal) files.add_text(json, *json_file);
  print_at_once(json_to_terminal ? std::cout : out, json_to_terminal ? json : text);
  files.commit();
}

void add_json_option(CLI::App& command, std::optional<std::string>& file) {
  command
      .add_option("--json", file, "write what is found as JSON; -: to the terminal, and nothing else (default: none)")
      ->type_name("FILE")
      ->check(file_name_of_option());
}

}  // namespace gaussmesh::app

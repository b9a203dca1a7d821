// Gmsh .msh in ASCII, versions 2.2 and 4.1: nodes and triangles.
//
// https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format

#include <array>
#include <limits>
#include <unordered_map>

#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

constexpr int kTriangle = 2;  // Gmsh's number for the element type
constexpr std::string_view kVersions = "version 2.2 or 4.1 in ASCII, '2.2 0 8' or '4.1 0 8'";
constexpr std::string_view kNode = "a node: its tag and three finite coordinates";
constexpr std::string_view kElement = "an element: its tag, type and tags, and nodes that are there";
constexpr std::string_view kBlock = "a block: dimension, entity, type, and how many follow";

class GmshParser {
 public:
  GmshParser(std::string_view text, std::string_view name) : lines_(text, name) {}

  MeshFile parse() {
    bool has_nodes = false, has_elements = false;
    while (lines_.next()) {
      const std::string_view section = lines_.fields()[0];
      if (section == "$MeshFormat") read_format();
      if (section == "$Nodes") {
        is_version_4_ ? read_node_blocks() : read_nodes();
        has_nodes = true;
      }
      if (section == "$Elements") {
        is_version_4_ ? read_element_blocks() : read_elements();
        has_elements = true;
      }
    }
    if (!has_nodes || !has_elements) lines_.fail("the sections $Nodes and $Elements");
    if (has_other_elements_) leave_out_unused_nodes();
    return std::move(file_);
  }

 private:
  /// Goes to the line that begins a section or a block, and takes a count from it.
  std::size_t next_count(std::size_t field, std::string_view expected) {
    lines_.require_next(expected);
    return lines_.integer<std::size_t>(field, expected);
  }

  void read_format() {
    lines_.require_next(kVersions);
    const auto fields = lines_.fields();
    if (fields.size() < 2 || (fields[0] != "2.2" && fields[0] != "4.1") || fields[1] != "0") lines_.fail(kVersions);
    is_version_4_ = fields[0] == "4.1";
  }

  void read_nodes() {
    const std::size_t count = next_count(0, "the number of nodes");
    for (std::size_t i = 0; i < count; ++i) {
      lines_.require_next(kNode);
      add_node(lines_.integer<std::uint64_t>(0, kNode), lines_.point(1, kNode));
    }
  }

  void read_node_blocks() {
    const std::size_t blocks = next_count(0, "the number of blocks of nodes");
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t count = next_count(3, kBlock);
      std::vector<std::uint64_t> tags;
      for (std::size_t i = 0; i < count; ++i) {
        lines_.require_next(kNode);
        tags.push_back(lines_.integer<std::uint64_t>(0, kNode));
      }
      for (const std::uint64_t tag : tags) {
        lines_.require_next(kNode);
        add_node(tag, lines_.point(0, kNode));
      }
    }
  }

  void add_node(std::uint64_t tag, const Point& point) {
    const auto place = static_cast<std::uint32_t>(file_.mesh.vertices.size());
    if (!place_of_.try_emplace(tag, place).second) lines_.fail("a node tag that is not there yet");
    file_.mesh.vertices.push_back(point);
  }

  void read_elements() {
    const std::size_t count = next_count(0, "the number of elements");
    for (std::size_t i = 0; i < count; ++i) {
      lines_.require_next(kElement);
      const auto tags = lines_.integer<std::size_t>(2, kElement);
      add_element(lines_.integer<int>(1, kElement), 3 + std::min(tags, lines_.fields().size()));
    }
  }

  void read_element_blocks() {
    const std::size_t blocks = next_count(0, "the number of blocks of elements");
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t count = next_count(3, kBlock);
      const int type = lines_.integer<int>(2, kBlock);
      for (std::size_t i = 0; i < count; ++i) {
        lines_.require_next(kElement);
        add_element(type, 1);
      }
    }
  }

  /// The element of this line, its nodes from field `first` on.
  void add_element(int type, std::size_t first) {
    if (type != kTriangle) {
      has_other_elements_ = true;
      return;
    }
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto node = place_of_.find(lines_.integer<std::uint64_t>(first + k, kElement));
      if (node == place_of_.end()) lines_.fail(kElement);
      triangle[k] = node->second;
    }
    file_.mesh.triangles.push_back(triangle);
  }

  void leave_out_unused_nodes() {
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(file_.mesh.vertices.size(), kUnused);
    for (const Triangle& triangle : file_.mesh.triangles)
      for (const std::uint32_t v : triangle) place[v] = 0;
    std::vector<Point> used;
    for (std::size_t v = 0; v < place.size(); ++v) {
      if (place[v] == kUnused) continue;
      place[v] = static_cast<std::uint32_t>(used.size());
      used.push_back(file_.mesh.vertices[v]);
    }
    for (Triangle& triangle : file_.mesh.triangles)
      for (std::uint32_t& v : triangle) v = place[v];
    file_.mesh.vertices = std::move(used);
  }

  MeshLines lines_;
  MeshFile file_;
  bool is_version_4_ = false;
  bool has_other_elements_ = false;
  std::unordered_map<std::uint64_t, std::uint32_t> place_of_;  // of a node's tag
};

/// Throws InputError if the second line says so. Up to there binary files are text.
void require_ascii(std::string_view bytes, std::string_view name) {
  MeshLines lines(bytes.substr(0, bytes.find('\0')), name);
  while (lines.next() && lines.fields()[0] != "$MeshFormat") {
  }
  if (lines.next() && lines.fields().size() > 1 && lines.fields()[1] == "1") {
    lines.fail(kVersions, "; the file is binary, save it as ASCII");
  }
}

}  // namespace

MeshFile parse_gmsh(std::string_view bytes, std::string_view name) {
  require_ascii(bytes, name);
  return GmshParser(require_text(bytes, name), name).parse();
}

}  // namespace gaussmesh

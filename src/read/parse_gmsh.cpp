// Gmsh .msh, versions 2.2 and 4.1: nodes and triangles. Text and bytes are gmsh_input.h.
//
// https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format and, for 2.2, #MSH-file-format-version-2-_0028Legacy_0029

#include <limits>
#include <unordered_map>

#include "read/gmsh_elements.h"
#include "read/gmsh_input.h"
#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

constexpr std::string_view kVersions = "version 2.2 or 4.1 in ASCII or binary, as '2.2 0 8' or '4.1 1 8'";
constexpr std::string_view kNode = "a node: its tag and three finite coordinates";
constexpr std::string_view kElement = "an element: its tag, type and tags, and nodes that are there";
constexpr std::string_view kBlock = "a block: dimension, entity, type, and how many follow";

/// `Input` is AsciiGmshInput or BinaryGmshInput.
template <class Input>
class GmshParser {
 public:
  GmshParser(std::string_view bytes, std::string_view name) : name_(name), input_(bytes, name) {}

  MeshFile parse() {
    while (input_.next_line()) read_section(input_.fields()[0]);
    if (!has_nodes_ || !has_elements_) input_.fail_at_line("the sections $Nodes and $Elements");
    if (has_other_elements_) {
      require_triangles();
      leave_out_unused_vertices(file_.mesh);
    }
    return std::move(file_);
  }

 private:
  using Tag2 = std::int32_t;  // of nodes and elements, in binary files of version 2.2
  using Tag4 = std::uint64_t;

  void read_section(std::string_view section) {
    if (section == "$MeshFormat") {
      read_format();
    } else if (section == "$Nodes") {
      is_version_4_ ? read_node_blocks() : read_nodes();
      has_nodes_ = true;
    } else if (section == "$Elements") {
      is_version_4_ ? read_element_blocks() : read_elements();
      has_elements_ = true;
    } else {
      input_.skip_section(section);
      return;
    }
    const std::string end = "$End" + std::string(section.substr(1));
    if (!input_.next_line() || input_.fields()[0] != end) input_.fail_at_line("'" + end + "'");
  }

  void read_format() {
    if (!input_.next_line()) input_.fail_at_line(kVersions);
    const auto fields = input_.fields();
    constexpr std::string_view kEncoding = Input::kIsBinary ? "1" : "0";
    const bool is_known = fields.size() > 1 && (fields[0] == "2.2" || fields[0] == "4.1") && fields[1] == kEncoding;
    if (!is_known || (Input::kIsBinary && (fields.size() < 3 || fields[2] != "8"))) input_.fail_at_line(kVersions);
    is_version_4_ = fields[0] == "4.1";
    input_.read_byte_order();
  }

  /// The number alone on a line that heads a section of version 2.2.
  std::uint64_t read_count(std::string_view expected) {
    const auto count = input_.next_line() ? parse_integer<std::uint64_t>(input_.fields()[0]) : std::nullopt;
    if (!count) input_.fail_at_line(expected);
    return *count;
  }

  /// The number of blocks, which heads a section of version 4.1.
  std::uint64_t read_block_count(std::string_view expected) {
    input_.begin_record(expected);
    const std::uint64_t blocks = whole<std::uint64_t>(expected);
    skip<std::uint64_t>(3);  // how many things are in them, and the range of their tags
    return blocks;
  }

  void read_nodes() {
    const std::uint64_t count = read_count("the number of nodes");
    for (std::uint64_t i = 0; i < count; ++i) {
      input_.begin_record(kNode);
      const std::uint64_t tag = whole<Tag2>(kNode);
      add_node(tag, input_.point(kNode));
    }
  }

  void read_node_blocks() {
    const std::uint64_t blocks = read_block_count("the number of blocks of nodes");
    for (std::uint64_t b = 0; b < blocks; ++b) {
      input_.begin_record(kBlock);
      const std::uint64_t dimension = whole<std::int32_t>(kBlock);
      skip<std::int32_t>(1);
      const std::uint64_t parameters = whole<std::int32_t>(kBlock) > 0 ? dimension : 0;  // behind the coordinates
      const std::uint64_t count = whole<std::uint64_t>(kBlock);
      std::vector<std::uint64_t> tags;
      for (std::uint64_t i = 0; i < count; ++i) {
        input_.begin_record(kNode);
        tags.push_back(whole<Tag4>(kNode));
      }
      for (const std::uint64_t tag : tags) {
        input_.begin_record(kNode);
        add_node(tag, input_.point(kNode));
        skip<double>(parameters);
      }
    }
  }

  void add_node(std::uint64_t tag, const Point& point) {
    const auto place = static_cast<std::uint32_t>(file_.mesh.vertices.size());
    if (!place_of_.try_emplace(tag, place).second)
      input_.fail("a node tag that is not there yet", gaussmesh::quoted(std::to_string(tag)));
    file_.mesh.vertices.push_back(point);
  }

  void read_elements() {
    const std::uint64_t count = read_count("the number of elements");
    for (std::uint64_t i = 0; i < count;) i += read_alike(count - i);
  }

  /// Elements of one type, at most so many; returns how many there were. In text each has a head of its own.
  std::uint64_t read_alike(std::uint64_t most) {
    input_.begin_record(kElement);
    if constexpr (!Input::kIsBinary) skip<Tag2>(1);
    const std::uint64_t type = whole<std::int32_t>(kElement);
    const std::uint64_t count = Input::kIsBinary ? whole<std::int32_t>(kElement) : 1;
    const std::uint64_t tags = whole<std::int32_t>(kElement);
    if (count == 0 || count > most)
      input_.fail("1 to " + std::to_string(most) + " elements", gaussmesh::quoted(std::to_string(count)));
    for (std::uint64_t i = 0; i < count; ++i) {
      if constexpr (Input::kIsBinary) {
        input_.begin_record(kElement);
        skip<Tag2>(1);
      }
      skip<std::int32_t>(tags);
      add_element<Tag2>(type);
    }
    return count;
  }

  void read_element_blocks() {
    const std::uint64_t blocks = read_block_count("the number of blocks of elements");
    for (std::uint64_t b = 0; b < blocks; ++b) {
      input_.begin_record(kBlock);
      skip<std::int32_t>(2);
      const std::uint64_t type = whole<std::int32_t>(kBlock);
      const std::uint64_t count = whole<std::uint64_t>(kBlock);
      for (std::uint64_t i = 0; i < count; ++i) {
        input_.begin_record(kElement);
        skip<Tag4>(1);
        add_element<Tag4>(type);
      }
    }
  }

  /// The element whose nodes come next.
  template <class Tag>
  void add_element(std::uint64_t type) {
    if (type != kGmshTriangle) {
      skip<Tag>(require_no_surface(type).nodes);
      has_other_elements_ = true;
      return;
    }
    Triangle triangle{};
    for (std::uint32_t& corner : triangle) {
      const std::uint64_t tag = whole<Tag>(kElement);
      const auto node = place_of_.find(tag);
      if (node == place_of_.end()) input_.fail(kElement, "node " + gaussmesh::quoted(std::to_string(tag)));
      corner = node->second;
    }
    file_.mesh.triangles.push_back(triangle);
  }

  /// Throws InputError for parts of the surface that are no triangles, and for what may be such.
  const GmshElement& require_no_surface(std::uint64_t type) {
    const GmshElement* const element = find_gmsh_element(type);
    const std::string number = "type " + std::to_string(type);
    if (element == nullptr) input_.fail("an element of type 1 to 31, 92 or 93", number);
    if (element->dimension == 2) {
      input_.fail("a triangle of 3 nodes, type 2", "a " + std::string(element->shape) + " of " +
                                                       std::to_string(element->nodes) + ", " + number +
                                                       "; mesh the surface with triangles of first order");
    }
    return *element;
  }

  void require_triangles() const {
    if (!file_.mesh.triangles.empty()) return;
    throw InputError(std::string(name_) +
                     ": expected triangles, got points, lines or solids alone; save the surface too");
  }

  template <class Binary>
  std::uint64_t whole(std::string_view expected) {
    return input_.template whole<Binary>(expected);
  }

  template <class Binary>
  void skip(std::uint64_t count) {
    input_.template skip<Binary>(count);
  }

  std::string_view name_;
  Input input_;
  MeshFile file_;
  bool is_version_4_ = false;
  bool has_nodes_ = false;
  bool has_elements_ = false;
  bool has_other_elements_ = false;
  std::unordered_map<std::uint64_t, std::uint32_t> place_of_;  // of a node's tag
};

/// Whether the line behind $MeshFormat says so. Up to there binary files are text.
bool is_binary_gmsh(std::string_view bytes, std::string_view name) {
  MeshLines lines(bytes.substr(0, bytes.find('\0')), name);
  while (lines.next() && lines.fields()[0] != "$MeshFormat") {
  }
  return lines.next() && lines.fields().size() > 1 && lines.fields()[1] == "1";
}

}  // namespace

MeshFile parse_gmsh(std::string_view bytes, std::string_view name) {
  return is_binary_gmsh(bytes, name) ? GmshParser<BinaryGmshInput>(bytes, name).parse()
                                     : GmshParser<AsciiGmshInput>(bytes, name).parse();
}

}  // namespace gaussmesh

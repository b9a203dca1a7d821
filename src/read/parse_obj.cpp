// Wavefront OBJ: `v x y z`, `vn x y z`, `f` with corners v, v/vt, v//vn or v/vt/vn, from 1 or backwards from -1.

#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

/// One corner of a face.
struct Corner {
  std::uint32_t vertex = 0;
  std::optional<std::uint32_t> normal;
};

class ObjParser {
 public:
  ObjParser(std::string_view text, std::string_view name) : lines_(text, name) {}

  MeshFile parse() {
    while (lines_.next()) read_line();
    if (!corners_have_normals_ || file_.mesh.triangles.empty() || normals_.size() != file_.mesh.vertices.size())
      normals_.clear();
    file_.data.normals = std::move(normals_);
    return std::move(file_);
  }

 private:
  void read_line() {
    const std::string_view keyword = lines_.fields()[0];
    if (keyword == "v") file_.mesh.vertices.push_back(lines_.point(1, "'v' and three finite coordinates"));
    if (keyword == "vn") normals_.push_back(to_normal(lines_.point(1, "'vn' and three finite numbers")));
    if (keyword == "f") read_face();
  }

  void read_face() {
    if (lines_.fields().size() != 4) fail_at_face();
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner corner = read_corner(lines_.fields()[k + 1]);
      triangle[k] = corner.vertex;
      corners_have_normals_ = corners_have_normals_ && corner.normal == corner.vertex;
    }
    file_.mesh.triangles.push_back(triangle);
  }

  Corner read_corner(std::string_view field) const {
    const std::size_t first = std::min(field.find('/'), field.size());
    Corner corner{place(field.substr(0, first), file_.mesh.vertices.size()), {}};
    const std::size_t second = field.find('/', first + 1);
    if (second != std::string_view::npos) corner.normal = place(field.substr(second + 1), normals_.size());
    return corner;
  }

  /// From 1, or from -1 backwards through the `count` that are there so far.
  std::uint32_t place(std::string_view field, std::size_t count) const {
    const auto number = parse_integer<std::int64_t>(field);
    if (!number || *number == 0) fail_at_face();
    const std::int64_t from_0 = *number > 0 ? *number - 1 : static_cast<std::int64_t>(count) + *number;
    if (from_0 < 0 || from_0 > kMostVertices) fail_at_face();
    return static_cast<std::uint32_t>(from_0);
  }

  [[noreturn]] void fail_at_face() const { lines_.fail("a triangle, 'f' and three vertex numbers"); }

  static constexpr std::int64_t kMostVertices = 0xFFFFFFFE;

  MeshLines lines_;
  MeshFile file_;
  std::vector<Normal> normals_;
  bool corners_have_normals_ = true;
};

}  // namespace

MeshFile parse_obj(std::string_view text, std::string_view name) { return ObjParser(text, name).parse(); }

}  // namespace gaussmesh

// VTK PolyData: pieces with points and polygons, and what is known of the points.

#include <algorithm>

#include "core/number_text.h"
#include "read/mesh_text.h"
#include "read/vtk_arrays.h"

namespace gaussmesh {
namespace {

class VtpParser {
 public:
  VtpParser(std::string_view bytes, std::string_view name)
      : xml_(bytes, name, "AppendedData"), arrays_(xml_, "PolyData") {}

  MeshFile parse() {
    const XmlElement* const root = xml_.find("VTKFile", std::nullopt);
    const XmlElement* const data = xml_.find("PolyData", xml_.place_of(*root));
    if (data == nullptr) xml_.fail(*root, "an element PolyData", "none");
    for (const XmlElement& element : xml_.all()) {
      if (element.name == "Piece" && element.parent == xml_.place_of(*data)) read_piece(element);
    }
    VertexData& known = file_.data;
    const std::size_t vertices = file_.mesh.vertices.size();
    // What not every piece has is not known.
    if (known.normals.size() != vertices) known.normals.clear();
    if (known.atoms.size() != vertices) known.atoms.clear();
    if (known.components.size() != vertices) known.components.clear();
    return std::move(file_);
  }

 private:
  std::size_t count(const XmlElement& piece, std::string_view what) const {
    const std::string_view text = piece.attribute(what);
    const auto number = text.empty() ? 0 : parse_integer<std::size_t>(text);
    if (!number) xml_.fail(piece, "a number for " + std::string(what), text);
    return *number;
  }

  void read_piece(const XmlElement& piece) {
    if (count(piece, "NumberOfStrips") > 0)
      xml_.fail(piece, "triangles", std::string(piece.attribute("NumberOfStrips")) + " strips",
                "; VTK's vtkTriangleFilter makes triangles of them");
    const std::size_t first = file_.mesh.vertices.size();
    const std::size_t points = count(piece, "NumberOfPoints"), triangles = count(piece, "NumberOfPolys");
    if (points > 0) read_points(piece, points);
    if (triangles > 0) read_triangles(piece, triangles, first, points);
    const XmlElement* const data = xml_.find("PointData", xml_.place_of(piece));
    if (points > 0 && data != nullptr) read_point_data(*data, points);
  }

  /// The array of that name in a group such as Polys, or the first of all where the name is empty; nothing if there is
  /// none.
  const XmlElement* find_array(const XmlElement& group, std::string_view name) const {
    for (const XmlElement& element : xml_.all()) {
      const bool is_here = element.name == "DataArray" && element.parent == xml_.place_of(group);
      if (is_here && (name.empty() || element.attribute("Name") == name)) return &element;
    }
    return nullptr;
  }

  /// The numbers of an array that must be there, in a group of a piece.
  std::vector<double> require_array(const XmlElement& piece, std::string_view group_name, std::string_view name,
                                    std::size_t size) const {
    const XmlElement* const group = xml_.find(group_name, xml_.place_of(piece));
    const XmlElement* const array = group == nullptr ? nullptr : find_array(*group, name);
    const std::string what = std::string(group_name) + (name.empty() ? "" : "/") + std::string(name);
    if (array == nullptr) xml_.fail(piece, "an array " + what, "none");
    std::vector<double> numbers = arrays_.read(*array);
    if (numbers.size() != size)
      xml_.fail(*array, std::to_string(size) + " numbers in " + what, std::to_string(numbers.size()));
    return numbers;
  }

  void read_points(const XmlElement& piece, std::size_t points) {
    const std::vector<double> numbers = require_array(piece, "Points", "", 3 * points);
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
      const Point point = {numbers[i], numbers[i + 1], numbers[i + 2]};
      for (const double x : point)
        if (!std::isfinite(x)) xml_.fail(piece, "finite coordinates", number_text(x));
      file_.mesh.vertices.push_back(point);
    }
  }

  void read_triangles(const XmlElement& piece, std::size_t triangles, std::size_t first, std::size_t points) {
    const std::vector<double> ends = require_array(piece, "Polys", "offsets", triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
      if (ends[i] != static_cast<double>(3 * (i + 1)))
        xml_.fail(piece, "polygons of three corners alone, offsets 3, 6, 9, ...", number_text(ends[i]));
    }
    const std::vector<double> corners = require_array(piece, "Polys", "connectivity", 3 * triangles);
    // Of the only piece the numbers are those of the mesh, which check_mesh() judges.
    const double end = first > 0 ? static_cast<double>(points) : static_cast<double>(kMostVertices);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      Triangle triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double corner = corners[i + k];
        if (!(corner >= 0.0 && corner < end)) xml_.fail(piece, "numbers of points", number_text(corner));
        triangle[k] = static_cast<std::uint32_t>(first + static_cast<std::size_t>(corner));
      }
      file_.mesh.triangles.push_back(triangle);
    }
  }

  void read_point_data(const XmlElement& data, std::size_t points) {
    const std::string_view normals = data.attribute("Normals");
    const XmlElement* const array = find_array(data, normals.empty() ? "normal" : normals);
    const std::vector<double> numbers = array == nullptr ? std::vector<double>{} : arrays_.read(*array);
    for (std::size_t i = 0; numbers.size() == 3 * points && i < numbers.size(); i += 3)
      file_.data.normals.push_back(to_normal({numbers[i], numbers[i + 1], numbers[i + 2]}));
    read_numbers(data, "atom", points, file_.data.atoms);
    read_numbers(data, "component", points, file_.data.components);
  }

  /// Whole numbers that are known of the points. Filters of VTK may have made others of them, which say nothing.
  void read_numbers(const XmlElement& data, std::string_view name, std::size_t points,
                    std::vector<std::uint32_t>& into) const {
    const XmlElement* const array = find_array(data, name);
    if (array == nullptr || array->attribute("type").find("Int") == std::string_view::npos) return;
    const std::vector<double> numbers = arrays_.read(*array);
    const auto fits = [](double number) { return number >= 0.0 && number <= 0xFFFFFFFF; };
    if (numbers.size() != points || !std::all_of(numbers.begin(), numbers.end(), fits)) return;
    for (const double number : numbers) into.push_back(static_cast<std::uint32_t>(number));
  }

  static constexpr std::uint32_t kMostVertices = 0xFFFFFFFE;

  XmlElements xml_;
  VtkArrays arrays_;
  MeshFile file_;
};

}  // namespace

MeshFile parse_vtp(std::string_view bytes, std::string_view name) { return VtpParser(bytes, name).parse(); }

}  // namespace gaussmesh

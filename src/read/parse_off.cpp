// OFF: a header, the counts, a line for each vertex, a line for each face.
//
// https://shape.cs.princeton.edu/benchmark/documentation/off_format.html, and for what may stand in front of `OFF`
// http://www.geomview.org/docs/html/OFF.html

#include <array>

#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

struct Counts {
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

/// What stands in front of `OFF` says what follows the coordinates of a vertex: N a normal, C a colour, ST a place in a
/// texture.
struct Header {
  Counts counts;
  bool has_prefix = false;
  bool has_normals = false;  ///< which come first
};

/// The normals of `NOFF` come first, and so they do in `CNOFF` and `STCNOFF`, as Geomview and CGAL write it. MeshLab
/// puts colours in front of them, and says `NCOFF`.
Header read_prefix(const MeshLines& lines) {
  constexpr std::string_view kOff = "OFF";
  const std::string_view keyword = lines.fields()[0];
  if (!keyword.ends_with(kOff)) lines.fail("the header 'OFF'");
  const std::string_view prefix = keyword.substr(0, keyword.size() - kOff.size());
  for (std::string_view rest = prefix; !rest.empty();) {
    if (rest[0] == '4' || rest[0] == 'n') lines.fail("'OFF' with three coordinates at each vertex");
    const std::size_t known = rest.starts_with("ST") ? 2 : rest[0] == 'C' || rest[0] == 'N' ? 1 : 0;
    if (known == 0) lines.fail("the header 'OFF', perhaps with ST, C or N in front of it");
    rest.remove_prefix(known);
  }
  Header header;
  header.has_prefix = !prefix.empty();
  const std::size_t normal = prefix.find('N'), colour = prefix.find('C');
  header.has_normals = normal != std::string_view::npos && (colour == std::string_view::npos || colour < normal);
  return header;
}

/// The keyword, and the numbers of vertices, faces and, if it is there, edges, on the same line or on the next.
Header read_header(MeshLines& lines) {
  constexpr std::string_view kCounts = "the numbers of vertices, faces and edges";
  lines.require_next("the header 'OFF'");
  Header header = read_prefix(lines);
  std::size_t first = 1;
  if (lines.fields().size() == first) {
    lines.require_next(kCounts);
    first = 0;
  }
  header.counts = {lines.integer<std::size_t>(first, kCounts), lines.integer<std::size_t>(first + 1, kCounts)};
  if (lines.fields().size() > first + 2) lines.integer<std::size_t>(first + 2, kCounts);
  if (lines.fields().size() > first + 3) lines.fail(kCounts);
  return header;
}

/// Text for a message, made only where it is needed.
std::string place_in(const char* what, std::size_t i, std::size_t count) {
  return std::string(what) + " " + std::to_string(i + 1) + " of " + std::to_string(count);
}

/// The coordinates, and the normal if there is one. Other numbers behind them are passed over, in plain OFF only where
/// they are three or more: colours that nobody announced. One more is a face among the vertices.
void read_vertex(MeshLines& lines, const Header& header, std::size_t i, MeshFile& file) {
  constexpr std::size_t kMost = 6;
  std::array<double, kMost> values{};
  bool is_good = lines.next();
  const std::size_t count = lines.fields().size();
  is_good = is_good && count >= (header.has_normals ? 6 : 3) && (header.has_prefix || count == 3 || count >= 6);
  for (std::size_t k = 0; k < count && is_good; ++k) {
    const std::optional<double> x = parse_number(lines.fields()[k]);
    is_good = x.has_value();
    if (is_good && k < kMost) values[k] = *x;
  }
  if (!is_good) {
    lines.fail(place_in("vertex", i, header.counts.vertices) +
               (header.has_normals ? ": three finite coordinates and a normal" : ": three finite coordinates"));
  }
  file.mesh.vertices.push_back({values[0], values[1], values[2]});
  if (header.has_normals) file.data.normals.push_back(to_normal({values[3], values[4], values[5]}));
}

/// What follows the three vertices is the colour.
Triangle read_face(MeshLines& lines, std::size_t i, std::size_t count) {
  Triangle triangle{};
  bool is_good = lines.next() && lines.fields().size() > 3 && parse_integer<int>(lines.fields()[0]) == 3;
  for (std::size_t k = 0; k < 3 && is_good; ++k) {
    const auto vertex = parse_integer<std::uint32_t>(lines.fields()[k + 1]);
    is_good = vertex.has_value();
    if (is_good) triangle[k] = *vertex;
  }
  if (!is_good) lines.fail(place_in("face", i, count) + ": a triangle, '3' and three vertex numbers");
  return triangle;
}

/// Throws InputError if the first line says so. Up to there binary files are text.
void require_ascii(std::string_view bytes, std::string_view name) {
  MeshLines lines(bytes.substr(0, bytes.find('\0')), name);
  if (!lines.next() || lines.fields().size() < 2) return;
  if (lines.fields()[0].ends_with("OFF") && lines.fields()[1] == "BINARY") {
    lines.fail("OFF in ASCII", "; the file is binary, save it as ASCII");
  }
}

}  // namespace

MeshFile parse_off(std::string_view bytes, std::string_view name) {
  constexpr std::size_t kShortestVertex = 6;  // bytes: "0 0 0\n"
  constexpr std::size_t kShortestFace = 8;    // "3 0 1 2\n"
  require_ascii(bytes, name);
  MeshLines lines(require_text(bytes, name), name);
  const Header header = read_header(lines);
  const Counts& counts = header.counts;
  MeshFile file;
  file.mesh.vertices.reserve(lines.at_most(counts.vertices, kShortestVertex));
  for (std::size_t i = 0; i < counts.vertices; ++i) read_vertex(lines, header, i, file);
  file.mesh.triangles.reserve(lines.at_most(counts.faces, kShortestFace));
  for (std::size_t i = 0; i < counts.faces; ++i) file.mesh.triangles.push_back(read_face(lines, i, counts.faces));
  if (lines.next()) lines.fail("nothing after " + std::to_string(counts.faces) + " faces");
  return file;
}

}  // namespace gaussmesh

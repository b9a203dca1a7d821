// OFF: a header, the counts, a line for each vertex, a line for each face.
//
// https://shape.cs.princeton.edu/benchmark/documentation/off_format.html

#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

struct Counts {
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

/// `OFF`, and the numbers of vertices, faces and, if it is there, edges, on the same line or on the next.
Counts read_header(MeshLines& lines) {
  constexpr std::string_view kHeader = "the header 'OFF'", kCounts = "the numbers of vertices, faces and edges";
  lines.require_next(kHeader);
  if (lines.fields()[0] != "OFF") lines.fail(kHeader);
  std::size_t first = 1;
  if (lines.fields().size() == first) {
    lines.require_next(kCounts);
    first = 0;
  }
  const Counts counts{lines.integer<std::size_t>(first, kCounts), lines.integer<std::size_t>(first + 1, kCounts)};
  if (lines.fields().size() > first + 2) lines.integer<std::size_t>(first + 2, kCounts);
  if (lines.fields().size() > first + 3) lines.fail(kCounts);
  return counts;
}

/// Text for a message, made only where it is needed.
std::string place_in(const char* what, std::size_t i, std::size_t count) {
  return std::string(what) + " " + std::to_string(i + 1) + " of " + std::to_string(count);
}

Point read_vertex(MeshLines& lines, std::size_t i, std::size_t count) {
  Point point{};
  bool is_good = lines.next() && lines.fields().size() == 3;
  for (std::size_t k = 0; k < 3 && is_good; ++k) {
    const std::optional<double> x = parse_number(lines.fields()[k]);
    is_good = x.has_value();
    if (is_good) point[k] = *x;
  }
  if (!is_good) lines.fail(place_in("vertex", i, count) + ": three finite coordinates");
  return point;
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

}  // namespace

MeshFile parse_off(std::string_view text, std::string_view name) {
  constexpr std::size_t kShortestVertex = 6;  // bytes: "0 0 0\n"
  constexpr std::size_t kShortestFace = 8;    // "3 0 1 2\n"
  MeshLines lines(text, name);
  const Counts counts = read_header(lines);
  MeshFile file;
  TriangleMesh& mesh = file.mesh;
  mesh.vertices.reserve(lines.at_most(counts.vertices, kShortestVertex));
  for (std::size_t i = 0; i < counts.vertices; ++i) mesh.vertices.push_back(read_vertex(lines, i, counts.vertices));
  mesh.triangles.reserve(lines.at_most(counts.faces, kShortestFace));
  for (std::size_t i = 0; i < counts.faces; ++i) mesh.triangles.push_back(read_face(lines, i, counts.faces));
  if (lines.next()) lines.fail("nothing after " + std::to_string(counts.faces) + " faces");
  return file;
}

}  // namespace gaussmesh

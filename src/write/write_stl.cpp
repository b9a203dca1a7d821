// STL: each triangle with its normal and three corners; vertices are not shared. In binary all are 32-bit floats; as
// text, which is what TetGen reads, corners have the decimals of all formats.
//
// https://www.fabbers.com/tech/STL_Format

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "gaussmesh/error.h"
#include "verify/vector3.h"
#include "write/mesh_writer.h"

namespace gaussmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is written as it is in memory");

using FloatPoint = std::array<float, 3>;

constexpr std::size_t kHeader = 80;
constexpr std::size_t kRecord = 50;

FloatPoint to_float(const Point& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

/// Of the triangle a b c; zero if it has no area.
FloatPoint unit_normal(const Point& a, const Point& b, const Point& c) {
  Point normal = verify::cross(verify::difference(b, a), verify::difference(c, a));
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  if (length > 0.0) {
    for (double& x : normal) x /= length;
  }
  return to_float(normal);
}

}  // namespace

void write_stl_binary(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw OptionError("format 'stl': expected fewer than 2^32 triangles, got '" +
                      std::to_string(mesh.triangles.size()) + "'");
  }
  std::string header = "binary STL written by gaussmesh, lengths in A";
  header.resize(kHeader, ' ');
  char count[sizeof(std::uint32_t)];
  put_bytes(count, static_cast<std::uint32_t>(mesh.triangles.size()));
  file.write(header);
  file.write({count, sizeof count});
  write_records(file, mesh.triangles.size(), kRecord, [&](char* p, std::size_t i) {
    const auto& [a, b, c] = mesh.triangles[i];
    p = put_bytes(p, unit_normal(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
    for (const std::uint32_t v : mesh.triangles[i]) p = put_bytes(p, to_float(mesh.vertices[v]));
    return put_bytes(p, std::uint16_t{0});
  });
}

void write_stl_ascii(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  constexpr std::size_t kWords = 80;  // bytes of a facet that are no numbers
  file.write("solid gaussmesh\n");
  write_records(file, mesh.triangles.size(), kWords + 4 * kLongestPoint, [&](char* p, std::size_t i) {
    const auto& [a, b, c] = mesh.triangles[i];
    p = put_text(p, "facet normal ");
    p = put_normal(p, unit_normal(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]), '\n');
    p = put_text(p, "outer loop\n");
    for (const std::uint32_t v : mesh.triangles[i]) p = put_point(put_text(p, "vertex "), mesh.vertices[v], '\n');
    return put_text(p, "endloop\nendfacet\n");
  });
  file.write("endsolid gaussmesh\n");
}

}  // namespace gaussmesh

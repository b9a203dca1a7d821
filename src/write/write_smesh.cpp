// TetGen .smesh: nodes, facets, a point in each hole, a point in each region.
//
// Si, TetGen user's manual, section 5.2.3. Facet markers are the components from 1, which is also the attribute of
// the tetrahedra inside an outside. Cavities are holes: no tetrahedra are made in them. Numbers count from 0.

#include "gaussmesh/error.h"
#include "write/mesh_writer.h"
#include "write/region_points.h"

namespace gaussmesh {
namespace {

enum class Section { kHoles, kRegions };

/// Numbered lines `i x y z` of cavities or solids and, for regions, the attribute.
std::string point_lines(const std::vector<RegionPoint>& points, const MeshCheck& check, Section section) {
  std::string lines;
  std::size_t count = 0;
  for (const RegionPoint& region : points) {
    const bool is_cavity = check.components[region.component].is_cavity();
    if (is_cavity != (section == Section::kHoles)) continue;
    char text[kLongestPoint];
    char* const end = put_point(text, region.point, ' ');
    lines += std::to_string(count++) + " " + std::string(text, end);
    if (section == Section::kRegions) lines += std::to_string(region.component + 1) + " ";
    lines.back() = '\n';
  }
  return std::to_string(count) + "\n" + lines;
}

}  // namespace

void write_smesh(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  const MeshCheck check = check_mesh(mesh);
  if (!check.fit_for_solver()) {
    throw InputError(
        "format 'smesh': expected a closed, embedded mesh turned outwards, got one with defects; `gaussmesh "
        "check` names them");
  }
  const std::vector<RegionPoint> points = find_region_points(mesh, check);
  file.write(std::to_string(mesh.vertices.size()) + " 3 0 0\n");
  write_records(file, mesh.vertices.size(), kLongestIndex + kLongestPoint, [&](char* p, std::size_t i) {
    p = put_integer(p, i);
    *p++ = ' ';
    return put_point(p, mesh.vertices[i], '\n');
  });
  file.write(std::to_string(mesh.triangles.size()) + " 1\n");
  write_records(file, mesh.triangles.size(), 2 + 4 * kLongestIndex, [&](char* p, std::size_t i) {
    p = put_triangle(put_text(p, "3 "), mesh.triangles[i], 0, ' ');
    p = put_integer(p, std::uint64_t{check.component_of[i]} + 1);
    *p++ = '\n';
    return p;
  });
  file.write(point_lines(points, check, Section::kHoles));
  file.write(point_lines(points, check, Section::kRegions));
}

}  // namespace gaussmesh

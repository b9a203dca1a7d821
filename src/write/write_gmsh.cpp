// Gmsh .msh in ASCII, versions 2.2 and 4.1: each component is a surface with its own tag; vertex data are views.
//
// https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format and, for 2.2, #MSH-file-format-version-2-_0028Legacy_0029

#include <algorithm>
#include <array>
#include <map>

#include "write/mesh_writer.h"

namespace gaussmesh {
namespace {

constexpr std::string_view kTriangle = "2";  // Gmsh's number for the element type

/// One view: `components` numbers at each vertex, which put(p, i) writes.
template <class Put>
void write_node_data(const MeshView& view, WholeFile& file, const char* name, int components, const Put& put) {
  const std::size_t count = view.mesh.vertices.size();
  file.write(std::string("$NodeData\n1\n\"") + name + "\"\n1\n0.0\n3\n0\n" + std::to_string(components) + "\n" +
             std::to_string(count) + "\n");
  write_records(file, count, kLongestIndex + kLongestPoint, [&](char* p, std::size_t i) {
    p = put_integer(p, i + 1);
    *p++ = ' ';
    return put(p, i);
  });
  file.write("$EndNodeData\n");
}

void write_numbers(const MeshView& view, WholeFile& file, const char* name, const std::vector<std::uint32_t>& numbers) {
  if (numbers.empty()) return;
  write_node_data(view, file, name, 1, [&](char* p, std::size_t i) {
    p = put_integer(p, numbers[i]);
    *p++ = '\n';
    return p;
  });
}

void write_vertex_data(const MeshView& view, WholeFile& file) {
  const VertexData& data = view.data;
  if (!data.normals.empty()) {
    write_node_data(view, file, "normal", 3,
                    [&](char* p, std::size_t i) { return put_normal(p, data.normals[i], '\n'); });
  }
  write_numbers(view, file, "atom", data.atoms);
  write_numbers(view, file, "component", data.components);
}

/// What belongs to one component, as Gmsh's version 4 wants it.
struct Entity {
  std::uint64_t tag = 0;
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> triangles;
};

/// The components that have vertices, in the order of their tags but for the one of those without.
std::vector<Entity> find_entities(const MeshView& view) {
  std::map<std::uint64_t, Entity> by_tag;
  for (std::uint32_t v = 0; v < view.mesh.vertices.size(); ++v) by_tag[view.tag(v)].vertices.push_back(v);
  for (std::uint32_t t = 0; t < view.mesh.triangles.size(); ++t)
    by_tag[view.tag(view.mesh.triangles[t])].triangles.push_back(t);
  std::vector<Entity> entities;
  for (auto& [tag, entity] : by_tag) {
    entity.tag = tag > 0 ? tag : by_tag.rbegin()->first + 1;  // Gmsh has no tag 0
    entities.push_back(std::move(entity));
  }
  return entities;
}

std::string entity_line(const TriangleMesh& mesh, const Entity& entity) {
  Point low = mesh.vertices[entity.vertices.front()], high = low;
  for (const std::uint32_t v : entity.vertices) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], mesh.vertices[v][k]);
      high[k] = std::max(high[k], mesh.vertices[v][k]);
    }
  }
  char box[2 * kLongestPoint];
  char* const end = put_point(put_point(box, low, ' '), high, ' ');
  const std::string tag = std::to_string(entity.tag);
  return tag + " " + std::string(box, end) + "1 " + tag + " 0\n";
}

/// The line at the head of a section: blocks, things, smallest and largest tag.
std::string section(const char* name, std::size_t blocks, std::size_t count) {
  return std::string("$") + name + "\n" + std::to_string(blocks) + " " + std::to_string(count) + " " +
         (count > 0 ? "1 " : "0 ") + std::to_string(count) + "\n";
}

}  // namespace

void write_gmsh_22(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(mesh.vertices.size()) + "\n");
  write_records(file, mesh.vertices.size(), kLongestIndex + kLongestPoint, [&](char* p, std::size_t i) {
    p = put_integer(p, i + 1);
    *p++ = ' ';
    return put_point(p, mesh.vertices[i], '\n');
  });
  file.write("$EndNodes\n$Elements\n" + std::to_string(mesh.triangles.size()) + "\n");
  write_records(file, mesh.triangles.size(), 6 * kLongestIndex + 6, [&](char* p, std::size_t i) {
    const std::uint32_t tag = view.tag(mesh.triangles[i]);
    p = put_integer(p, i + 1);
    *p++ = ' ';
    p = put_text(put_text(p, kTriangle), " 2 ");
    p = put_row(p, std::array{tag, tag}, ' ', ' ', put_integer);
    return put_triangle(p, mesh.triangles[i], 1, '\n');
  });
  file.write("$EndElements\n");
  write_vertex_data(view, file);
}

void write_gmsh_41(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  const std::vector<Entity> entities = find_entities(view);
  file.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 " + std::to_string(entities.size()) + " 0\n");
  for (const Entity& entity : entities) file.write(entity_line(mesh, entity));
  file.write("$EndEntities\n" + section("Nodes", entities.size(), mesh.vertices.size()));
  for (const Entity& entity : entities) {
    const std::vector<std::uint32_t>& numbers = entity.vertices;
    file.write("2 " + std::to_string(entity.tag) + " 0 " + std::to_string(numbers.size()) + "\n");
    write_records(file, numbers.size(), kLongestIndex, [&](char* p, std::size_t i) {
      p = put_integer(p, std::uint64_t{numbers[i]} + 1);
      *p++ = '\n';
      return p;
    });
    write_records(file, numbers.size(), kLongestPoint,
                  [&](char* p, std::size_t i) { return put_point(p, mesh.vertices[numbers[i]], '\n'); });
  }
  const auto has_triangles = [](const Entity& entity) { return !entity.triangles.empty(); };
  const auto blocks = static_cast<std::size_t>(std::count_if(entities.begin(), entities.end(), has_triangles));
  file.write("$EndNodes\n" + section("Elements", blocks, mesh.triangles.size()));
  for (const Entity& entity : entities) {
    const std::vector<std::uint32_t>& numbers = entity.triangles;
    if (numbers.empty()) continue;
    file.write("2 " + std::to_string(entity.tag) + " " + std::string(kTriangle) + " " + std::to_string(numbers.size()) +
               "\n");
    write_records(file, numbers.size(), 4 * kLongestIndex, [&](char* p, std::size_t i) {
      p = put_integer(p, std::uint64_t{numbers[i]} + 1);
      *p++ = ' ';
      return put_triangle(p, mesh.triangles[numbers[i]], 1, '\n');
    });
  }
  file.write("$EndElements\n");
  write_vertex_data(view, file);
}

}  // namespace gaussmesh

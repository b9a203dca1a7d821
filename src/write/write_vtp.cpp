// VTK PolyData (ParaView): XML, with the arrays appended as they are in memory.
//
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html

#include <bit>

#include "write/mesh_writer.h"

namespace gaussmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "VTP is written as it is in memory");

using Size = std::uint64_t;      // in front of each array, as header_type says
using CellIndex = std::int64_t;  // what VTK has in memory

/// Lists the arrays in the XML, and knows where each begins.
class ArrayList {
 public:
  std::string element(const char* type, const char* name, int components, Size bytes) {
    const std::string text = std::string("<DataArray type=\"") + type + "\" Name=\"" + name +
                             "\" NumberOfComponents=\"" + std::to_string(components) +
                             "\" format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
    offset_ += sizeof(Size) + bytes;
    return text;
  }

 private:
  Size offset_ = 0;
};

std::string xml(const TriangleMesh& mesh, const VertexData& data) {
  const Size vertices = mesh.vertices.size(), triangles = mesh.triangles.size();
  ArrayList arrays;
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(vertices) + "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
      std::to_string(triangles) + "\">\n<Points>\n";
  text += arrays.element("Float64", "position", 3, vertices * sizeof(Point));
  text += "</Points>\n<PointData";
  if (!data.normals.empty()) text += " Normals=\"normal\"";
  text += ">\n";
  if (!data.normals.empty()) text += arrays.element("Float32", "normal", 3, vertices * sizeof(Normal));
  if (!data.atoms.empty()) text += arrays.element("UInt32", "atom", 1, vertices * sizeof(std::uint32_t));
  if (!data.components.empty()) text += arrays.element("UInt32", "component", 1, vertices * sizeof(std::uint32_t));
  text += "</PointData>\n<Polys>\n";
  text += arrays.element("Int64", "connectivity", 1, 3 * triangles * sizeof(CellIndex));
  text += arrays.element("Int64", "offsets", 1, triangles * sizeof(CellIndex));
  return text + "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
}

void write_size(WholeFile& file, Size bytes) {
  char text[sizeof bytes];
  put_bytes(text, bytes);
  file.write({text, sizeof text});
}

template <class Number>
void write_array(WholeFile& file, const std::vector<Number>& numbers) {
  write_size(file, numbers.size() * sizeof(Number));
  file.write({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

}  // namespace

void write_vtp(const MeshView& view, WholeFile& file) {
  const TriangleMesh& mesh = view.mesh;
  const VertexData& data = view.data;
  file.write(xml(mesh, data));
  write_array(file, mesh.vertices);
  if (!data.normals.empty()) write_array(file, data.normals);
  if (!data.atoms.empty()) write_array(file, data.atoms);
  if (!data.components.empty()) write_array(file, data.components);
  write_size(file, 3 * mesh.triangles.size() * sizeof(CellIndex));
  write_records(file, mesh.triangles.size(), 3 * sizeof(CellIndex), [&](char* p, std::size_t i) {
    for (const std::uint32_t v : mesh.triangles[i]) p = put_bytes(p, CellIndex{v});
    return p;
  });
  write_size(file, mesh.triangles.size() * sizeof(CellIndex));
  write_records(file, mesh.triangles.size(), sizeof(CellIndex),
                [](char* p, std::size_t i) { return put_bytes(p, static_cast<CellIndex>(3 * (i + 1))); });
  file.write("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace gaussmesh

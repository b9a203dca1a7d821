#include <zlib.h>

#include <algorithm>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_mesh.h"
#include "gaussmesh/write_mesh.h"
#include "support/folder.h"
#include "unit/verify/shapes.h"

using namespace gaussmesh;
using namespace std::string_literals;
using Catch::Matchers::ContainsSubstring;

namespace {

std::string array(const std::string& attributes, const std::string& text) {
  return "<DataArray " + attributes + ">\n  " + text + "\n</DataArray>\n";
}

/// A triangle by itself, in text.
std::string piece(const std::string& shift, const std::string& corners = "0 1 2") {
  return "<Piece NumberOfPoints=\"3\" NumberOfVerts='0' NumberOfPolys=\"1\">\n<PointData Normals=\"up\">\n" +
         array("type=\"Float32\" Name=\"up\" NumberOfComponents=\"3\" format=\"ascii\"", "0 0 2\n0 0 1\n 0 0 1") +
         array("type=\"Int64\" Name=\"atom\" format=\"ascii\"", "7 8 9") +
         array("type=\"Float32\" Name=\"component\" format=\"ascii\"", "0.5 0 0") + "</PointData>\n<Points>\n" +
         array("type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\"", "0 0 " + shift + " 1 0 0 0 1 0") +
         "</Points>\n<!-- <Polys> -->\n<Polys>\n" +
         array("type=\"Int32\" Name=\"connectivity\" format=\"ascii\"", corners) +
         array("type=\"Int32\" Name=\"offsets\" format=\"ascii\"", "3") + "</Polys>\n</Piece>\n";
}

std::string file(const std::string& pieces,
                 const std::string& attributes = "type=\"PolyData\" byte_order=\"BigEndian\"") {
  return "<?xml version=\"1.0\"?>\n<VTKFile " + attributes + ">\n<PolyData>\n" + pieces + "</PolyData>\n</VTKFile>\n";
}

std::string message(const std::string& bytes) {
  try {
    parse_mesh(bytes, "a.vtp");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("VTP in text and in several pieces") {
  const MeshFile got = parse_mesh(file(piece("0.1") + piece("-3")), "a");
  CHECK(got.mesh.vertices == std::vector<Point>{{0, 0, 0.1}, {1, 0, 0}, {0, 1, 0}, {0, 0, -3}, {1, 0, 0}, {0, 1, 0}});
  CHECK(got.mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}});
  CHECK(got.data.normals == std::vector<Normal>(6, Normal{0, 0, 1}));
  CHECK(got.data.atoms == std::vector<std::uint32_t>{7, 8, 9, 7, 8, 9});
  CHECK(got.data.components.empty());  // no whole numbers
}

TEST_CASE("VTP that is none names the line") {
  const std::string good = file(piece("0"));
  CHECK(message(good) == "no error");
  CHECK_THAT(message("<?xml version=\"1.0\"?>\n<html>\n</html>\n"), ContainsSubstring("a.vtp:1: expected VTK's XML"));
  CHECK_THAT(message(file("", "type=\"UnstructuredGrid\"")),
             ContainsSubstring("a.vtp:2: expected a VTKFile of the type PolyData, got 'UnstructuredGrid'"));
  CHECK_THAT(message(file("", "type=\"PolyData\" byte_order=\"LittleEndian\" compressor=\"vtkLZ4DataCompressor\"")),
             ContainsSubstring("a.vtp:2: expected vtkZLibDataCompressor, or none, got 'vtkLZ4DataCompressor'"));
  CHECK_THAT(message(replaced(good, "  3\n", "  4\n")), ContainsSubstring("offsets 3, 6, 9, ..., got '4'"));
  CHECK_THAT(message(file(piece("0", "0 1"))), ContainsSubstring("expected 3 numbers in Polys/connectivity, got '2'"));
  CHECK_THAT(message(file(piece("0") + piece("0", "0 1 3"))), ContainsSubstring("expected numbers of points"));
  CHECK_THAT(message(file(piece("0", "0 1 -1e-9"))), ContainsSubstring("expected numbers of points, got '-1e-09'"));
  CHECK_THAT(message(file(piece("1e999"))), ContainsSubstring("a.vtp:19: expected an array of numbers, got '1e999'"));
  CHECK_THAT(message(replaced(good, "'0'", "'0' NumberOfStrips=\"2\"")), ContainsSubstring("got '2 strips'"));
  CHECK_THAT(message(replaced(good, "</Points>", "</Point>")), ContainsSubstring("expected the end of the element"));
  CHECK_THAT(message(replaced(good, "\"Float64\"", "\"String\"")), ContainsSubstring("expected a type of numbers"));
  // A corner that is not there is for check_mesh(), as in all formats.
  CHECK(parse_mesh(file(piece("0", "0 1 3")), "a").mesh.triangles[0][2] == 3);
}

TEST_CASE("VTP that is cut off, or has other bytes, is an error or a mesh") {
  const testing::Folder folder;
  const TriangleMesh sphere = shapes::icosphere(1, 1.0);
  write_mesh(sphere, {average_normals(sphere), {}, {}}, folder / "m.vtp");
  const std::string bytes = testing::read_file(folder / "m.vtp");
  CHECK(parse_mesh(bytes, "a").mesh.vertices == sphere.vertices);
  const std::string data_end = bytes.substr(0, bytes.rfind("\n</AppendedData>"));
  for (std::size_t size = 1; size < data_end.size(); size += 1 + size / 100) {
    CAPTURE(size);
    CHECK_THROWS_AS(parse_mesh(bytes.substr(0, size), "a.vtp"), InputError);
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string other = bytes;
    other[at] = static_cast<char>(other[at] + 1 + at % 7);
    CAPTURE(at);
    CHECK_NOTHROW(message(other));
  }
}

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_mesh.h"

using namespace gaussmesh;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string kTetrahedron = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1.5\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

void check_tetrahedron(const std::string& text) {
  const TriangleMesh mesh = parse_mesh(text, "t.off").mesh;
  CHECK(mesh.vertices == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.5}});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

std::string with(const std::string& text, const std::string& from, const std::string& to) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    if (text.compare(at, from.size(), from) == 0) {
      result += to;
      at += from.size();
    } else {
      result += text[at++];
    }
  }
  return result;
}

std::string message_of(const std::string& text) {
  try {
    parse_mesh(text, "m.off");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("OFF as it is written by different programs") {
  check_tetrahedron(kTetrahedron);
  check_tetrahedron(with(kTetrahedron, "\n", "\r\n"));
  check_tetrahedron(with(kTetrahedron, "\n", "\n\n  # made by hand\n"));
  check_tetrahedron(with(kTetrahedron, "OFF\n4", "OFF 4"));
  check_tetrahedron(with(kTetrahedron, "4 4 6", " 4\t4"));
  check_tetrahedron(with(kTetrahedron, " 2 3\n", " 2 3  0.5 0.5 0.5 1 # red\n"));
  check_tetrahedron(with(kTetrahedron, "1.5", "+15e-1"));
  check_tetrahedron(kTetrahedron.substr(0, kTetrahedron.size() - 1));
  check_tetrahedron("# a comment\n\n" + kTetrahedron + "\n# the end\n\n");
  CHECK(parse_mesh("OFF\n0 0 0\n", "e.off").mesh.triangles.empty());
}

TEST_CASE("what else vertices have is passed over, but for normals") {
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  const auto mesh = [&](const std::string& header, const std::string& behind) {
    std::string text = header + "\n4 4 6\n";
    for (const char* point : {"0 0 0", "1 0 0", "0 1 0", "0 0 1.5"}) text += point + behind + "\n";
    return text + faces;
  };
  for (const char* header : {"OFF", "COFF", "STCOFF", "NCOFF"}) {
    for (const char* colour : {" 255 0 0", " 0.1 0.2 0.3 1", " 0 0 1 255 0 0 255 0.5 0.5"}) {
      check_tetrahedron(mesh(header, colour));
      CHECK(parse_mesh(mesh(header, colour), "t.off").data.normals.empty());
    }
  }
  check_tetrahedron(mesh("STOFF", " 0.5 0.25"));
  check_tetrahedron(mesh("COFF", " 7"));
  for (const auto& [header, behind] : {std::pair{"NOFF", " 0 3 4"},
                                       {"CNOFF", " 0 3 4 255 0 0 255"},
                                       {"STNOFF", " 0 3 4 1 1"},
                                       {"STCNOFF", " 0 3 4 255 0 0 255 0.5 0.5"}}) {
    check_tetrahedron(mesh(header, behind));
    CHECK(parse_mesh(mesh(header, behind), "t.off").data.normals == std::vector<Normal>(4, {0.0f, 0.6f, 0.8f}));
  }
  CHECK(message_of(mesh("NOFF", " 0 1")) ==
        "m.off:3: expected vertex 1 of 4: three finite coordinates and a normal, got '0 0 0 0 1'");
  CHECK(message_of(mesh("COFF", " red")) ==
        "m.off:3: expected vertex 1 of 4: three finite coordinates, got '0 0 0 red'");
  CHECK(message_of(mesh("OFF", " 1")) == "m.off:3: expected vertex 1 of 4: three finite coordinates, got '0 0 0 1'");
  for (const std::string header : {"4OFF", "nOFF", "C4OFF", "4nOFF"})
    CHECK(message_of(mesh(header, " 1")) ==
          "m.off:1: expected 'OFF' with three coordinates at each vertex, got '" + header + "'");
  CHECK(message_of(mesh("XOFF", "")) ==
        "m.off:1: expected the header 'OFF', perhaps with ST, C or N in front of it, got 'XOFF'");
  CHECK(message_of(std::string("OFF BINARY\n\0\0\0\4", 15)) ==
        "m.off:1: expected OFF in ASCII, got 'OFF BINARY'; the file is binary, save it as ASCII");
}

TEST_CASE("numbers keep all their digits") {
  const TriangleMesh mesh = parse_mesh("OFF 1 0 0\n-0.1 1e-300 12345678.123456789\n", "n.off").mesh;
  CHECK(mesh.vertices.at(0) == Point{-0.1, 1e-300, 12345678.123456789});
}

TEST_CASE("a vertex number that is too large is for the check to count") {
  CHECK(parse_mesh("OFF 1 1 0\n0 0 0\n3 0 0 7\n", "n.off").mesh.triangles.at(0) == Triangle{0, 0, 7});
}

TEST_CASE("what is wrong is named with its line") {
  CHECK(message_of("") == "m.off: expected a mesh, got nothing: the file is empty");
  CHECK(message_of("\n \t\r\n") == "m.off: expected a mesh, got nothing: the file is empty");
  CHECK(message_of("# OFF\n") == "m.off:1: expected the header 'OFF', got 'end of file'");
  CHECK(message_of("\n\nPLY\n") == "m.off:3: expected the header 'OFF', got 'PLY'");
  CHECK(message_of("OFFSET 1 1 1\n") == "m.off:1: expected the header 'OFF', got 'OFFSET 1 1 1'");
  const std::string counts = "expected the numbers of vertices, faces and edges, got '";
  CHECK(message_of("OFF\n") == "m.off:1: " + counts + "end of file'");
  CHECK(message_of("OFF\n4\n") == "m.off:2: " + counts + "4'");
  CHECK(message_of("OFF\n4 -1 0\n") == "m.off:2: " + counts + "4 -1 0'");
  CHECK(message_of("OFF 4 4 6 1\n") == "m.off:1: " + counts + "OFF 4 4 6 1'");
  CHECK(message_of("OFF 4 4 x\n") == "m.off:1: " + counts + "OFF 4 4 x'");
  const std::string vertex = "vertex 1 of 2: three finite coordinates, got '";
  for (const char* line : {"0 0", "0 0 zero", "0 0 nan", "0 0 inf", "0 1e999 0", "0 0 0 0", "0 0 1.5x", "0,0,0"})
    CHECK(message_of("OFF 2 0 0\n" + std::string(line) + "\n") == "m.off:2: expected " + vertex + line + "'");
  const std::string face = "face 2 of 2: a triangle, '3' and three vertex numbers, got '";
  for (const char* line : {"4 0 1 2 3", "3 0 1", "2 0 1", "3 0 1 -2", "3 0 1 4294967296", "3 0 1 2.5", "x"})
    CHECK(message_of("OFF 1 2 0\n0 0 0\n3 0 0 0\n" + std::string(line) + "\n") ==
          "m.off:4: expected " + face + line + "'");
}

TEST_CASE("counts that the file does not keep") {
  CHECK(message_of(with(kTetrahedron, "4 4 6", "5 4 6")) ==
        "m.off:7: expected vertex 5 of 5: three finite coordinates, got '3 0 2 1'");
  CHECK(message_of(with(kTetrahedron, "4 4 6", "4 5 6")) ==
        "m.off:10: expected face 5 of 5: a triangle, '3' and three vertex numbers, got 'end of file'");
  CHECK(message_of(with(kTetrahedron, "4 4 6", "4 3 6")) == "m.off:10: expected nothing after 3 faces, got '3 2 0 3'");
  // Announced, but believed only as far as there are bytes: else this would need 24 EB.
  CHECK_THAT(message_of("OFF 999999999999999999 999999999999999999 0\n0 0 0\n"), ContainsSubstring("m.off:2: "));
  CHECK_THAT(message_of("OFF 99999999999999999999 1 0\n"), ContainsSubstring("m.off:1: "));
}

TEST_CASE("messages stay short and printable") {
  const std::string message = message_of("OFF " + std::string(5000, 'x') + "\n");
  CHECK(message.size() < 200);
  CHECK(message_of("O\x1b[2JF\n") == "m.off:1: expected the header 'OFF', got 'O\\x1b[2JF'");
  CHECK_THAT(message_of(std::string("O\0F\n", 4)), ContainsSubstring("m.off:1: ") && ContainsSubstring("NUL"));
}

TEST_CASE("files") {
  const auto folder = std::filesystem::temp_directory_path() / "gaussmesh_parse_off_test";
  std::filesystem::create_directories(folder);
  const auto path = folder / "t.off";
  std::ofstream(path) << kTetrahedron;
  CHECK(read_mesh(path).mesh.triangles.size() == 4);
  CHECK_THROWS_WITH(read_mesh(folder), ContainsSubstring("Is a directory"));
  CHECK_THROWS_WITH(read_mesh(folder / "none.off"), ContainsSubstring("none.off: expected"));
  CHECK_THROWS_AS(read_mesh(folder / "none.off"), InputError);
  std::ofstream(path) << "";
  CHECK_THROWS_WITH(read_mesh(path), ContainsSubstring("t.off: expected a mesh, got nothing: the file is empty"));
  std::filesystem::remove_all(folder);
}

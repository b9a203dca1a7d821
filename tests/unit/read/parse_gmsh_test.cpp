// Gmsh's .msh, in text and as bytes: what is kept, what is passed over, and what is refused where.

#include <algorithm>
#include <cmath>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_mesh.h"

using namespace gaussmesh;
using namespace std::string_literals;
using Catch::Matchers::ContainsSubstring;

namespace {

/// The message of the InputError that reading must end in.
std::string message(std::string_view bytes) {
  try {
    parse_mesh(bytes, "a.msh");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// The bytes of numbers, each of the type that it is given as.
template <class... Numbers>
std::string bytes_of(Numbers... numbers) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  return bytes;
}

using I = std::int32_t;
using S = std::uint64_t;

const std::vector<Point> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> kHalves = {{0, 1, 2}, {0, 2, 3}};

/// Version 2.2, the corners of kSquare with tags 10, 20, 30, 40 and those elements.
std::string text_22(const std::string& elements) {
  const auto count = std::count(elements.begin(), elements.end(), '\n');
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"skin\"\n$EndPhysicalNames\n"
         "$Nodes\n4\n10 0 0 0\n20 1 0 0\n30 1 1 0\n40 0 1 0\n$EndNodes\n$Elements\n" +
         std::to_string(count) + "\n" + elements + "$EndElements\n";
}

/// The same in version 4.1; the elements are blocks.
std::string text_41(int blocks, const std::string& elements) {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 10 40\n2 1 1 4\n10\n20\n30\n40\n"
         "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n$EndNodes\n$Elements\n" +
         std::to_string(blocks) + " 9 1 9\n" + elements + "$EndElements\n";
}

std::string binary_22(int count, const std::string& elements) {
  return "$MeshFormat\n2.2 1 8\n" + bytes_of(I{1}) + "\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"skin\"\n" +
         "$EndPhysicalNames\n$Nodes\n4\n" + bytes_of(I{10}, 0.0, 0.0, 0.0, I{20}, 1.0, 0.0, 0.0) +
         bytes_of(I{30}, 1.0, 1.0, 0.0, I{40}, 0.0, 1.0, 0.0) + "\n$EndNodes\n$Elements\n" + std::to_string(count) +
         "\n" + elements + "\n$EndElements\n";
}

/// The nodes lie on a surface with parameters, which stand behind the coordinates.
std::string binary_41(S blocks, const std::string& elements) {
  return "$MeshFormat\n4.1 1 8\n" + bytes_of(I{1}) + "\n$EndMeshFormat\n$Entities\n" + bytes_of(S{0}, S{0}) +
         "$Nodes\n" + bytes_of(I{7}) + "\n$EndEntities\n$Nodes\n" + bytes_of(S{1}, S{4}, S{10}, S{40}) +
         bytes_of(I{2}, I{-1}, I{1}, S{4}, S{10}, S{20}, S{30}, S{40}) +
         bytes_of(0.0, 0.0, 0.0, 5.0, 6.0, 1.0, 0.0, 0.0, 5.0, 6.0) +
         bytes_of(1.0, 1.0, 0.0, 5.0, 6.0, 0.0, 1.0, 0.0, 5.0, 6.0) + "\n$EndNodes\n$Elements\n" +
         bytes_of(blocks, S{9}, S{1}, S{9}) + elements + "\n$EndElements\n";
}

const std::string kHalves22 =
    bytes_of(I{2}, I{2}, I{2}, I{7}, I{1}, I{1}, I{10}, I{20}, I{30}) + bytes_of(I{8}, I{1}, I{1}, I{10}, I{30}, I{40});
const std::string kHalves41 = bytes_of(I{2}, I{1}, I{2}, S{2}, S{7}, S{10}, S{20}, S{30}, S{8}, S{10}, S{30}, S{40});

}  // namespace

TEST_CASE("both versions and encodings of Gmsh hold the same mesh") {
  const std::string file = GENERATE(
      text_22("7 2 2 1 1 10 20 30\n8 2 2 1 1 10 30 40\n"), text_41(1, "2 1 2 2\n7 10 20 30\n8 10 30 40\n"),
      binary_22(2, kHalves22), binary_41(1, kHalves41), "$Comments\nby hand\n$EndComments\n" + binary_22(2, kHalves22));
  CAPTURE(file);
  const TriangleMesh mesh = parse_mesh(file, "a.msh").mesh;
  CHECK(mesh.vertices == kSquare);
  CHECK(mesh.triangles == kHalves);
}

TEST_CASE("points, lines and solids of Gmsh are passed over, and nodes of theirs alone left out") {
  const std::string tetrahedron_22 = bytes_of(I{4}, I{1}, I{0}, I{1}, I{10}, I{20}, I{30}, I{40});
  const std::string tetrahedron_41 = bytes_of(I{3}, I{1}, I{4}, S{1}, S{1}, S{10}, S{20}, S{30}, S{40});
  const std::string half_22 = bytes_of(I{2}, I{1}, I{1}, I{7}, I{1}, I{10}, I{20}, I{30});
  const std::string half_41 = bytes_of(I{2}, I{1}, I{2}, S{1}, S{7}, S{10}, S{20}, S{30});
  const std::string file =
      GENERATE_COPY(text_22("1 15 2 0 1 10\n2 1 2 0 1 10 40\n3 4 2 0 1 10 20 30 40\n4 2 2 0 1 10 20 30\n"),
                    text_41(3, "0 1 15 1\n1 10\n3 1 4 1\n2 10 20 30 40\n2 1 2 1\n4 10 20 30\n"),
                    binary_22(2, tetrahedron_22 + half_22), binary_41(2, tetrahedron_41 + half_41));
  CAPTURE(file);
  const TriangleMesh mesh = parse_mesh(file, "a.msh").mesh;
  CHECK(mesh.vertices == std::vector<Point>(kSquare.begin(), kSquare.begin() + 3));
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("parts of the surface that are no triangles of 3 nodes are refused") {
  const std::string quadrangle =
      "expected a triangle of 3 nodes, type 2, got a quadrangle of 4, type 3; mesh the surface with triangles of first "
      "order";
  CHECK(message(text_22("1 2 0 10 20 30\n2 3 0 10 20 30 40\n")) == "a.msh:18: " + quadrangle);
  CHECK(message(text_41(2, "2 1 2 1\n1 10 20 30\n2 1 3 1\n2 10 20 30 40\n")) == "a.msh:21: " + quadrangle);
  const std::string block_22 = bytes_of(I{3}, I{1}, I{0}, I{2}, I{10}, I{20}, I{30}, I{40});
  const std::string block_41 = bytes_of(I{2}, I{1}, I{3}, S{1}, S{2}, S{10}, S{20}, S{30}, S{40});
  const std::string file_22 = binary_22(1, block_22), file_41 = binary_41(1, block_41);
  const auto at = [](const std::string& file, const std::string& block, std::size_t head) {
    return "a.msh: byte " + std::to_string(file.find(block) + head) + ": ";
  };
  CHECK(message(file_22) == at(file_22, block_22, 12) + quadrangle);
  CHECK(message(file_41) == at(file_41, block_41, 20) + quadrangle);
  CHECK_THAT(message(text_41(1, "2 1 9 1\n1 10 20 30 10 20 30\n")),
             ContainsSubstring("a.msh:19: expected a triangle of 3 nodes, type 2, got a triangle of 6, type 9"));
  CHECK(message(text_22("1 69 0 10 20 30\n")) ==
        "a.msh:17: expected an element of type 1 to 31, 92 or 93, got type 69");
}

TEST_CASE("a Gmsh file of solids alone has no surface") {
  CHECK(message(text_22("1 4 0 10 20 30 40\n")) ==
        "a.msh: expected triangles, got points, lines or solids alone; save the surface too");
  CHECK(parse_mesh(text_22(""), "a.msh").mesh.triangles.empty());
}

TEST_CASE("Gmsh files that are none name the line") {
  CHECK_THAT(message(text_22("1 2 2 0 1 10 20 21\n")), ContainsSubstring("a.msh:17: expected an element"));
  CHECK_THAT(message(text_22("1 2 9 0 1 10 20 30\n")), ContainsSubstring("a.msh:17: expected an element"));
  CHECK_THAT(message("$MeshFormat\n4.0 0 8\n"), ContainsSubstring("a.msh:2: expected version 2.2 or 4.1"));
  CHECK(message("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n") ==
        "a.msh:3: expected the sections $Nodes and $Elements, got 'end of file'");
  CHECK(message("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n2 0 0 0\n$EndNodes\n") ==
        "a.msh:7: expected '$EndNodes', got '2 0 0 0'");
  CHECK(message("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n1 0 0 0\n$EndNodes\n") ==
        "a.msh:7: expected a node tag that is not there yet, got '1'");
}

TEST_CASE("binary Gmsh files that are none name the byte") {
  CHECK(message("$MeshFormat\n2.2 1 8\n\0\0\0\1\n$EndMeshFormat\n"s) ==
        "a.msh: byte 12: expected the number 1, least significant byte first, got the most significant one first; save "
        "the file as ASCII");
  CHECK_THAT(message("$MeshFormat\n2.2 1 8\n\2\0\0\0\n$EndMeshFormat\n"s), ContainsSubstring("first, got 2"));
  CHECK_THAT(message("$MeshFormat\n4.1 1 4\n\1\0\0\0\n"s), ContainsSubstring("a.msh: byte 12: expected version 2.2"));
  CHECK_THAT(message("$MeshFormat\n4.0 1 8\n\1\0\0\0\n"s), ContainsSubstring("a.msh: byte 12: expected version 2.2"));
  const auto element = [](auto... numbers) { return message(binary_22(1, bytes_of(I{numbers}...))); };
  CHECK_THAT(element(2, 1, 0, 7, 10, 20, 21), ContainsSubstring("that are there, got node '21'"));
  CHECK_THAT(element(2, 1, 0, 7, 10, 20, -30), ContainsSubstring("that are there, got -30"));
  CHECK_THAT(element(2, 2, 0, 7, 10, 20, 30), ContainsSubstring("expected 1 to 1 elements, got '2'"));
  CHECK_THAT(element(2, 0, 0), ContainsSubstring("expected 1 to 1 elements, got '0'"));
  CHECK_THAT(element(2, 1, 0x7fffffff, 7, 10, 20, 30), ContainsSubstring("a.msh: expected more data"));
  CHECK_THAT(element(2, 1, 0, 7, 10, 20, 30, 40), ContainsSubstring("expected '$EndElements', got '(\\x00"));
  CHECK_THAT(
      message("$MeshFormat\n2.2 1 8\n\1\0\0\0\n$EndMeshFormat\n$Nodes\n1\n"s + bytes_of(I{1}, 0.0, HUGE_VAL, 0.0)),
      ContainsSubstring("a.msh: byte 49: expected a node: its tag and three finite coordinates, got inf"));
  CHECK_THAT(message("$MeshFormat\n2.2 1 8\n\1\0\0\0\n$EndMeshFormat\nno section\n"s),
             ContainsSubstring("a.msh: byte 40: expected a section, '$' and its name, got 'no section'"));
  CHECK_THAT(message("$MeshFormat\n2.2 1 8\n\1\0\0\0\n$EndMeshFormat\n$Periodic\n"s),
             ContainsSubstring("a.msh: byte 40: expected '$EndPeriodic', got the end of the file"));
}

TEST_CASE("binary Gmsh files that are cut off are refused wherever it is") {
  for (const std::string& file : {binary_22(2, kHalves22), binary_41(1, kHalves41)}) {
    const std::size_t end = file.size() - 1;  // without the last line end it is whole
    for (std::size_t size = 12; size < end; ++size) {
      CAPTURE(size);
      CHECK(message(file.substr(0, size)).starts_with("a.msh:"));
    }
  }
}

TEST_CASE("what binary Gmsh files announce is believed as far as they are long") {
  const std::string head = "$MeshFormat\n4.1 1 8\n"s + bytes_of(I{1}) + "\n$EndMeshFormat\n$Nodes\n";
  constexpr S kMost = 0xFFFFFFFFFFFFFFFF;
  for (const std::string& nodes :
       {bytes_of(kMost, kMost, S{1}, kMost), bytes_of(S{1}, S{4}, S{1}, S{4}, I{2}, I{1}, I{1}, kMost, S{1}),
        bytes_of(S{1}, S{1}, S{1}, S{1}, I{0x7fffffff}, I{1}, I{1}, S{1}, S{1}, 0.0, 0.0, 0.0)}) {
    CHECK_THAT(message(head + nodes), ContainsSubstring("a.msh: expected more data, got the end of the file at byte"));
  }
}

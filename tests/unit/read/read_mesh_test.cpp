#include "gaussmesh/read_mesh.h"

#include <zlib.h>

#include <sstream>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "gaussmesh/select_components.h"
#include "gaussmesh/write_mesh.h"
#include "support/folder.h"
#include "support/random.h"
#include "unit/verify/shapes.h"

using namespace gaussmesh;
using namespace std::string_literals;
using testing::Folder;

namespace {

/// Two components with coordinates of any size, and something known at every vertex.
MeshFile sample() {
  MeshFile file;
  file.mesh = shapes::together(shapes::icosphere(2, 1.0 / 3.0), shapes::moved(shapes::cube(0.1), {1e5, -2e-7, 9}));
  file.data.normals = average_normals(file.mesh);
  file.data.components = find_vertex_components(file.mesh, check_mesh(file.mesh));
  for (std::uint32_t v = 0; v < file.mesh.vertices.size(); ++v) file.data.atoms.push_back(7 * v % 100);
  return file;
}

MeshFile write_and_read(const MeshFile& file, const std::string& format, const std::string& name) {
  const Folder folder;
  write_mesh(file.mesh, file.data, folder / name, {.format = format});
  return read_mesh(folder / name);
}

void check_normals(const std::vector<Normal>& got, const std::vector<Normal>& wanted, float tolerance) {
  REQUIRE(got.size() == wanted.size());
  for (std::size_t v = 0; v < got.size(); ++v)
    for (int k = 0; k < 3; ++k) CHECK(std::abs(got[v][k] - wanted[v][k]) <= tolerance);
}

/// The message of the InputError that reading must end in.
std::string message(std::string_view bytes, std::string_view name) {
  try {
    parse_mesh(bytes, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string big_endian(const std::string& bytes) { return {bytes.rbegin(), bytes.rend()}; }

template <class Number>
std::string bytes_of(Number number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

const TriangleMesh kTetrahedron = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                   {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

}  // namespace

TEST_CASE("every format gives back the same bits") {
  const MeshFile file = sample();
  const std::pair<std::string, std::string> formats[] = {{"off", "m.off"},   {"ply", "m.ply"},    {"ply-ascii", "m"},
                                                         {"obj", "m.obj"},   {"gmsh22", "m.msh"}, {"smesh", "m.smesh"},
                                                         {"msms", "m.vert"}, {"vtp", "m.vtp"}};
  for (const auto& [format, name] : formats) {
    CAPTURE(format);
    const MeshFile back = write_and_read(file, format, name);
    CHECK(back.mesh.vertices == file.mesh.vertices);
    CHECK(back.mesh.triangles == file.mesh.triangles);
  }
}

TEST_CASE("Gmsh 4.1 gives back the same places, by component") {
  const MeshFile file = sample();
  const MeshFile back = write_and_read(file, "gmsh41", "m.msh");
  REQUIRE(back.mesh.triangles.size() == file.mesh.triangles.size());
  std::vector<std::array<Point, 3>> places[2];
  for (const auto& [mesh, list] : {std::pair{&file.mesh, &places[0]}, std::pair{&back.mesh, &places[1]}}) {
    for (const auto& [a, b, c] : mesh->triangles)
      list->push_back({mesh->vertices[a], mesh->vertices[b], mesh->vertices[c]});
    std::sort(list->begin(), list->end());
  }
  CHECK(places[0] == places[1]);
}

TEST_CASE("Gmsh 4.1 takes components of any number") {
  MeshFile file = sample();
  file.data.components.assign(file.mesh.vertices.size(), 4'000'000'000u);
  file.data.components[0] = kNoComponent;
  const MeshFile back = write_and_read(file, "gmsh41", "m.msh");
  CHECK(back.mesh.triangles.size() == file.mesh.triangles.size());
}

TEST_CASE("STL gives back floats, welded where they are equal and only there") {
  const MeshFile file = sample();
  const MeshFile back = write_and_read(file, "stl", "m.stl");
  CHECK(back.mesh.vertices.size() == file.mesh.vertices.size());
  REQUIRE(back.mesh.triangles.size() == file.mesh.triangles.size());
  for (std::size_t t = 0; t < back.mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Point& got = back.mesh.vertices[back.mesh.triangles[t][k]];
      const Point& wanted = file.mesh.vertices[file.mesh.triangles[t][k]];
      for (int axis = 0; axis < 3; ++axis) CHECK(static_cast<float>(got[axis]) == static_cast<float>(wanted[axis]));
    }
  }
  const MeshFile again = write_and_read(back, "stl", "m.stl");
  CHECK(again.mesh.vertices == back.mesh.vertices);
  CHECK(again.mesh.triangles == back.mesh.triangles);
}

TEST_CASE("STL as text gives back the bits") {
  const MeshFile file = sample();
  const MeshFile back = write_and_read(file, "stl-ascii", "m.stl");
  CHECK(back.mesh.vertices.size() == file.mesh.vertices.size());
  REQUIRE(back.mesh.triangles.size() == file.mesh.triangles.size());
  for (std::size_t t = 0; t < back.mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      CHECK(back.mesh.vertices[back.mesh.triangles[t][k]] == file.mesh.vertices[file.mesh.triangles[t][k]]);
  const MeshFile needle = {{{{-1e300, -1e-300, 1.0 / 3}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}};
  CHECK(write_and_read(needle, "stl-ascii", "m.stl").mesh.vertices == needle.mesh.vertices);
}

TEST_CASE("vertex data come back where the format holds them") {
  const MeshFile file = sample();
  for (const auto& [format, name] : {std::pair{"ply", "m.ply"}, {"ply-ascii", "m.ply"}}) {
    CAPTURE(format);
    const MeshFile back = write_and_read(file, format, name);
    check_normals(back.data.normals, file.data.normals, 1e-9f);
    CHECK(back.data.atoms == file.data.atoms);
    CHECK(back.data.components == file.data.components);
  }
  const MeshFile msms = write_and_read(file, "msms", "m.face");
  check_normals(msms.data.normals, file.data.normals, 1e-9f);
  CHECK(msms.data.atoms == file.data.atoms);
  CHECK(msms.data.components.empty());
  check_normals(write_and_read(file, "obj", "m.obj").data.normals, file.data.normals, 1e-9f);
  CHECK(write_and_read(file, "off", "m.off").data.normals.empty());
}

TEST_CASE("MSMS without header, and without spheres") {
  const Folder folder;
  write_mesh(kTetrahedron, {}, folder / "t.vert", {.format = "", .msms_header = false});
  const MeshFile back = read_mesh(folder / "t.vert");
  CHECK(back.mesh.vertices == kTetrahedron.vertices);
  CHECK(back.mesh.triangles == kTetrahedron.triangles);
  CHECK(back.data.atoms.empty());
  CHECK(back.data.normals.size() == 4);
}

TEST_CASE("headers of MSMS have the number of atoms, whichever of them are near a vertex") {
  MeshFile file = sample();
  CHECK(write_and_read(file, "msms", "m.vert").data.atom_count == 100);  // no more is known than the last that is near
  file.data.atom_count = 5;
  CHECK(write_and_read(file, "msms", "m.vert").data.atom_count == 100);
  file.data.atom_count = 906;
  const Folder folder;
  write_mesh(file.mesh, file.data, folder / "m.vert");
  for (const char* name : {"m.vert", "m.face"})
    CHECK_THAT(testing::read_file(folder / name), Catch::Matchers::ContainsSubstring(" 906 0.00 0.00\n"));
  CHECK(read_mesh(folder / "m.face").data.atom_count == 906);
  const MeshCheck check = check_mesh(file.mesh);
  CHECK(extract_components(file.mesh, file.data, check, {1}).data.atom_count == 906);
  const std::string vertex = "0 0 0 0 0 1 0 1 3\n";
  CHECK(parse_msms("# \n# \n1\n" + vertex, "a.vert", "1 1 1 1 1\n", "a.face").data.atom_count == 0);
}

TEST_CASE("gzipped files") {
  const Folder folder;
  write_mesh(kTetrahedron, {}, folder / "t.obj");
  const std::string text = testing::read_file(folder / "t.obj");
  gzFile packed = gzopen((folder / "u.obj.gz").c_str(), "wb");
  gzwrite(packed, text.data(), static_cast<unsigned>(text.size()));
  gzclose(packed);
  CHECK(read_mesh(folder / "u.obj.gz").mesh.triangles == kTetrahedron.triangles);
}

TEST_CASE("other compressions are named, with what helps for a mesh") {
  const Folder folder;
  const std::string name = (folder / "m.off.bz2").string();
  write_text("BZh91AY&SY", name);
  CHECK_THROWS_WITH(read_mesh(name), Catch::Matchers::EndsWith("on the way to standard input as in 'bzcat FILE | "
                                                               "gaussmesh check -'"));
  std::istringstream input("BZh91AY&SY");
  CHECK_THROWS_WITH(read_mesh(input, "-"), Catch::Matchers::EndsWith("'bzcat FILE | gaussmesh check -'"));
}

TEST_CASE("OBJ as other programs write it") {
  const char* text =
      "# comment\nmtllib x.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\n"
      "s off\nf 1/1/1 2/1/2 3/1/3\nf -3 -2 -1\nf 1// 2/1 3\n";
  CHECK(message(text, "a.obj").find("a.obj:14: expected a triangle") == 0);  // 1// has no normal behind the slashes
  const MeshFile file = parse_mesh(std::string_view(text).substr(0, std::string_view(text).rfind('f')), "a.obj");
  CHECK(file.mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}});
  CHECK(file.data.normals.empty());  // the second triangle has none
  CHECK(message("v 0 0 0\nf 1 1 1 1\n", "a.obj").find("a.obj:2: expected a triangle") == 0);
  CHECK(message("v 0 0 nan\n", "a.obj").find("a.obj:1: expected 'v'") == 0);
  CHECK(message("v 0 0 0\nf 0 1 1\n", "a.obj").find("a.obj:2:") == 0);
  CHECK(message("v 0 0 0\nf -2 1 1\n", "a.obj").find("a.obj:2:") == 0);
}

TEST_CASE("normals of any length are made unit vectors") {
  const MeshFile file =
      parse_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\nvn 0 0 0\nvn 1e300 0 0\nf 1//1 2//2 3//3\n", "n.obj");
  CHECK(file.data.normals == std::vector<Normal>{{0.0f, 0.6f, 0.8f}, {0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}});
}

TEST_CASE("PLY as other programs write it") {
  const std::string header =
      "ply\r\nformat binary_big_endian 1.0\r\ncomment made by hand\r\nelement vertex 3\r\nproperty uchar red\r\n"
      "property float32 x\r\nproperty float y\r\nproperty double z\r\nelement edge 1\r\nproperty int v\r\n"
      "element face 1\r\nproperty list uint8 int16 vertex_index\r\nproperty list uchar float "
      "texcoord\r\nend_header\r\n";
  std::string body;
  for (int v = 0; v < 3; ++v) {
    for (const std::string& bytes : {bytes_of('r'), bytes_of(float(v)), bytes_of(0.5f), bytes_of(double(v * v))})
      body += big_endian(bytes);
  }
  body += big_endian(bytes_of(std::int32_t{9}));  // the edge
  body += bytes_of(std::int8_t{3});
  for (std::int16_t v = 0; v < 3; ++v) body += big_endian(bytes_of(v));
  body += bytes_of(std::int8_t{1});
  body += big_endian(bytes_of(0.0f));
  const MeshFile file = parse_mesh(header + body, "any name");
  CHECK(file.mesh.vertices == std::vector<Point>{{0, 0.5, 0}, {1, 0.5, 1}, {2, 0.5, 4}});
  CHECK(file.mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(message(header + body.substr(0, body.size() - 1), "a.ply").find("a.ply: expected more data") == 0);
}

TEST_CASE("PLY that is none names the line or the byte") {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK(message(header + "0 0 0\n4 0 0 0 0\n", "a").find("a:11: expected a triangle") == 0);
  CHECK(message(header + "0 0 x\n3 0 0 0\n", "a").find("a:10: expected a finite number") == 0);
  CHECK(message(header + "0 0 0\n3 0 -1 0\n", "a").find("a:11: expected a number counted from 0") == 0);
  CHECK(message("ply\nformat ascii 2.0\n", "a").find("a:2: expected 'format'") == 0);
  CHECK(message("ply\nformat ascii 1.0\nend_header\n", "a").find("a: expected elements") == 0);
  CHECK(message("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n", "a").find("a:4: expected a property") ==
        0);
  CHECK(message("ply\nformat ascii 1.0\n", "a").find("a:2: expected 'end_header'") == 0);
}

TEST_CASE("STL in ascii, and binary that begins like it") {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1e0 0 0\nvertex 0 1 -0\nendloop\nendfacet\n";
  CHECK(parse_mesh("solid thing\n" + facet + "endsolid\n", "a.stl").mesh.vertices.size() == 3);
  CHECK(message("solid\nfacet\nvertex 0 0 0\nendfacet\n", "a.stl").find("a.stl:4: expected three lines") == 0);
  std::string binary = "solid but binary";
  binary.resize(80, ' ');
  binary += bytes_of(std::uint32_t{1});
  for (int i = 0; i < 12; ++i) binary += bytes_of(static_cast<float>(i % 5));
  CHECK(parse_mesh(binary + "\0\0"s, "a.stl").mesh.triangles.size() == 1);
  CHECK(message(binary, "b.stl").find("b.stl") == 0);
}

TEST_CASE("smesh counted from 1, with comments") {
  const MeshFile file =
      parse_mesh("# nodes\n3 3 0 0\n1 0 0 0\n2 1 0 0 # second\n3 0 1 0\n1 0\n3 1 2 3\n0\n0\n", "a.smesh");
  CHECK(file.mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(message("2 3\n1 0 0 0\n3 1 0 0\n", "a.smesh").find("a.smesh:3: expected a node") == 0);
  CHECK(message("1 3\n1 0 0 0\n1\n3 0 1 1\n", "a.smesh").find("a.smesh:4: expected a triangle") == 0);
}

TEST_CASE("smesh as TetGen writes it has its nodes in another file") {
  const std::string smesh =
      "# m.1.smesh.  TetGen's input file.\n\n# part 1: node list.\n0  3  0  0  # nodes are found in m.1.node.\n\n"
      "# part 2: facet list.\n2  1\n3  1  4  3    -1\n3  1  3  9    -1\n\n# part 3: hole list.\n0\n";
  const Folder folder;
  const std::string name = (folder / "m.1.smesh").string();
  write_text(smesh, name);
  const std::string told =
      ":4: expected nodes, got '0  3  0  0'; those in a .node file are read from beside a .smesh file that is named";
  CHECK_THROWS_WITH(read_mesh(name), Catch::Matchers::Equals(name + told));
  CHECK(message(smesh, "standard input") == "standard input" + told);
  write_text("4  3  0  0\n1  0 0 0\n2  5 5 5\n3  0 1 0\n4  0 0 1\n# Generated by tetgen\n", folder / "m.1.node");
  const TriangleMesh mesh = read_mesh(name).mesh;
  CHECK(mesh.vertices == std::vector<Point>{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}});  // without the one inside
  REQUIRE(mesh.triangles.size() == 2);
  CHECK(mesh.triangles[0] == Triangle{0, 2, 1});
  CHECK(mesh.triangles[1][2] >= mesh.vertices.size());  // for check_mesh() to find
}

TEST_CASE("a stream is read as a file of its name") {
  std::istringstream input("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(read_mesh(input, "a.obj").mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("what has no extension that tells is known by what is in it") {
  const MeshFile file = sample();
  const Folder folder;
  for (const auto& [format, name] : std::initializer_list<std::pair<const char*, const char*>>{{"off", "m"},
                                                                                               {"ply", "m"},
                                                                                               {"ply-ascii", "m"},
                                                                                               {"obj", "m.txt"},
                                                                                               {"stl", "m"},
                                                                                               {"gmsh22", "m"},
                                                                                               {"gmsh41", "m"},
                                                                                               {"smesh", "m.mesh"}}) {
    CAPTURE(format);
    write_mesh(file.mesh, file.data, folder / name, {.format = format});
    CHECK(read_mesh(folder / name).mesh.triangles.size() == file.mesh.triangles.size());
    std::istringstream stream(testing::read_file(folder / name));
    CHECK(read_mesh(stream, "standard input").mesh.triangles.size() == file.mesh.triangles.size());
  }
  const auto triangles = [](const std::string& text) {
    return parse_mesh(text, "standard input").mesh.triangles.size();
  };
  CHECK(triangles("# by hand\n\nNOFF 3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n") == 1);
  CHECK(triangles("# by hand\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n") == 1);
  CHECK(triangles("solid a\n facet normal 0 0 1\n  outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                  "endfacet\nendsolid\n") == 1);
  CHECK(triangles("# nodes\n3 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 0\n3 1 2 3\n0\n0\n") == 1);
  const std::string remedy = "'; MSMS is known by the extensions .vert and .face alone";
  const std::string expected = "expected a mesh in OFF, PLY, OBJ, STL, VTP, Gmsh .msh or TetGen .smesh, got '";
  CHECK(message("\n0 0 0 0 0 1 0 1 3\n", "standard input") ==
        "standard input:2: " + expected + "0 0 0 0 0 1 0 1 3" + remedy);
  CHECK(message("solid ground\n", "m") == "m:1: " + expected + "solid ground" + remedy);
  CHECK(message("1 3 2 1 1\n", "m") == "m:1: " + expected + "1 3 2 1 1" + remedy);
  CHECK(message("# nothing\n", "m") == "m:1: " + expected + "end of file" + remedy);
  for (const char* name : {"standard input", "a.obj", "a.stl", "a.smesh", "a.msh"})
    CHECK(message(" \n", name) == std::string(name) + ": expected a mesh, got nothing: the file is empty");
}

TEST_CASE("one file of MSMS needs the other") {
  const Folder folder;
  write_mesh(kTetrahedron, {}, folder / "t.vert");
  std::filesystem::remove(folder / "t.vert");
  const std::string face = (folder / "t.face").string(), vert = (folder / "t.vert").string();
  CHECK_THROWS_WITH(read_mesh(face), Catch::Matchers::Equals(face + ": expected MSMS, with vertices in '" + vert +
                                                             "', got no such file; of TetGen, .smesh files are read"));
  write_mesh(kTetrahedron, {}, folder / "t.vert");
  std::filesystem::remove(face);
  CHECK_THROWS_WITH(read_mesh(vert),
                    Catch::Matchers::Equals(vert + ": expected MSMS, with faces in '" + face + "', got no such file"));
  write_text("", face);
  CHECK_THROWS_WITH(read_mesh(vert),
                    Catch::Matchers::ContainsSubstring("t.face: expected a mesh, got nothing: the file is empty"));
}

TEST_CASE("MSMS that is none") {
  const auto told = [](std::string_view vertices, std::string_view faces) {
    try {
      parse_msms(vertices, "a.vert", faces, "a.face");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string vertex = "0 0 0 0 0 1 0 1 3\n";
  CHECK(told("# \n# \n2 1 0 0\n" + vertex, "").find("a.vert: expected 2 vertices") == 0);
  CHECK(told(vertex, "0 1 1 1 1\n").find("a.face:1: expected a face") == 0);
  CHECK(told("0 0 0\n", "").find("a.vert:1: expected a vertex") == 0);
  CHECK_THROWS_AS(read_mesh("no_such.face"), InputError);
}

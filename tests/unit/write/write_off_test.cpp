#include "catch2.h"
#include "core/lattice.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_mesh.h"
#include "gaussmesh/write_mesh.h"
#include "support/folder.h"
#include "support/random.h"

using namespace gaussmesh;
using testing::Folder;
using testing::read_file;

namespace {

TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1.5, 0, 0}, {0, -2.000000001, 0}, {0.123456789, 0, 1000000}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

}  // namespace

TEST_CASE("OFF is written with nine decimals and nothing else") {
  const Folder folder;
  write_mesh(tetrahedron(), {}, folder / "t.off");
  CHECK(read_file(folder / "t.off") ==
        "OFF\n4 4 0\n"
        "0.000000000 0.000000000 0.000000000\n"
        "1.500000000 0.000000000 0.000000000\n"
        "0.000000000 -2.000000001 0.000000000\n"
        "0.123456789 0.000000000 1000000.000000000\n"
        "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
}

TEST_CASE("what is read back has the same bits") {
  const std::uint64_t seed = 101;
  CAPTURE(seed);
  testing::Random random(seed);
  TriangleMesh mesh;
  for (int i = 0; i < 20000; ++i) {
    Point p;
    for (double& x : p) x = to_angstrom(random.integer(-1000000000000000, 1000000000000000) >> random.integer(0, 50));
    mesh.vertices.push_back(p);
  }
  for (std::uint32_t i = 0; i + 2 < 20000; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  const Folder folder;
  write_mesh(mesh, {}, folder / "m.off");
  const TriangleMesh back = read_mesh(folder / "m.off").mesh;
  CHECK(back.vertices == mesh.vertices);
  CHECK(back.triangles == mesh.triangles);
}

TEST_CASE("records are in their order for any number of threads, and an error on one of them is thrown") {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 50000; ++i) {
    mesh.vertices.push_back({i * 1e-3, 0.0, 1.0});
    mesh.triangles.push_back({i, i / 2, i / 3});
  }
  const Folder folder;
  for (const char* name : {"m.off", "m.obj", "m.stl", "m.vtp"}) {
    CAPTURE(name);
    WriteOptions options;
    options.threads = 1;
    write_mesh(mesh, {}, folder / name, options);
    const std::string expected = read_file(folder / name);
    for (const int threads : {2, 5, 0}) {
      options.threads = threads;
      write_mesh(mesh, {}, folder / name, options);
      CHECK(read_file(folder / name) == expected);
    }
  }
  WriteOptions options;
  options.format = "off";
  options.threads = 3;
  CHECK_THROWS_AS(write_mesh(mesh, {}, "/dev/full", options), InputError);
}

TEST_CASE("small negative coordinates keep their sign; there is no minus before zero") {
  const Folder folder;
  write_mesh({{{-1e-9, -0.0, 0.999999999}, {-0.5, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, folder / "n.off");
  CHECK_THAT(read_file(folder / "n.off"),
             Catch::Matchers::ContainsSubstring("-0.000000001 0.000000000 0.999999999\n-0.500000000"));
}

TEST_CASE("an empty mesh is a legal file") {
  const Folder folder;
  write_mesh({}, {}, folder / "e.off");
  CHECK(read_file(folder / "e.off") == "OFF\n0 0 0\n");
}

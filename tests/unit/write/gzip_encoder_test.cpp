#include <random>

#include "catch2.h"
#include "gaussmesh/write_mesh.h"
#include "support/folder.h"
#include "text/read_file.h"
#include "write/whole_file.h"

using namespace gaussmesh;

TEST_CASE("a name that ends in .gz has the text gzipped, in however many pieces") {
  constexpr std::size_t kPiece = 100'000;
  const testing::Folder folder;
  std::string text;
  std::mt19937 random(1);
  for (const char* name : {"empty.off.gz", "a.gz", "b.GZ"}) {
    CAPTURE(name, text.size());
    WholeFile file(folder / name);
    for (std::size_t i = 0; i < text.size(); i += kPiece) file.write(std::string_view(text).substr(i, kPiece));
    WholeFile moved = std::move(file);
    moved.commit();
    CHECK(testing::read_file(folder / name).starts_with("\x1f\x8b"));
    CHECK(read_file(folder / name) == text);
    // What cannot be made small comes out in more pieces than one at once.
    for (std::size_t i = 0; i < 5 * kPiece; ++i) text += static_cast<char>(random());
  }
  CHECK(folder.files() == 3);
}

TEST_CASE("which files and formats a gzipped mesh has") {
  using Paths = std::vector<std::filesystem::path>;
  CHECK(format_of("a.b/m.PLY.gz").name == "ply");
  CHECK(files_of("m.vert.gz") == Paths{"m.vert.gz", "m.face.gz"});
  CHECK(files_of("m.face.GZ") == Paths{"m.vert.GZ", "m.face.GZ"});
  CHECK(files_of("m.gz", {.format = "msms"}) == Paths{"m.vert.gz", "m.face.gz"});
  CHECK(files_of("m.off.gz", {.format = "msms"}) == Paths{"m.off.vert.gz", "m.off.face.gz"});
  CHECK(files_of("m.off.gz") == Paths{"m.off.gz"});
}

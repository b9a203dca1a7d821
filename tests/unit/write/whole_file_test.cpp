#include "write/whole_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <thread>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "gaussmesh/write_mesh.h"
#include "support/folder.h"

using namespace gaussmesh;
namespace fs = std::filesystem;
using testing::Folder;
using testing::read_file;

TEST_CASE("the file appears whole and alone, and replaces an old one") {
  const Folder folder;
  write_text("old", folder / "f");
  CHECK(read_file(folder / "f") == "old");
  {
    WholeFile file(folder / "f");
    file.write("new");
    CHECK(read_file(folder / "f") == "old");
    CHECK(folder.files() == 2);
    file.commit();
  }
  CHECK(read_file(folder / "f") == "new");
  CHECK(folder.files() == 1);
}

TEST_CASE("what is not committed leaves no trace") {
  const Folder folder;
  write_text("old", folder / "f");
  {
    WholeFile file(folder / "f");
    file.write("new");
    file.close();
  }
  CHECK(read_file(folder / "f") == "old");
  CHECK(folder.files() == 1);
}

TEST_CASE("a file that cannot be written is an error that names it, and leaves nothing behind") {
  const Folder folder;
  CHECK_THROWS_AS(write_text("x", folder / "no/such/folder.off"), InputError);
  fs::create_directory(folder / "taken");
  CHECK_THROWS_AS(write_text("x", folder / "taken"), InputError);
  CHECK_THROWS_AS(require_writable(folder / "taken"), InputError);
  try {
    write_text("x", folder / "no/such/folder.off");
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), Catch::Matchers::ContainsSubstring("folder.off"));
  }
  require_writable(folder / "new");
  CHECK(folder.files() == 1);
}

TEST_CASE("a device takes the output as it comes, and stays") {
  CHECK_THROWS_AS(write_text("x", "/dev/full"), InputError);
  write_text("x", "/dev/null");
  CHECK(fs::is_character_file("/dev/null"));
  CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("a pipe takes the output as it comes") {
  const Folder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  std::string got;
  std::thread reader([&] { got = read_file(folder / "pipe"); });
  write_text("through", folder / "pipe");
  reader.join();
  CHECK(got == "through");
  CHECK(fs::is_fifo(folder / "pipe"));
}

TEST_CASE("what is open has a name in /dev/fd, as the shell gives it for >(command)") {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const std::string name = "/dev/fd/" + std::to_string(ends[1]);
  require_writable(name);
  write_text("through", name);
  ::close(ends[1]);
  char got[16];
  CHECK(::read(ends[0], got, sizeof got) == 7);
  CHECK(::read(ends[0], got, sizeof got) == 0);
  ::close(ends[0]);
  CHECK_THROWS_AS(require_writable(name), InputError);
}

TEST_CASE("an open file that no folder names is written to where it is") {
  const Folder folder;
  std::FILE* const file = std::fopen((folder / "gone").c_str(), "w+");
  fs::remove(folder / "gone");
  write_text("text", "/dev/fd/" + std::to_string(::fileno(file)));
  char got[16];
  CHECK(std::fread(got, 1, sizeof got, file) == 4);
  std::fclose(file);
  CHECK(folder.files() == 0);
}

TEST_CASE("a symbolic link stays, and what it points to is replaced") {
  const Folder folder;
  fs::create_directory(folder / "elsewhere");
  write_text("old", folder / "elsewhere/f");
  fs::create_symlink(folder / "elsewhere/f", folder / "link");
  write_text("new", folder / "link");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(read_file(folder / "elsewhere/f") == "new");
}

TEST_CASE("a name may be as long as the file system takes") {
  const Folder folder;
  const std::string plain(255, 'a');
  std::string umlauts = "x";
  while (umlauts.size() < 255) umlauts += "\u00fc";
  for (const std::string& name : {plain, umlauts}) {
    OutputFiles files;
    files.add_text("x", folder / name);
    files.add_text("y", folder / "other");
    files.commit();
    CHECK(read_file(folder / name) == "x");
  }
  CHECK(folder.files() == 3);
}

TEST_CASE("several files appear together or not at all") {
  const Folder folder;
  {
    OutputFiles files;
    files.add_text("a", folder / "a");
    CHECK_THROWS_AS(files.add_text("b", folder / "no/such/folder"), InputError);
  }
  CHECK(folder.files() == 0);
  OutputFiles files;
  files.add_text("a", folder / "a");
  files.add_text("b", folder / "b");
  CHECK_FALSE(fs::exists(folder / "a"));
  files.commit();
  CHECK(read_file(folder / "a") + read_file(folder / "b") == "ab");
  CHECK(folder.files() == 2);
}

TEST_CASE("where one file cannot be put in its place the others are as they were") {
  const Folder folder;
  write_text("old", folder / "a");
  OutputFiles files;
  files.add_text("new", folder / "a");
  files.add_text("new", folder / "b");
  files.add_text("new", folder / "c");
  fs::create_directory(folder / "c");  // no file can be renamed to it
  CHECK_THROWS_WITH(files.commit(), Catch::Matchers::ContainsSubstring("cannot be put in its place"));
  CHECK(read_file(folder / "a") == "old");
  CHECK_FALSE(fs::exists(folder / "b"));
  files = OutputFiles();
  CHECK(folder.files() == 2);
  fs::remove(folder / "c");
  files.add_text("new", folder / "a");
  files.add_text("new", folder / "c");
  files.commit();
  CHECK(read_file(folder / "a") + read_file(folder / "c") == "newnew");
  CHECK(folder.files() == 2);
}

TEST_CASE("what is unfinished can be removed at any time, and nothing else is") {
  const Folder folder;
  write_text("done", folder / "done");
  OutputFiles files;
  files.add_text("a", folder / "a");
  const WholeFile open(folder / "b");
  CHECK(folder.files() == 3);
  {
    const WholeFile::CommitsUnderWay guard;  // as when a signal comes while files are put in their places
    CHECK_FALSE(remove_unfinished_files());
    CHECK(folder.files() == 3);
  }
  CHECK(remove_unfinished_files());
  CHECK(folder.files() == 1);
  CHECK(read_file(folder / "done") == "done");
}

TEST_CASE("a new file gets the permissions that any new file would get") {
  const Folder folder;
  write_text("x", folder / "ours");
  std::ofstream(folder / "theirs") << "x";
  CHECK(fs::status(folder / "ours").permissions() == fs::status(folder / "theirs").permissions());
}

// Files of radii: what comes before what, what is refused, and together with named sets.
#include "atoms/radius_file.h"

#include <fstream>
#include <sstream>

#include "atoms/atom_file_checks.h"
#include "support/folder.h"

using namespace gaussmesh;
using Catch::Matchers::ContainsSubstring;

namespace {

std::string error_of(std::string_view text) {
  return input_error_of([&] { RadiusFile(text, "my.radii"); });
}

/// An atom CA of a glycine and an iron of a heme.
const std::string kPdb =
    "ATOM      1  CA  GLY A   7       1.500  -2.250   3.125  1.00 10.00           C\n"
    "HETATM    2 FE   HEM A   8       5.500  -2.250   3.125  1.00 10.00          FE\n";

AtomFile read_pdb(const ReadOptions& options) {
  std::istringstream text(kPdb);
  return read_atoms(text, "a.pdb", options);
}

}  // namespace

TEST_CASE("an entry for a residue comes before one for all, and a name before an element") {
  const std::string all = "# mine\n\nGLY CA 1.1\nGLY C 1.2 # by element\nca 1.3\nC\t1.4\n";
  CHECK(RadiusFile(all, "f").find("GLY", "CA", "C") == 1.1);
  CHECK(RadiusFile(all, "f").find("gly", "ca", "c") == 1.1);
  CHECK(RadiusFile(all, "f").find("GLY", "CB", "C") == 1.2);
  CHECK(RadiusFile(all, "f").find("ALA", "CA", "C") == 1.3);
  CHECK(RadiusFile(all, "f").find("ALA", "CB", "C") == 1.4);
  CHECK_FALSE(RadiusFile(all, "f").find("GLY", "N", "N"));
  CHECK_FALSE(RadiusFile(all, "f").find("GLY", "N", ""));
}

TEST_CASE("files of radii that are wrong name the line") {
  CHECK(error_of("C 1.7\nGLY CA C 1.7\n") == "my.radii:2: expected [residue] name radius, got 'GLY CA C 1.7'");
  CHECK(error_of("atom__res_radius_\n") == "my.radii:1: expected [residue] name radius, got 'atom__res_radius_'");
  CHECK(error_of("# r\nC 1,7\n") ==
        "my.radii:2: expected a radius (A) as a finite number, got '1,7'; write decimals with a point");
  CHECK(error_of("C -1\n") == "my.radii:1: expected a radius >= 0 (A), got '-1'");
  CHECK(error_of("C 1e6\n") == "my.radii:1: expected a radius <= 1e+05 (A), got '1e6'");
  CHECK(error_of("C 1.7\nN 1.6\nc 1.8\n") == "my.radii:3: expected each atom once, got 'c 1.8', which line 1 has");
  CHECK(error_of("# nothing\n") == "my.radii: expected lines of [residue] name radius, got none");
  CHECK_THAT(error_of("\xff\xfe"), ContainsSubstring("UTF-16"));
}

TEST_CASE("a file of radii comes before a set, or stands alone") {
  const testing::Folder folder;
  const auto file = folder / "my.radii";
  const std::string path = file.string();
  std::ofstream(file) << "HEM FE 1.5\n";
  const AtomFile both = read_pdb({"", "bondi", file});
  REQUIRE(both.atoms.size() == 2);
  CHECK(both.atoms[0].radius == 1.70);
  CHECK(both.atoms[1].radius == 1.5);
  CHECK(both.warnings.empty());
  CHECK_THAT(input_error_of([&] {
               read_pdb({"", "", file});
             }),
             ContainsSubstring("a.pdb:1: expected atoms that the radii '" + path + "' know, got atom CA"));
  CHECK_THAT(input_error_of([&] { read_pdb({"", "bondi", {}}); }), ContainsSubstring("radii 'bondi' know"));

  std::ofstream(file) << "FE 1.5\nC 20\n";
  const AtomFile alone = read_pdb({"", "", file});
  CHECK(alone.atoms[0].radius == 20.0);
  REQUIRE(alone.warnings.size() == 1);
  CHECK(alone.warnings[0] == path + ":2: radius 20 A is larger than 10 A: is it meant?");

  std::ofstream(file) << "C 1.7\n";
  CHECK_THAT(input_error_of([&] {
               read_pdb({"", "amber", file});
             }),
             ContainsSubstring("radii '" + path + "' and 'amber' know, got atom FE"));
  CHECK_THAT(input_error_of([&] { read_pdb({"", "bondi", folder / "none"}); }), ContainsSubstring("readable file"));
  std::istringstream pqr("ATOM 1 N ASN 1 -8.9 4.1 -0.5 0.18 1.8\n");
  CHECK_THROWS_AS(read_atoms(pqr, "a.pqr", {"", "", file}), OptionError);
}

TEST_CASE("entries of a residue that is there, but not with such an atom, are told") {
  const testing::Folder folder;
  const auto file = folder / "my.radii";
  const auto warnings_of = [&](const std::string& text) {
    std::ofstream(file) << text;
    return read_pdb({"", "bondi", file}).warnings;
  };
  const std::string start = file.string() + ":";
  CHECK(warnings_of("HEM FE 1.5\nhem fee 1.5\n") ==
        std::vector<std::string>{start + "2: no atom fits 'HEM FEE', though its residue is there"});
  CHECK(warnings_of("HEM NA 1.5\nHEM FE 1.5\nHEM NB 1.5\nGLY CAA 1.5\n") ==
        std::vector<std::string>{start +
                                 "1: no atom fits 'HEM NA', though its residue is there; as in 2 more lines, the "
                                 "next 3"});
  // What a table for all molecules may have.
  CHECK(warnings_of("GLY CA 1.7\nGLY OXT 1.5\nGLY C 1.7\nHEM FE 1.5\nHEM HHA 1.2\nLIG C1 1.7\nZN 1.4\n").empty());
}

#include "atoms/atom_file_checks.h"

using namespace gaussmesh;
using Catch::Matchers::ContainsSubstring;

namespace {

std::string error_of(std::string_view text) {
  return input_error_of([&] { parse_xyzr(text, "f.xyzr"); });
}

}  // namespace

TEST_CASE("parse_xyzr reads four numbers a line") {
  const AtomFile file = parse_xyzr("1 2 3 4\r\n\t-1.5\t+2e1\t3D0\t0\r\n", "f.xyzr");
  REQUIRE(file.atoms.size() == 2);
  CHECK(same_atom(file.atoms[0], {1, 2, 3, 4, 0}));
  CHECK(same_atom(file.atoms[1], {-1.5, 20, 3, 0, 0}));
}

TEST_CASE("parse_xyzr passes over comments, blank lines and names") {
  const AtomFile file =
      parse_xyzr("\xef\xbb\xbf# x y z r\n\n 1 2 3 4 # first\n1 2 3 5#second\n1 2 3 6 N ASN\n", "f.xyzr");
  REQUIRE(file.atoms.size() == 3);
  CHECK(file.atoms[1].radius == 5.0);
  CHECK(file.warnings.empty());
}

TEST_CASE("parse_xyzr passes over what follows x y z radius") {
  const auto radius_of = [](std::string_view text) {
    const AtomFile file = parse_xyzr(text, "f.xyzr");
    REQUIRE(file.atoms.size() == 2);
    CHECK(file.warnings.empty());
    CHECK(same_atom(file.atoms[0], {0, 0, 0, 1.65, 0}));
    return file.atoms[1].radius;
  };
  CHECK(radius_of("0.0 0.0 0.0 1.65 1 N_ALA_1\n1.45 0.0 0.0 1.87 1 CA_ALA_1\n") == 1.87);  // MSMS
  CHECK(radius_of("0 0 0 1.65 0.3\n2 0 0 1.5 -0.3\n") == 1.5);                             // NanoShaper
  CHECK(radius_of("2\n0 0 0 1.65 0.3\n2 0 0 1.5 -0.3 4 x 2,5\n") == 1.5);
}

TEST_CASE("parse_xyzr finds numbers of atoms that stand in the place of x") {
  const std::string line = "1 4 5 6 1.5\n2 4 5 6 1.5\n3 4 5 6 1.5\n";
  CHECK(
      error_of("4\n" + line + "4 4 5 6 1.5\n") ==
      "f.xyzr:2: expected four numbers x y z radius, got '1 4 5 6 1.5', whose first counts the lines from here to the "
      "last; take it out, or write x with a decimal point");
  CHECK_THAT(error_of("0 4 5 6 1.5\n" + line), ContainsSubstring("counts the lines"));
  for (const char* last : {"", "4. 4 5 6 1.5\n", "5 4 5 6 1.5\n", "4 4 5 6\n", "4 4 5 6 N\n"}) {
    CHECK(error_of(line + last).empty());
  }
}

TEST_CASE("parse_xyzr holds the number of atoms to its word") {
  CHECK(parse_xyzr("# two\n2\n0 0 0 1\n3 0 0 1\n", "f.xyzr").atoms.size() == 2);
  CHECK(error_of("# two\n3\n0 0 0 1\n3 0 0 1\n") == "f.xyzr:2: expected as many atoms as this line says, 3, got 2");
  CHECK_THAT(error_of("2\n2\n0 0 0 1\n3 0 0 1\n"), ContainsSubstring("f.xyzr:2: expected four numbers"));
  CHECK_THAT(error_of("0 0 0 1\n1\n"), ContainsSubstring("f.xyzr:2: expected four numbers x y z radius, got '1'"));
  CHECK_THAT(error_of("99999999999999999999999\n0 0 0 1\n"), ContainsSubstring("f.xyzr:1: expected four numbers"));
  CHECK_THAT(error_of("-1\n0 0 0 1\n"), ContainsSubstring("f.xyzr:1: expected four numbers"));
  CHECK_THAT(error_of("0\n"), ContainsSubstring("got no atoms"));
}

TEST_CASE("parse_xyzr refuses other lines") {
  CHECK(error_of("0 0 0 1\n0 0 1\n") == "f.xyzr:2: expected four numbers x y z radius, got '0 0 1'");
  CHECK_THAT(error_of("0 0 x 1 2\n"), ContainsSubstring("f.xyzr:1: expected z (A) as a finite number, got 'x'"));
  CHECK_THAT(error_of("0 0 0 N 1\n"), ContainsSubstring("f.xyzr:1: expected a radius (A) as a finite number, got 'N'"));
  CHECK_THAT(error_of("0 0 0 nan\n"),
             ContainsSubstring("f.xyzr:1: expected a radius (A) as a finite number, got 'nan'"));
  CHECK_THAT(error_of("C 0 0 0\n"), ContainsSubstring("expected x (A) as a finite number, got 'C'"));
  CHECK_THAT(error_of("0 0 0 -1\n"), ContainsSubstring("expected a radius >= 0 (A), got '-1'"));
  CHECK_THAT(error_of("ATOM 1 N ASN 1 -8.901 4.127 -0.555 0.1801 1.8240\n"), ContainsSubstring("got 'ATOM'"));
  CHECK_THAT(error_of(std::string_view("0 0 0 1\n0 0 \0 1", 15)),
             ContainsSubstring("f.xyzr:2: expected text, got a NUL"));
  CHECK_THAT(error_of(""), ContainsSubstring("f.xyzr: expected lines of x y z radius, got no atoms"));
}

TEST_CASE("parse_xyzr accepts a large sphere and warns of it") {
  const AtomFile file = parse_xyzr("0 0 0 1\n0 0 0 1000\n", "f.xyzr");
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0] == "f.xyzr:2: radius 1000 A is larger than 10 A: is it meant?");
}

// Records by themselves: which fields are the numbers, what is refused, what is warned of.
#include <array>
#include <cstdio>
#include <string>
#include <string_view>

#include "atoms/atom_file_checks.h"

using namespace gaussmesh;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string kNumbers = " 1.25 -2.5 3.75 -0.5 1.5";
const Atom kAtom = {1.25, -2.5, 3.75, 1.5, -0.5};

std::string error_of(std::string_view text) {
  return input_error_of([&] { parse_pqr(text, "f.pqr"); });
}

/// `count` records of a PDB file, with B-factors 1 A^2 apart from `first_b` on, and `tail` behind.
std::string pdb_records(int count, int first_b, const std::string& tail) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    std::array<char, 90> line{};
    std::snprintf(line.data(), line.size(), "ATOM  %5d  CA  ALA A%4d    %8.3f%8.3f%8.3f%6.2f%6.2f", i + 1, i + 1,
                  3.8 * i, 0.0, 0.0, 1.0, static_cast<double>(first_b + i));
    text += line.data() + tail + "\n";
  }
  return text;
}

const std::string kElement = "           C";

}  // namespace

TEST_CASE("parse_pqr finds the numbers whatever the names") {
  const std::string names = GENERATE(
      "ATOM 1 N ASN 1", "atom 1 N ASN 1", "Hetatm 1 N ASN 1", "ATOM100000 N ASN 1", "ATOM***** N ASN 1",
      "HETATM99941 N ASN 1", "HETATMA000F N ASN 1", "ATOM ***** N ASN ****", "ATOM 1 N ASN A 1", "ATOM 1 N ASN 1 1",
      "ATOM 1 N ASN A1001", "ATOM 1 N ASN A-5", "ATOM 1 N ASN A 1 B", "ATOM 1 N ASN A1001B", "ATOM 1 N ASN -5B",
      "ATOM 1 HD11LEU 2", "ATOM 1 HD11LEU A1002", "ATOM 1 CAXXAASN A 1", "ATOM 1 N A DA B 1", "ATOM 1 C1 112 1",
      "ATOM 1 1H 2HP 1 1", "ATOM 1 \"O5'\" DA 1", "ATOM\t1\tN\tASN\t1\t", "   ATOM 1 N ASN 1", "ATOM 1 N ASN AA 1");
  const std::string behind = GENERATE("", " ", "\r", " N", "      N1+", " PROA Cl", " # 1 2 3", " N # 4", "\t#5");
  const std::string text = names + kNumbers + behind;
  CAPTURE(text);
  const AtomFile file = parse_pqr(text, "f.pqr");
  REQUIRE(file.atoms.size() == 1);
  CHECK(same_atom(file.atoms[0], kAtom));
  CHECK(file.warnings.empty());
}

TEST_CASE("parse_pqr refuses records that lack a number") {
  const std::string names =
      GENERATE("ATOM 10 HB3 ASN 1", "ATOM 10 HB3 ASN A 1", "ATOM 10 HD11LEU 1", "ATOM 10 C1 A12 1", "ATOM 10 C1 112 1",
               "ATOM 10 C1 A12 A 1", "ATOM 10 C1 112 A 1", "ATOM 10 N ASN A1", "ATOM      10  HB3 ASN      1     ",
               "ATOM", "ATOM 10", "ATOM 10 HB3 ASN", "HETATM");
  const std::string numbers = GENERATE("", " 1.5", " 1.5 2.5", " 1.5 2.5 3.5", " 1.5 2.5 3.5 0.5");
  const std::string behind = GENERATE("", " N", " # 7");
  const std::string text = "REMARK\n" + names + numbers + behind + "\n";
  CAPTURE(text);
  CHECK_THAT(error_of(text), ContainsSubstring("f.pqr:2: expected "));
}

TEST_CASE("parse_pqr finds a missing number in spite of a numeric chain") {
  const std::string good = "ATOM 1 N ASN 1 1 -8.901 4.127 -0.555 0.1801 1.8240\n";
  const std::string bad = "ATOM 2 CA ASN 1 1 -8.608 3.135 -1.618 0.0368\n";
  CHECK_THAT(error_of(good + bad),
             ContainsSubstring("f.pqr:2: expected as many fields as in the other records, got '1'"));
  CHECK_THAT(error_of(bad + good),
             ContainsSubstring("f.pqr:1: expected as many fields as in the other records, got '1'"));
}

TEST_CASE("parse_pqr accepts integers where nothing speaks against them") {
  CHECK(same_atom(parse_pqr("ATOM 1 C SPH 1 0 0 0 1 2", "f.pqr").atoms.at(0), {0, 0, 0, 2, 1}));
  const AtomFile file = parse_pqr("ATOM 1 C SPH 1 0 1.5 2.5 0 2\nATOM 2 C SPH 2 1.5 1.5 2.5 0 2\n", "f.pqr");
  CHECK(file.atoms.at(0).x == 0.0);
}

TEST_CASE("parse_pqr refuses numbers behind the radius") {
  CHECK_THAT(error_of("ATOM 1 N ASN 1 1.5 2.5 3.5 0.5 1.5 7\n"), ContainsSubstring("f.pqr:1: expected serial"));
  CHECK_THAT(error_of("ATOM 1 N ASN A 1 1.5 2.5 3.5 0.5 1.5 0 N\n"), ContainsSubstring("f.pqr:1: expected serial"));
  CHECK_THAT(error_of("ATOM 1 N ASN A 1 1 2.5 3.5 0.5 1.5 0.0\n"), ContainsSubstring("f.pqr:1: expected serial"));
  CHECK_THAT(error_of("ATOM 1 N ASN 1 1 1 2.5 3.5 0.5 1.5 0.0\n"), ContainsSubstring("f.pqr:1: expected serial"));
}

TEST_CASE("parse_pqr reads columns where fields fail") {
  const Atom expected = {-158.901, -245.873, 1049.445, 1.824, 0.1801};
  const std::string record =
      GENERATE("ATOM      1  N   ASN A   1    -158.901-245.8731049.445  0.1801 1.8240",
               "ATOM      1  N   ASN 1   1    -158.901-245.8731049.445  0.1801 1.8240      N",
               "ATOM      1  N   ASN      1    -158.901-245.8731049.445  0.1801 1.8240",
               "HETATM99999  N   ASN A9999    -158.901-245.8731049.445  0.1801 1.8240",
               "ATOM      1  N                -158.901-245.8731049.445  0.1801 1.8240",
               "ATOM      1                   -158.901-245.8731049.445  0.1801 1.8240 # no names");
  CAPTURE(record);
  CHECK(same_atom(parse_pqr(record, "f.pqr").atoms.at(0), expected));
}

TEST_CASE("parse_pqr refuses columns that are not clear") {
  // x has grown out of its columns; radius missing; element in the radius's place; y glued to a broken x.
  CHECK_THAT(error_of("ATOM      1  N   ASN A   1   -1158.901-245.8731049.445  0.1801 1.8240"),
             ContainsSubstring(":1: "));
  CHECK_THAT(error_of("ATOM      1  N   ASN A   1    -158.901-245.8731049.445  0.1801"), ContainsSubstring(":1: "));
  CHECK_THAT(error_of("ATOM      1  N   ASN A   1    -158.901-245.8731049.445  0.1801      N"),
             ContainsSubstring("expected a radius (A) as a finite number, got 'N'"));
  CHECK_THAT(error_of("ATOM      1  N   ASN A   1    ********-245.8731049.445  0.1801 1.8240"),
             ContainsSubstring(":1: "));
  CHECK_THAT(error_of("ATOM      1  N   ASN A   1    -1-8.901-245.8731049.445  0.1801 1.8240"),
             ContainsSubstring(":1: "));
}

TEST_CASE("parse_pqr reads numbers in the notations of C and Fortran") {
  struct Case {
    const char* text;
    double value;
  };
  const Case good = GENERATE(values<Case>({{"1", 1.0},
                                           {"+1.5", 1.5},
                                           {"-1.5", -1.5},
                                           {".5", 0.5},
                                           {"-.5", -0.5},
                                           {"5.", 5.0},
                                           {"1.5e1", 15.0},
                                           {"1.5E+01", 15.0},
                                           {"1.5d1", 15.0},
                                           {"-1.5D-01", -0.15},
                                           {"1e-310", 1e-310},
                                           {"1000000", 1e6}}));
  CAPTURE(good.text);
  const std::string record = std::string("ATOM 1 N ASN A 1 ") + good.text + " 2.5 3.5 0.5 1.5";
  CHECK(parse_pqr(record, "f.pqr").atoms.at(0).x == good.value);
}

TEST_CASE("parse_pqr refuses what is no number") {
  const std::string bad = GENERATE("1,5", "1.5x", "0x10", "--1.5", "+-1.5", "-+1.5", "+", "-", ".", "1.5e", "1.5D",
                                   "1.5DD1", "1.5D1e1", "1e400", "1D400", "-1e400", "nan", "-nan", "NaN", "nan(7)",
                                   "inf", "-Infinity", "1.#IND", "1.#QNAN", "******", "1.5.5", "1_000",
                                   "\xe2\x88\x92"
                                   "1.5",
                                   "1.5\xc2\xa0", "N/A");
  CAPTURE(bad);
  const std::string head = "ATOM 1 N ASN A 1 ";
  CHECK_THAT(error_of(head + bad + " 2.5 3.5 0.5 1.5"),
             ContainsSubstring("f.pqr:1: expected x (A) as a finite number"));
  CHECK_THAT(error_of(head + "1.5 2.5 3.5 " + bad + " 1.5"), ContainsSubstring("f.pqr:1: expected a charge"));
  CHECK_THAT(error_of(head + "1.5 2.5 3.5 0.5 " + bad), ContainsSubstring("f.pqr:1: expected "));
}

TEST_CASE("parse_pqr names the ranges that it holds numbers to") {
  const std::string head = "ATOM 1 N ASN A 1 ";
  CHECK_THAT(error_of(head + "1000001 0.0 0.0 0.0 1.0"),
             ContainsSubstring("expected x (A) within +-1e+06, got '1000001'"));
  CHECK_THAT(error_of(head + "0.0 0.0 -1e7 0.0 1.0"), ContainsSubstring("expected z (A) within +-1e+06, got '-1e7'"));
  CHECK_THAT(error_of(head + "0.0 0.0 0.0 0.0 -0.001"), ContainsSubstring("expected a radius >= 0 (A), got '-0.001'"));
  CHECK_THAT(error_of(head + "0.0 0.0 0.0 0.0 100001"),
             ContainsSubstring("expected a radius <= 1e+05 (A), got '100001'"));
  CHECK(parse_pqr(head + "-1e6 1e6 0 0 0", "f.pqr").atoms.at(0).radius == 0.0);
}

TEST_CASE("parse_pqr accepts a large sphere and warns of it") {
  const std::string radius = GENERATE("35", "1000", "35.00");
  const AtomFile file = parse_pqr("ATOM 1 C SPH 1 0.000 0.000 0.000 1.00 " + radius, "f.pqr");
  CHECK(file.atoms.at(0).radius == std::stod(radius));
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0] ==
        "f.pqr:1: radius " + radius.substr(0, radius.find('.')) + " A is larger than 10 A: is it meant?");
}

TEST_CASE("parse_pqr counts large radii in one warning") {
  std::string text;
  for (int i = 0; i < 100; ++i) {
    text += "ATOM 1 C SPH 1 0.0 0.0 0.0 0.0 " + std::to_string(i) + ".5\n";
  }
  const AtomFile file = parse_pqr(text, "f.pqr");
  REQUIRE(file.atoms.size() == 100);
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0] ==
        "f.pqr:11: radius 10.5 A is larger than 10 A: is it meant? (90 radii are, the largest 99.5 A in line 100)");
}

TEST_CASE("parse_pqr knows a PDB file by all its records") {
  const std::string message = "look like occupancy and B-factor";
  CHECK_THAT(error_of(pdb_records(20, 5, "")), ContainsSubstring(message));
  CHECK_THAT(error_of(pdb_records(4, 20, "")), ContainsSubstring(message));
  CHECK_THAT(error_of(pdb_records(8, 1, kElement)), ContainsSubstring(message));
  CHECK_THAT(error_of("REMARK\n" + pdb_records(20, 5, kElement)), ContainsSubstring("f.pqr:2: expected charge"));
  CHECK_THAT(error_of(pdb_records(20, 90, kElement)), ContainsSubstring("f.pqr:11: expected serial"));
  for (const int first_b : {5, 90}) {
    CHECK_THAT(error_of(pdb_records(20, first_b, kElement)), ContainsSubstring("is it a PDB file? pdb2pqr gives it"));
    CHECK_THAT(error_of(pdb_records(20, first_b, kElement)),
               ContainsSubstring("or read it with --input-format pdb and --radii"));
  }
}

TEST_CASE("parse_pqr takes no PQR file for a PDB file") {
  CHECK(parse_pqr(pdb_records(3, 20, ""), "f.pqr").atoms.size() == 3);  // three spheres made by hand
  CHECK(parse_pqr(pdb_records(5, 1, ""), "f.pqr").atoms.size() == 5);   // radii of atoms, no element
  std::string negative = pdb_records(20, 5, kElement);
  negative.replace(negative.find("  1.00"), 6, " -1.00");
  CHECK(parse_pqr(negative, "f.pqr").atoms.size() == 20);  // no occupancy is negative
}

TEST_CASE("parse_pqr ends the first model at ENDMDL or at the next MODEL") {
  const std::string atom = "ATOM 1 N ASN 1" + kNumbers + "\n";
  const AtomFile two = parse_pqr("MODEL 1\n" + atom + "MODEL 2\n" + atom + atom + "ENDMDL\n", "f.pqr");
  CHECK(two.atoms.size() == 1);
  REQUIRE(two.warnings.size() == 1);
  CHECK(two.warnings[0] == "f.pqr:3: the first model ends here; left out 2 atoms of other models");

  const AtomFile one = parse_pqr("model 1\nendmdl\n" + atom + "MODEL 2\n" + atom + "ENDMDL\nEND\n", "f.pqr");
  CHECK(one.atoms.size() == 1);
  CHECK(parse_pqr("MODEL 1\n" + atom + "ENDMDL\nMASTER\nEND\n", "f.pqr").warnings.empty());
}

TEST_CASE("parse_pqr counts one as one") {
  const std::string atom = "ATOM 1 N ASN 1" + kNumbers + "\n";
  CHECK(parse_pqr(atom + "END\nATOM 1 O HOH 2" + kNumbers + "\n", "f.pqr").warnings.at(0) ==
        "f.pqr:2: END is followed by 1 atom that is read too");
  CHECK(parse_pqr(atom + "TOM\n", "f.pqr").warnings.at(0) ==
        "f.pqr:2: skipped 1 line of no known record, the first 'TOM'");
}

TEST_CASE("parse_pqr refuses frames and copies behind END") {
  const auto atoms = [](const std::string& first, const std::string& numbers) {
    return "ATOM 1 N " + first + numbers + "\nATOM 2 CA ASN 1" + numbers + "\n";
  };
  const std::string elsewhere = " 9.25 -2.5 3.75 -0.5 1.5";
  const std::string frame = atoms("ASN 1", kNumbers);
  CHECK(error_of(frame + "END\n" + frame) ==
        "f.pqr:4: expected other atoms behind END in line 3 than those before it, got 'ATOM 1 N ASN 1 1.25 -2.5 3.75 "
        "-0.5 1.5' and so on, as before; keep one of the frames or copies, or if all are to be one molecule, take END "
        "out");
  const std::string moved = atoms("ASN 1", elsewhere);
  CHECK_THAT(error_of(frame + "END\n" + moved + "END\n" + moved + "END\n"), ContainsSubstring("f.pqr:4: "));
  // Chains of a complex that begin alike, and what is joined with it, are one molecule.
  const std::string others = GENERATE_COPY(atoms("GLY 1", elsewhere), "ATOM 1 N ASN 1" + elsewhere + "\n",
                                           moved + "ATOM 3 C ASN 1" + elsewhere + "\n");
  CAPTURE(others);
  const AtomFile file = parse_pqr(frame + "END\n" + others + "END\n", "f.pqr");
  CHECK(file.atoms.size() > 2);
  REQUIRE(file.warnings.size() == 1);
  CHECK_THAT(file.warnings[0], ContainsSubstring("f.pqr:3: END is followed by "));
  CHECK(parse_pqr(frame + moved + "END\n", "f.pqr").atoms.size() == 4);
}

TEST_CASE("parse_pqr keeps names where they are asked for") {
  struct Case {
    const char* leading;
    AtomName name;
  };
  const Case good = GENERATE(values<Case>({
      {"ATOM 1 N ASN 12", {"N", "ASN", "", "12"}},
      {"HETATM99941 N ASN A -5", {"N", "ASN", "A", "-5"}},
      {"ATOM ***** N ASN A1001B", {"N", "ASN", "A", "1001B"}},
      {"ATOM 1 N ASN A-5", {"N", "ASN", "A", "-5"}},
      {"ATOM 1 N ASN A 12 B", {"N", "ASN", "A", "12B"}},
      {"ATOM 1 N ASN 12 B", {"N", "ASN", "", "12B"}},
      {"ATOM 1 P A 1 12", {"P", "A", "1", "12"}},
      {"ATOM 1 N A ASN B 12", {"N", "ASN", "B", "12"}},
      {"ATOM 1 N A ASN 12", {"N", "ASN", "", "12"}},
      {"ATOM 1 HD11LEU 2", {"HD11", "LEU", "", "2"}},
      {"ATOM 1 HD11LEU A1002", {"HD11", "LEU", "A", "1002"}},
      {"ATOM 1 HD11ALEU A 2", {"HD11", "ALEU", "A", "2"}},
      {"ATOM 1 HO5'1 A 2", {"HO5'1", "A", "", "2"}},
      {"ATOM      1  N   ASN A  12    -158.901-245.8731049.445  0.1801 1.8240", {"N", "ASN", "A", "12"}},
      {"ATOM      1  N                -158.901-245.8731049.445  0.1801 1.8240", {}},
  }));
  CAPTURE(good.leading);
  const std::string record = good.leading;
  const std::string text = record.ends_with("1.8240") ? record : record + kNumbers;
  const AtomFile file = parse_pqr(text, "f.pqr", AtomNames::kKeep);
  REQUIRE(file.names.size() == 1);
  CHECK(file.names[0].name == good.name.name);
  CHECK(file.names[0].residue == good.name.residue);
  CHECK(file.names[0].chain == good.name.chain);
  CHECK(file.names[0].number == good.name.number);
  CHECK(parse_pqr(text, "f.pqr").names.empty());
}

TEST_CASE("parse_pqr warns of lines that it skips") {
  const std::string atom = "ATOM 1 N ASN 1" + kNumbers + "\n";
  const AtomFile file = parse_pqr("ATOMS 1\n" + atom + "TOM 2\nCONECT12345\n#\nter\n", "f.pqr");
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0] == "f.pqr:1: skipped 2 lines of no known record, the first 'ATOMS 1'");
}

TEST_CASE("parse_pqr refuses other formats") {
  CHECK_THAT(error_of("\n <pqr>\n"), ContainsSubstring("f.pqr:2: expected PQR records, got '<pqr>'; PQR-XML"));
  CHECK_THAT(error_of("data_1ABC\n#\n"),
             ContainsSubstring("mmCIF is read from files named .cif, or with --input-format mmcif, and --radii"));
  CHECK_THAT(error_of("1.0 2.0 3.0 4.0\n"),
             ContainsSubstring("XYZR, lines of x y z radius, PDB and mmCIF, from files named .xyzr, .pdb or .cif"));
  CHECK_THAT(error_of("\xfe\xff"), ContainsSubstring("UTF-16"));
}

TEST_CASE("parse_pqr counts lines of any ending") {
  const std::string end = GENERATE("\n", "\r\n", "\r");
  const std::string atom = "ATOM 1 N ASN 1" + kNumbers + end;
  CHECK_THAT(error_of(atom + end + atom + "ATOM" + end + atom), ContainsSubstring("f.pqr:4: "));
  CHECK(parse_pqr(end + atom + end + end + atom, "f.pqr").atoms.size() == 2);
  CHECK_THAT(error_of(atom + "ATOM 2 C"), ContainsSubstring("got 'ATOM 2 C'; the file ends here, is it cut off?"));
  CHECK_THAT(error_of(atom + "ATOM 2 C" + end), !ContainsSubstring("cut off"));
}

TEST_CASE("parse_pqr quotes no control characters and no long lines") {
  const std::string message = error_of("ATOM \x1b[31m " + std::string(1000, 'y') + "\n");
  CHECK_THAT(message, ContainsSubstring("'ATOM \\x1b[31m yyy"));
  CHECK_THAT(message, ContainsSubstring("yyy...'"));
  CHECK(message.size() < 300);
}

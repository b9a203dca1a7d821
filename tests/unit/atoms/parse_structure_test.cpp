#include <cstdio>
#include <fstream>
#include <sstream>

#include "atoms/pdb_element.h"
#include "atoms/radii.h"
#include "atoms/residue_names.h"
#include "catch2.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_atoms.h"
#include "support/folder.h"

using namespace gaussmesh;
using Catch::Matchers::ContainsSubstring;

namespace {

/// One atom of a PQR file, with its names.
struct NamedAtom {
  std::string name, residue, number;
  Atom atom;
  char alternate = '.';  // of mmCIF
};

/// What element_of_name() is to find.
struct KnownElement {
  const char* name;  // columns 13-16
  const char* residue;
  const char* element;
};

void check_element(const KnownElement& known) {
  CAPTURE(known.name, known.residue);
  CHECK(element_of_name(known.name, known.residue) == known.element);
}

std::vector<NamedAtom> read_named(const std::string& file) {
  std::ifstream input(std::string(GAUSSMESH_DATA) + "/" + file);
  std::vector<NamedAtom> atoms;
  for (std::string line; std::getline(input, line);) {
    std::istringstream words(line);
    std::string record, serial, chain;
    NamedAtom a;
    if (!(words >> record >> serial >> a.name >> a.residue >> chain >> a.number) || record != "ATOM") continue;
    words >> a.atom.x >> a.atom.y >> a.atom.z >> a.atom.charge >> a.atom.radius;
    atoms.push_back(a);
  }
  return atoms;
}

std::string pdb_line(const NamedAtom& a, char alternate = ' ', const char* record = "ATOM  ") {
  char line[100];
  std::snprintf(line, sizeof line, "%s%5d %-4s%c%3s A%4s    %8.3f%8.3f%8.3f  1.00 10.00          %2c\n", record, 1,
                (a.name.size() > 3 ? a.name : " " + a.name).c_str(), alternate, a.residue.c_str(), a.number.c_str(),
                a.atom.x, a.atom.y, a.atom.z, a.name[0]);
  return line;
}

std::string mmcif_text(const std::vector<NamedAtom>& atoms) {
  std::ostringstream text;
  text << "data_TEST\n#\nloop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
          "_atom_site.label_alt_id\n_atom_site.label_comp_id\n_atom_site.label_asym_id\n_atom_site.auth_seq_id\n"
          "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n";
  for (const NamedAtom& a : atoms)
    text << "ATOM " << a.name[0] << " \"" << a.name << "\" " << a.alternate << " " << a.residue << " A " << a.number
         << " " << a.atom.x << " " << a.atom.y << " " << a.atom.z << "\n";
  return text.str();
}

std::string error_of(const std::string& text, const std::string& radii = "bondi") {
  try {
    parse_pdb(text, "a.pdb", radii);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// What stands between the first atom without a radius and the lines for all of them.
const std::string kMissing =
    "; take them out, use other radii, or write a radius (A) for each '?' of these lines and give them with "
    "--radii-file:";

const NamedAtom kCarbon = {"CA", "GLY", "7", {1.5, -2.25, 3.125, 0, 0}};

}  // namespace

TEST_CASE("AMBER radii are those that PDB2PQR gives, but at the ends of chains") {
  for (const char* file : {"1ubq.pqr", "1crn.pqr", "3icb.pqr"}) {
    const std::vector<NamedAtom> wanted = read_named(file);
    REQUIRE(wanted.size() > 600);
    std::string pdb;
    for (const NamedAtom& a : wanted) pdb += pdb_line(a);
    for (const AtomFile& got : {parse_pdb(pdb, "a.pdb", "amber"), parse_mmcif(mmcif_text(wanted), "a.cif", "amber")}) {
      REQUIRE(got.atoms.size() == wanted.size());
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        CAPTURE(file, i, wanted[i].residue, wanted[i].name);
        CHECK(got.atoms[i].x == wanted[i].atom.x);
        CHECK(got.atoms[i].y == wanted[i].atom.y);
        CHECK(got.atoms[i].z == wanted[i].atom.z);
        if (wanted[i].number != wanted.front().number) CHECK(got.atoms[i].radius == wanted[i].atom.radius);
      }
    }
  }
}

TEST_CASE("sets of radii") {
  const RadiusSet bondi("bondi"), amber("amber"), charmm("charmm");
  CHECK(bondi.find("ALA", "CA", "C") == 1.70);
  CHECK(bondi.find("ZZZ", "CL1", "Cl") == 1.75);
  CHECK(bondi.find("HOH", "D1", "D") == 1.20);
  CHECK(bondi.find("CA", "CA", "Ca") == 2.31);  // of Mantina et al., as is the next
  CHECK(bondi.find("LIG", "B1", "B") == 1.92);
  CHECK(bondi.find("LIG", "BR1", "BR") == 1.85);  // not theirs where Bondi has one
  CHECK_FALSE(bondi.find("HEM", "FE", "FE"));
  CHECK(amber.find("SER", "OG", "O") == 1.721);
  CHECK(amber.find("DT", "C7", "C") == 1.908);
  CHECK_FALSE(amber.find("HEM", "CHA", "C"));
  CHECK(charmm.find("ALA", "CA", "C") == 2.275);
  CHECK(charmm.find("ILE", "CD1", "C") == 2.06);
  CHECK(charmm.find("A", "H2'", "H") == 1.32);
  CHECK(charmm.find("A", "HO2'", "H") == 0.2245);
  CHECK_THROWS_AS(RadiusSet("bondy"), OptionError);
}

TEST_CASE("names of other programs have the radii of those that they stand for") {
  for (const char* set : {"amber", "charmm"}) {
    const RadiusSet radii(set);
    const auto same = [&](const char* residue, const char* atom, const char* in_residue, const char* as_atom) {
      CAPTURE(set, residue, atom);
      REQUIRE(radii.find(in_residue, as_atom, ""));
      CHECK(radii.find(residue, atom, "") == radii.find(in_residue, as_atom, ""));
    };
    for (const char* name : {"HID", "HIE", "HIP", "HSD", "HSE", "HSP", "hid"}) same(name, "HE1", "HIS", "HE1");
    for (const char* name : {"CYX", "CYM"}) same(name, "SG", "CYS", "SG");
    same("ASH", "HD2", "ASP", "HD2");
    same("GLH", "HE2", "GLU", "HE2");
    same("LYN", "HZ2", "LYS", "HZ2");
    same("MSE", "SE", "MET", "SD");
    same("MSE", "CE", "MET", "CE");
    same("HSD", "HN", "HIS", "H");
    same("ALA", "OT1", "ALA", "O");
    same("ALA", "OT2", "ALA", "OXT");
    same("DA", "O1P", "DA", "OP1");
    same("U", "O2P", "U", "OP2");
    CHECK_FALSE(radii.find("ALA", "SE", ""));
    CHECK_FALSE(radii.find("LIG", "HN", ""));
  }
}

TEST_CASE("water has many names, which are not all its own") {
  for (const char* residue : {"HOH", "WAT", "DOD", "H2O", "TIP", "TIP3", "SOL", "SPC", "T3P", "TP3", "tip3"})
    for (const char* atom : {"O", "OW", "OH2", "H1", "H2", "HW1"}) {
      CAPTURE(residue, atom);
      CHECK(is_water(residue, atom));
    }
  CHECK(is_water("HOH", "D1"));
  CHECK_FALSE(is_water("T3P", "P"));
  CHECK_FALSE(is_water("GLY", "O"));
}

TEST_CASE("elements are in columns 77-78, or in the name") {
  NamedAtom calcium = {"CA", "GLY", "1", {}};
  std::string line = pdb_line(calcium);
  CHECK(parse_pdb(line.substr(0, 66), "a.pdb", "bondi").atoms[0].radius == 1.70);  // " CA": a carbon
  line.replace(12, 4, "ZN  ");
  CHECK(parse_pdb(line.substr(0, 66), "a.pdb", "bondi").atoms[0].radius == 1.39);
  line.replace(12, 4, "HG11");
  CHECK(parse_pdb(line.substr(0, 66), "a.pdb", "bondi").atoms[0].radius == 1.20);
  line.replace(12, 4, "1HG1");
  CHECK(parse_pdb(line.substr(0, 66), "a.pdb", "bondi").atoms[0].radius == 1.20);
}

TEST_CASE("line numbers of old files are no elements") {
  const std::string line = pdb_line({"CA", "ASN", "103", {}}).substr(0, 66) + "      ";
  CHECK(parse_pdb(line + "7LYZN  9", "a.pdb", "bondi").atoms[0].radius == 1.70);
  CHECK(parse_pdb(line + "7LYZG 10", "a.pdb", "bondi").atoms[0].radius == 1.70);
  CHECK(parse_pdb(line + "7LYZO123", "a.pdb", "bondi").atoms[0].radius == 1.70);
  CHECK(parse_pdb(line + "7LYZ 123", "a.pdb", "bondi").atoms[0].radius == 1.70);
  CHECK(parse_pdb(line + "7LYZN   ", "a.pdb", "bondi").atoms[0].radius == 1.55);  // a segment, and the element
  CHECK(parse_pdb(line + "7LYZ N1-", "a.pdb", "bondi").atoms[0].radius == 1.55);
  CHECK(parse_pdb(line + "PROAN  9", "a.pdb", "bondi").atoms[0].radius == 1.55);
}

TEST_CASE("PDBQT has its types of atoms in columns 78-79") {
  const std::string line = pdb_line({"C1", "LIG", "1", {}}).substr(0, 66) + "    -0.085 ";
  CHECK(parse_pdb(line + "A ", "a.pdb", "bondi").atoms[0].radius == 1.70);
  CHECK(parse_pdb(line + "Cl", "a.pdb", "bondi").atoms[0].radius == 1.75);
  CHECK(parse_pdb(line + "NA", "a.pdb", "bondi").atoms[0].radius == 1.55);
  CHECK(parse_pdb(line + "OA", "a.pdb", "bondi").atoms[0].radius == 1.52);
  CHECK(parse_pdb(line + "HD", "a.pdb", "bondi").atoms[0].radius == 1.20);
  CHECK(parse_pdb(line + "S", "a.pdb", "bondi").atoms[0].radius == 1.80);
}

TEST_CASE("a crystallographic CIF is told from mmCIF") {
  const std::string text = "data_x\nloop_\n_atom_site_label\n_atom_site_fract_x\nC1 0.5\n";
  CHECK_THROWS_WITH(parse_mmcif(text, "a.cif", "bondi"),
                    ContainsSubstring("a.cif:2: ") && ContainsSubstring("got _atom_site_* of cryst"));
}

TEST_CASE("elements are known from names, or not at all") {
  const KnownElement known = GENERATE(values<KnownElement>({
      {"CA  ", "GLY", "C"},  {" CA ", "GLY", "C"},  {"NE  ", "ARG", "N"},  {"CD  ", "PRO", "C"}, {"HG  ", "SER", "H"},
      {"CE  ", "lys", "C"},  {"ne2 ", "HIE", "N"},  {"HG11", "VAL", "H"},  {"1HG1", "VAL", "H"}, {"OXT ", "ALA", "O"},
      {"SD  ", "MET", "S"},  {"SE  ", "MSE", "SE"}, {"SE  ", "MET", "SE"}, {"D   ", "ALA", "D"}, {"P   ", "DA", "P"},
      {"OP1 ", "U", "O"},    {"ZN  ", "GLY", "ZN"}, {"ZN  ", "ZN", "ZN"},  {"CA  ", "CA", "CA"}, {" CA ", "LIG", "C"},
      {"CL  ", "LIG", "CL"}, {"CL12", "LIG", "CL"}, {"C1  ", "LIG", "C"},  {" C1 ", "LIG", "C"}, {"C10A", "LIG", "C"},
      {"FE  ", "HEM", "FE"}, {"BR1 ", "LIG", "BR"}, {"HG  ", "HG", "HG"},  {"NA  ", "NA", "NA"}, {"K   ", "K", "K"},
      {"HA  ", "LIG", "H"},  {"HE21", "LIG", "H"},  {"1H  ", "LIG", "H"},  {"CX  ", "LIG", "C"}, {"CA  ", "LIG", ""},
      {"NE  ", "LIG", ""},   {"CD1 ", "LIG", ""},   {"HG  ", "LIG", ""},   {"NA  ", "HEM", ""},  {"12  ", "LIG", ""},
      {"NH1 ", "LIG", "N"},  {"    ", "LIG", ""},   {"XX  ", "LIG", ""},   {"QA  ", "GLY", ""},
  }));
  check_element(known);
}

TEST_CASE("ions are known in whatever columns by the name of their residue") {
  const KnownElement known = GENERATE(values<KnownElement>({
      {" CL ", "CL", "CL"},  {" CL ", "CL-", "CL"}, {"CL- ", "CL-", "CL"}, {" CA ", "CA", "CA"},  {" CA ", "CA2", "CA"},
      {" NA ", "NA", "NA"},  {" NA ", "NA+", "NA"}, {" NA+", "NA+", "NA"}, {" na ", "Na", "NA"},  {" CD ", "CD", "CD"},
      {" CO ", "3CO", "CO"}, {" CS ", "CS", "CS"},  {" CU ", "CU1", "CU"}, {" NI ", "NI", "NI"},  {" HG ", "HG", "HG"},
      {" BR ", "BR", "BR"},  {" MG ", "MG", "MG"},  {" ZN ", "ZN2", "ZN"}, {"ZN  ", "ZN", "ZN"},  {" SOD", "SOD", "NA"},
      {"SOD ", "SOD", "NA"}, {" NA ", "SOD", "NA"}, {" CLA", "CLA", "CL"}, {" CAL", "CAL", "CA"}, {"POT ", "POT", "K"},
      {" CES", "CES", "CS"}, {"RUB ", "RUB", "RB"}, {" CA ", "ALA", "C"},  {" NA ", "HEM", "N"},  {" CA ", "LIG", "C"},
      {" CD ", "CA", "C"},   {" MG ", "CLA", "M"},  {" CA ", "CAN", "C"},  {" C  ", "C", "C"},    {" K  ", "K", "K"},
      {" N  ", "NA", "N"},   {" H2 ", "H2", "H"},   {"    ", "", ""},      {" 12 ", "12", ""},
  }));
  check_element(known);
}

TEST_CASE("where the element stays open there is an error, but for radii that do without") {
  std::string line = pdb_line(kCarbon).substr(0, 66);
  line.replace(12, 4, "CA  ");
  CHECK(parse_pdb(line, "a.pdb", "bondi").atoms[0].radius == 1.70);
  line.replace(17, 3, "LIG");
  CHECK(error_of(line) ==
        "a.pdb:1: expected atoms that the radii 'bondi' know, got atom CA of residue LIG A 7, no element in columns "
        "77-78" +
            kMissing + "\nLIG CA ?  # 1 atom, first a.pdb:1");
  line.replace(17, 3, "GLY");
  line.replace(12, 4, "CA  ");
  CHECK(parse_pdb(line, "a.pdb", "amber").atoms[0].radius == 1.908);
}

TEST_CASE("atom records are read whatever their case, indent and serial number") {
  const std::string line = pdb_line(kCarbon);
  const std::string rest = line.substr(11);   // from the blank behind the serial number
  const std::string names = line.substr(12);  // from the name on
  const std::string record = GENERATE_COPY(
      "atom      1" + rest, "Atom      1" + rest, "hetatm    1" + rest, " ATOM      1" + rest, "   HETATM    1" + rest,
      "ATOM 100000" + rest, "ATOM1000000" + rest, "ATOM  100000" + names, "HETATM100000" + names, "ATOM  100000" + rest,
      "HETATM1000000" + rest, "ATOM  *****" + rest, "ATOM  A000F" + rest, "HETATM    1" + rest);
  const AtomFile file = parse_pdb("REMARK\n" + record, "a.pdb", "bondi");
  CAPTURE(record);
  REQUIRE(file.atoms.size() == 1);
  CHECK(file.atoms[0].x == 1.5);
  CHECK(file.atoms[0].y == -2.25);
  CHECK(file.atoms[0].z == 3.125);
  CHECK(file.atoms[0].radius == 1.70);
}

TEST_CASE("atom records that their columns do not settle name the line") {
  const std::string line = pdb_line(kCarbon);
  const std::string record = GENERATE_COPY(
      "ATOM\t    2" + line.substr(11), "ATOM\t2\tCA\tGLY\tA\t7\t1.5\t-2.25\t3.125\n",
      "ATOM 2 CA GLY A 7 1.5 -2.25 3.125 1.00 10.00 C\n", " ATOM 2 CA GLY A 7 1.5 -2.25 3.125\n", "ATOM\n",
      "ATOM 2 CA GLY A   7         " + line.substr(28), "ATOMS     1" + line.substr(11), "ATOM  " + line);
  CAPTURE(record);
  CHECK_THAT(error_of("REMARK\n" + line + record + line), ContainsSubstring("a.pdb:3: expected a"));
}

TEST_CASE("a coordinate that goes on beyond its columns is not cut") {
  std::string line = pdb_line(kCarbon);
  line.replace(29, 9, "-1000.125");
  CHECK_THAT(error_of(line), ContainsSubstring("a.pdb:1: expected a coordinate (A) in columns 31-38, got '-1000.125'"));
  line.replace(29, 26, "    11.1041116.1341116.504");  // moved by one
  CHECK_THAT(error_of(line), ContainsSubstring("a.pdb:1: expected a coordinate (A) in columns 31-38"));
}

TEST_CASE("the first model, the first of alternate locations, and no water") {
  NamedAtom other = kCarbon, water = kCarbon, next = kCarbon;
  other.atom.x = 9.0;
  water.residue = "HOH";
  next.number = "8";
  next.atom.x = 4.0;
  const std::string text = "MODEL        1\n" + pdb_line(kCarbon, 'A') + pdb_line(other, 'B') + pdb_line(next, 'B') +
                           pdb_line(water, ' ', "HETATM") + "ENDMDL\nMODEL        2\n" + pdb_line(other) + "ENDMDL\n";
  const AtomFile file = parse_pdb(text, "a.pdb", "bondi");
  REQUIRE(file.atoms.size() == 2);
  CHECK(file.atoms[0].x == 1.5);
  CHECK(file.atoms[1].x == 4.0);
  REQUIRE(file.warnings.size() == 3);
  CHECK(file.warnings[0] == "a.pdb: left out 1 atom of models other than the first, which ends in line 6");
  CHECK(file.warnings[1] == "a.pdb: left out 1 atom of water");
  CHECK(file.warnings[2] == "a.pdb: left out 1 atom at alternate locations other than the first");
}

namespace {

/// The atom of a text such as `CB A GLY 8`, of which residue and number may be left out; at a location `.` it has none.
NamedAtom located_atom(const std::string& text, std::size_t index) {
  std::istringstream words(text);
  NamedAtom atom = {"", "GLY", "1", {static_cast<double>(index), 0.0, 0.0, 0.0, 0.0}};
  words >> atom.name >> atom.alternate >> atom.residue >> atom.number;
  return atom;
}

/// The places in `atoms` of those that are read, the same from PDB and mmCIF.
std::vector<int> places_taken(const std::vector<std::string>& atoms) {
  std::vector<NamedAtom> named;
  std::string pdb;
  for (const std::string& text : atoms) {
    named.push_back(located_atom(text, named.size()));
    pdb += pdb_line(named.back(), named.back().alternate == '.' ? ' ' : named.back().alternate);
  }
  std::vector<std::vector<int>> places;
  for (const AtomFile& file : {parse_pdb(pdb, "a", "bondi", {}, AtomNames::kKeep),
                               parse_mmcif(mmcif_text(named), "a", "bondi", {}, AtomNames::kKeep)}) {
    const std::size_t left_out = atoms.size() - file.atoms.size();
    CHECK(file.warnings.size() == (left_out > 0 ? 1 : 0));
    if (left_out > 0) CHECK_THAT(file.warnings.at(0), ContainsSubstring("out " + std::to_string(left_out) + " atom"));
    places.emplace_back();
    REQUIRE(file.names.size() == file.atoms.size());
    REQUIRE(file.lines.size() == file.atoms.size());
    for (std::size_t i = 0; i < file.atoms.size(); ++i) {
      const int place = static_cast<int>(file.atoms[i].x);
      places.back().push_back(place);
      CHECK(file.names[i].name == named.at(place).name);
      CHECK(file.lines[i] == static_cast<std::size_t>(place) + 1);
    }
  }
  CHECK(places[0] == places[1]);
  return places[0];
}

using Places = std::vector<int>;

}  // namespace

TEST_CASE("atoms of a residue are at the location that comes first in it, if they have that") {
  CHECK(places_taken({"N .", "CB A", "CB B", "OG B", "OG A"}) == Places{0, 1, 4});
  CHECK(places_taken({"N .", "CB B", "OG B", "CB A", "OG A"}) == Places{0, 1, 2});
  CHECK(places_taken({"CB A", "CB B", "CB B GLY 2", "CB A GLY 2"}) == Places{0, 2});
  CHECK(places_taken({"C A", "C A", "C B", "C B"}) == Places{0, 1});  // a ligand without numbers in its names
}

TEST_CASE("an atom that is not at the first location of its residue keeps the first that it has") {
  CHECK(places_taken({"N .", "CB A", "CB B", "O C", "O D"}) == Places{0, 1, 3});
  CHECK(places_taken({"N .", "CB A", "CG A", "CB B", "O B"}) == Places{0, 1, 2, 4});
  CHECK(places_taken({"CB A", "CB B", "H B", "O B", "O C", "N D", "N C"}) == Places{0, 2, 4, 6});
}

TEST_CASE("of an atom without a location and the same with one, the first is taken") {
  CHECK(places_taken({"CA .", "CZ .", "CZ B", "NH1 A", "NH1 B", "NH2 B", "NH2 A"}) == Places{0, 1, 3, 6});
  CHECK(places_taken({"CZ B", "CZ .", "N A", "N B"}) == Places{0, 3});
  CHECK(places_taken({"CB A", "CB B", "CZ .", "CZ A", "O .", "O B"}) == Places{0, 3, 4});
  CHECK(places_taken({"CB .", "CB .", "N ."}) == Places{0, 1, 2});  // not through locations
}

TEST_CASE("of a residue that is of two kinds, the first is taken") {
  CHECK(places_taken({"N A PRO", "CD A PRO", "N B SER", "OG B SER", "N . ALA 2"}) == Places{0, 1, 4});
  CHECK(places_taken({"N A PRO", "N B SER", "CD A PRO", "OG B SER", "O ."}) == Places{0, 2, 4});
  CHECK(places_taken({"N . SER", "OG . SER", "N B THR", "CG2 B THR"}) == Places{0, 1});
  CHECK(places_taken({"N A SER", "N B SER", "N C THR", "OG B SER", "OG C THR"}) == Places{0, 3});
}

TEST_CASE("locations that stand apart in the file belong together, but not those of other residues of one number") {
  CHECK(places_taken({"N .", "CB A", "N . ALA 2", "CB B", "CB B ALA 2"}) == Places{0, 1, 2, 4});
  CHECK(places_taken({"N .", "CZ .", "N . ALA 2", "CZ B"}) == Places{0, 1, 2});
  CHECK(places_taken({"N .", "CB A", "CB B", "N . ALA 2", "N . SER", "CB A SER", "CB B SER"}) == Places{0, 1, 3, 4, 5});
  CHECK(places_taken({"N A", "N B", "N . ALA 2", "N A SER", "N B SER"}) == Places{0, 2, 3});
}

TEST_CASE("an atom at a location that is left out needs no radius") {
  const NamedAtom iron = {"CA", "GLY", "7", {}};
  std::string other = pdb_line(iron, 'B');
  other.replace(other.size() - 3, 2, "XX");
  CHECK(error_of(pdb_line(iron, 'A') + other) == "no error");
  CHECK_THAT(error_of(other + pdb_line(iron, 'C')), ContainsSubstring("a.pdb:1: expected atoms that the radii"));
}

TEST_CASE("frames are models, however they are parted") {
  NamedAtom other = kCarbon;
  other.atom.x = 9.0;
  const std::string first = pdb_line(kCarbon), second = pdb_line(other) + pdb_line(other);
  const std::string text = GENERATE_COPY(
      "TITLE\n" + first + "END\n" + second + "END\n", "MODEL 1\n" + first + "ENDMDL\nMODEL 1\n" + second + "ENDMDL\n",
      "TITLE\n" + first + "ENDMDL\n" + second + "ENDMDL\nEND\n", "MODEL 1\n" + first + "MODEL 2\n" + second + "END\n",
      "model 1\n" + first + "end\n" + second, "ENDMDL\n" + first + "ENDMDL\n" + second);
  CAPTURE(text);
  const AtomFile file = parse_pdb(text, "a.pdb", "bondi");
  REQUIRE(file.atoms.size() == 1);
  CHECK(file.atoms[0].x == 1.5);
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0] == "a.pdb: left out 2 atoms of models other than the first, which ends in line 3");
}

TEST_CASE("other atoms behind END are not lost") {
  NamedAtom other = kCarbon;
  other.number = "8";
  const std::string first = pdb_line(kCarbon), second = pdb_line(other);
  CHECK(error_of(first + "END\n" + first + second) ==
        "a.pdb:4: expected no atoms behind END in line 2 but those before it again, got '" +
            second.substr(0, second.size() - 1) + "'; if all are to be one molecule, take END out");
  CHECK_THAT(error_of("MODEL 1\n" + first + "ENDMDL\nEND\nMODEL 1\n" + second + "ENDMDL\nEND\n"),
             ContainsSubstring("a.pdb:6: expected no atoms behind END in line 4"));
  CHECK(error_of(second + first + "END\n" + first + second + "END\n" + first + second + "END\n") == "no error");
}

TEST_CASE("lines that are no records of PDB are told") {
  const std::string line = pdb_line(kCarbon);
  CHECK(parse_pdb("REMARK\nREMRAK\n" + line + "ENDS\n", "a.pdb", "bondi").warnings ==
        std::vector<std::string>{"a.pdb:2: skipped 2 lines of no known record, the first 'REMRAK'"});
  CHECK_THAT(error_of("data_1ABC\n" + line),
             ContainsSubstring("a.pdb:1: expected PDB records, got 'data_1ABC'; mmCIF"));
  CHECK_THAT(error_of("<!DOCTYPE html>\n"), ContainsSubstring("web pages"));
}

TEST_CASE("one model may have several chains, and an end") {
  const std::string line = pdb_line(kCarbon);
  const std::string text = GENERATE_COPY(line + "TER\n" + line + "END\n", line + line + "ENDMDL\nMASTER\nEND   \n",
                                         "MODEL 1\nENDMDL\nMODEL 2\n" + line + "TER\n" + line + "ENDMDL\nEND\n");
  const AtomFile file = parse_pdb(text, "a.pdb", "bondi");
  CHECK(file.atoms.size() == 2);
  CHECK(file.warnings.empty());
}

TEST_CASE("what is no structure names the line") {
  std::string line = pdb_line(kCarbon);
  CHECK_THAT(error_of(""), ContainsSubstring("a.pdb: expected atoms, got none"));
  CHECK_THAT(error_of("HEADER\n" + line.substr(0, 40)), ContainsSubstring("a.pdb:2: expected a coordinate"));
  line.replace(32, 4, "x.yz");
  CHECK_THAT(error_of(line), ContainsSubstring("a.pdb:1: expected a coordinate (A) in columns 31-38"));
  NamedAtom iron = {"FE", "HEM", "1", {}};
  std::string heme = pdb_line(iron, ' ', "HETATM");
  heme.replace(76, 2, "FE");
  CHECK_THAT(error_of(heme), ContainsSubstring("a.pdb:1: expected atoms that the radii 'bondi' know"));
  CHECK_THAT(error_of(pdb_line(iron), "amber"), ContainsSubstring("FE of residue HEM"));
}

TEST_CASE("all atoms without a radius are told at once, as lines for a file of radii") {
  const auto line = [](const std::string& name, const std::string& residue) {
    return pdb_line({name, residue, "9", {}}, ' ', "HETATM");
  };
  const std::string text = pdb_line(kCarbon) + line("C1", "LIG") + line("ZN", "ZN") + line("c1", "LIG") +
                           line("C2", "LIG") + line("O", "HOH") + line("C#", "LIG") + line("C 3", "LIG");
  CHECK(error_of(text, "amber") ==
        "a.pdb:2: expected atoms that the radii 'amber' know, got atom C1 of residue LIG A 9, "
        "element 'C', and 5 others" +
            kMissing +
            "\nLIG C1 ?  # 2 atoms, first a.pdb:2"
            "\nZN ZN ?  # 1 atom, first a.pdb:3"
            "\nLIG C2 ?  # 1 atom, first a.pdb:5"
            "\nLIG C ?  # 2 atoms, first a.pdb:7");
  std::string lines = error_of(text, "amber");
  lines.erase(0, lines.find('\n'));
  for (std::size_t at = lines.find('?'); at != std::string::npos; at = lines.find('?', at)) lines.replace(at, 1, "1.5");
  const testing::Folder folder;
  std::ofstream(folder / "more.radii") << lines;
  const AtomFile file = parse_pdb(text, "a.pdb", "amber", folder / "more.radii");
  REQUIRE(file.atoms.size() == 7);
  for (std::size_t i = 1; i < file.atoms.size(); ++i) CHECK(file.atoms[i].radius == 1.5);
}

TEST_CASE("atoms without a radius that no file of radii can have are a comment, and many are counted") {
  const std::string nameless = pdb_line({"", "LIG", "9", {}}, ' ', "HETATM").substr(0, 66);
  CHECK_THAT(error_of(nameless), Catch::Matchers::EndsWith(":\n# atom '' of residue 'LIG'  # 1 atom, first a.pdb:1"));
  std::vector<NamedAtom> atoms;
  for (char c = 'A'; c <= 'X'; ++c) atoms.push_back({std::string("Q") + c, "LIG", "9", {}});
  try {
    parse_mmcif(mmcif_text(atoms), "a.cif", "amber");
    FAIL("there are no radii");
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), Catch::Matchers::StartsWith("a.cif: atom 1: expected atoms that the radii 'amber' know") &&
                                 ContainsSubstring("\nLIG QT ?  # 1 atom, first a.cif: atom 20\n# and 4 more"));
    CHECK(std::string(error.what()).ends_with("# and 4 more"));
  }
}

TEST_CASE("coordinates of mmCIF may have a standard uncertainty") {
  const auto x_of = [](const std::string& x) {
    std::string text = mmcif_text({kCarbon});
    text.replace(text.find(" 1.5 "), 5, " " + x + " ");
    return parse_mmcif(text, "a.cif", "bondi").atoms.at(0).x;
  };
  CHECK(x_of("19.594(5)") == 19.594);
  CHECK(x_of("-1.5(12)") == -1.5);
  CHECK(x_of("'19(5)'") == 19.0);
  for (const char* wrong : {"1.5()", "1.5(x)", "1.5(5", "1.5(5)(5)", "(5)", "1.5(-5)"}) {
    CAPTURE(wrong);
    CHECK_THROWS_WITH(x_of(wrong), ContainsSubstring(std::string("expected a coordinate (A), got '") + wrong));
  }
}

TEST_CASE("mmCIF that is none") {
  const auto error_of_cif = [](const std::string& text) {
    try {
      parse_mmcif(text, "a.cif", "bondi");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  std::string text = mmcif_text({kCarbon});
  CHECK_THAT(error_of_cif(""), ContainsSubstring("a.cif"));
  CHECK_THAT(error_of_cif("data_x\n_cell.length_a 3\n"), ContainsSubstring("a.cif: expected a loop _atom_site"));
  CHECK_THAT(error_of_cif("data_x\nloop_\n"), ContainsSubstring("a.cif:"));
  text.replace(text.find("-2.25"), 5, "?    ");
  CHECK_THAT(error_of_cif(text), ContainsSubstring("a.cif: atom 1: expected a coordinate"));
}

TEST_CASE("mmCIF whose atoms are not in the first block alone") {
  const std::string text = mmcif_text({kCarbon});
  CHECK(parse_mmcif("data_OTHER\n_cell.length_a 3\n" + text, "a.cif", "bondi").atoms.size() == 1);
  std::string next = text;
  next.replace(next.find("TEST"), 4, "NEXT");
  try {
    parse_mmcif(text + next, "a.cif", "bondi");
    FAIL("two molecules are not read as one");
  } catch (const InputError& error) {
    CHECK(error.what() == std::string("a.cif:17: expected one loop _atom_site, in line 3, got another in block 'NEXT'; "
                                      "make a file of each block"));
  }
}

TEST_CASE("mmCIF whose table lacks a column") {
  const std::string text = mmcif_text({kCarbon});
  const auto without = [&](const std::string& tag, const std::string& other) {
    std::string changed = text;
    changed.replace(changed.find("_atom_site." + tag), 11 + tag.size(), "_atom_site." + other);
    return changed;
  };
  const auto error_of_cif = [](const std::string& cif) {
    try {
      parse_mmcif(cif, "a.cif", "bondi");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK(error_of_cif(without("Cartn_y", "Cartn_u")) == "a.cif:3: expected a column _atom_site.Cartn_y, got none");
  CHECK(error_of_cif(without("type_symbol", "type")) == "a.cif:3: expected a column _atom_site.type_symbol, got none");
  CHECK(error_of_cif(without("label_atom_id", "id")) ==
        "a.cif:3: expected a column _atom_site.label_atom_id or _atom_site.auth_atom_id, got none");
  CHECK(error_of_cif(text + "\n_atom_site.auth_seq_id 7\n") != "no error");
  for (const char* name : {"atom_id", "comp_id", "asym_id"}) {
    const std::string tag = name;
    CHECK(parse_mmcif(without("label_" + tag, "auth_" + tag), "a.cif", "amber").atoms[0].radius == 1.908);
  }
  CHECK(parse_mmcif(without("auth_seq_id", "label_seq_id"), "a.cif", "amber").atoms.size() == 1);
}

TEST_CASE("which format a file is in") {
  const testing::Folder folder;
  std::ofstream(folder / "a.pdb") << pdb_line(kCarbon);
  std::ofstream(folder / "a.cif") << mmcif_text({kCarbon});
  std::ofstream(folder / "b") << pdb_line(kCarbon);
  CHECK(read_atoms(folder / "a.pdb", {"", "bondi"}).atoms.size() == 1);
  CHECK(read_atoms(folder / "a.cif", {"", "bondi"}).atoms.size() == 1);
  CHECK(read_atoms(folder / "b", {"pdb", "bondi"}).atoms.size() == 1);
  CHECK_THROWS_AS(read_atoms(folder / "a.pdb"), OptionError);
  CHECK_THROWS_AS(read_atoms(folder / "b", {"pdq", "bondi"}), OptionError);
}

TEST_CASE("files that have radii take no others") {
  for (const char* name : {"a.pqr", "a.xyzr", "standard input"}) {
    std::istringstream text(name == std::string("a.xyzr") ? "0 0 0 1\n" : "ATOM 1 N ASN 1 -8.9 4.1 -0.5 0.18 1.8\n");
    CHECK_THROWS_MATCHES(
        read_atoms(text, name, {"", "bondi"}), OptionError,
        Catch::Matchers::Message(std::string(name) + ": expected no --radii for a file that has its own radii, as " +
                                 (name == std::string("a.xyzr") ? "XYZR" : "PQR") +
                                 " does, got 'bondi'; if it is another format, say so with "
                                 "--input-format"));
  }
}

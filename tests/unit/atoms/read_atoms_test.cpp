// Files: every edge file by name, gzip, streams, files that cannot be read, locales.
#include "gaussmesh/read_atoms.h"

#include <unistd.h>
#include <zlib.h>

#include <clocale>
#include <fstream>
#include <locale>
#include <sstream>

#include "atoms/atom_file_checks.h"

using namespace gaussmesh;
using namespace std::string_literals;
using Catch::Matchers::ContainsSubstring;

namespace {

/// A file that is gone at the end of the test.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& content)
      : path_(std::filesystem::temp_directory_path() / ("gaussmesh_" + std::to_string(getpid()) + "_" + name)) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string content_of(const std::filesystem::path& path) {
  std::ifstream input(path, std::ios::binary);
  std::ostringstream content;
  content << input.rdbuf();
  return content.str();
}

std::string gzipped(const std::string& text) {
  constexpr int kGzip = 16;
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzip, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string data(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(data.data());
  stream.avail_out = static_cast<uInt>(data.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  data.resize(stream.total_out);
  deflateEnd(&stream);
  return data;
}

std::string error_of_file(const std::string& name, const std::string& content) {
  const TemporaryFile file(name, content);
  return input_error_of([&] { read_atoms(file.path()); });
}

std::string error_of_edge(const std::string& name) {
  return input_error_of([&] { read_edge(name); });
}

const std::string kAtom = "ATOM 1 N ASN 1 -8.901 4.127 -0.555 0.1801 1.8240\n";

}  // namespace

TEST_CASE("read_atoms reads the base file") {
  const AtomFile base = read_edge("dialect_00_base.pqr");
  REQUIRE(base.atoms.size() == 60);
  CHECK(base.warnings.empty());
  CHECK(same_atom(base.atoms.front(), {-8.901, 4.127, -0.555, 1.8240, 0.1801}));
  CHECK(same_atom(base.atoms.back(), {-4.621, -2.334, -0.226, 1.6612, -0.5679}));
}

TEST_CASE("read_atoms reads dialects of PQR as the base file") {
  const std::string name =
      GENERATE("01_chain", "02_whitespace", "03_whitespace_chain", "04_hetatm", "05_hetatm_glued", "06_serial_overflow",
               "07_serial_stars", "08_neg_resnum", "09_big_resnum", "10_chain_glued_resnum", "11_icode", "14_crlf",
               "15_cr_only", "16_remarks", "17_blank_lines", "18_tabs", "19_scientific", "20_fortran_D",
               "21_trailing_columns", "22_leading_space", "23_lowercase", "24_bom", "25_no_final_newline",
               "26_comments", "27_glued_names", "28_quoted_names", "29_space_in_chain_col", "36_gz");
  CAPTURE(name);
  const AtomFile file = read_edge("dialect_" + name + ".pqr");
  require_same_atoms(file.atoms, read_edge("dialect_00_base.pqr").atoms);
  CHECK(file.warnings.empty());
}

TEST_CASE("read_atoms parts coordinates that run together") {
  const AtomFile spaced = read_edge("dialect_13_shifted_spaced.pqr");
  const AtomFile base = read_edge("dialect_00_base.pqr");
  require_same_atoms(read_edge("dialect_12_glued_xyz.pqr").atoms, spaced.atoms);
  REQUIRE(spaced.atoms.size() == base.atoms.size());
  for (std::size_t i = 0; i < base.atoms.size(); ++i) {
    CHECK(spaced.atoms[i].x == Approx(base.atoms[i].x - 150.0));
    CHECK(spaced.atoms[i].y == Approx(base.atoms[i].y - 250.0));
    CHECK(spaced.atoms[i].z == Approx(base.atoms[i].z + 1050.0));
  }
}

TEST_CASE("read_atoms reads the first of two models and says so") {
  const AtomFile file = read_edge("dialect_30_two_models.pqr");
  require_same_atoms(file.atoms, read_edge("dialect_00_base.pqr").atoms);
  REQUIRE(file.warnings.size() == 1);
  CHECK_THAT(file.warnings[0], ContainsSubstring(".pqr:62: the first model ends here; left out 60 atoms"));
}

TEST_CASE("read_atoms reads on after END and says so") {
  const AtomFile file = read_edge("dialect_31_end_in_middle.pqr");
  require_same_atoms(file.atoms, read_edge("dialect_00_base.pqr").atoms);
  REQUIRE(file.warnings.size() == 1);
  CHECK_THAT(file.warnings[0], ContainsSubstring(".pqr:31: END is followed by 30 atoms"));
}

TEST_CASE("read_atoms reads XYZR by name") {
  std::vector<Atom> expected = read_edge("dialect_00_base.pqr").atoms;
  for (Atom& atom : expected) {
    atom.charge = 0.0;
  }
  const std::string name = GENERATE("32_xyzr", "33_xyzr_count", "34_xyzr_comment");
  CAPTURE(name);
  const AtomFile file = read_edge("dialect_" + name + ".xyzr");
  require_same_atoms(file.atoms, expected);
  CHECK(file.warnings.empty());

  const std::string text = content_of(edge_path("dialect_" + name + ".xyzr"));
  const TemporaryFile packed("PACKED.XYZR.GZ", gzipped(text));
  require_same_atoms(read_atoms(packed.path()).atoms, expected);
}

TEST_CASE("read_atoms refuses broken files and names the line") {
  struct Case {
    const char* file;
    const char* message;
  };
  const Case broken = GENERATE(values<Case>({
      {"dialect_35_xml.xml", ":1: expected PQR records, got '<?xml version=\"1.0\"?>'; PQR-XML is not supported"},
      {"bad_00_empty.pqr", "got no atoms"},
      {"bad_01_whitespace.pqr", "got no atoms"},
      {"bad_02_only_remarks.pqr", "got no atoms"},
      {"bad_03_not_pqr.pqr", "got no atoms"},
      {"bad_04_binary.pqr", ":3: expected text, got a NUL byte"},
      {"bad_05_truncated.pqr", ":22: expected serial, atom, residue"},
      {"bad_06_missing_radius.pqr", ":10: expected serial, atom, residue"},
      {"bad_07_missing_field.pqr", ":1: expected serial, atom, residue"},
      {"bad_08_text_number.pqr", ":7: expected y (A) as a finite number, got 'abc'"},
      {"bad_09_comma_decimal.pqr", ":1: expected x (A) as a finite number, got '-8,901'; write decimals with a point"},
      {"bad_10_coord_nan.pqr", ":20: expected x (A) as a finite number, got 'nan'"},
      {"bad_11_coord_inf.pqr", ":20: expected x (A) as a finite number, got 'inf'"},
      {"bad_12_coord_neginf.pqr", ":20: expected x (A) as a finite number, got '-inf'"},
      {"bad_13_coord_overflow.pqr", ":20: expected x (A) as a finite number, got '1e400'"},
      {"bad_14_coord_msvcnan.pqr", ":20: expected x (A) as a finite number, got '1.#IND'"},
      {"bad_15_radius_nan.pqr", ":20: expected a radius (A) as a finite number, got 'nan'"},
      {"bad_16_radius_inf.pqr", ":20: expected a radius (A) as a finite number, got 'inf'"},
      {"bad_17_radius_neg.pqr", ":20: expected a radius >= 0 (A), got '-1.5'"},
      {"bad_20_pdb_not_pqr.pqr", "look like occupancy and B-factor"},
      {"bad_21_pdb_no_element.pqr", "look like occupancy and B-factor"},
      {"bad_23_nul_inside.pqr", ":10: expected text, got a NUL byte"},
      {"bad_24_utf16.pqr", "got UTF-16"},
  }));
  const std::string message = error_of_edge(broken.file);
  CHECK_THAT(message, ContainsSubstring(broken.message));
  CHECK_THAT(message, ContainsSubstring(broken.file));
}

TEST_CASE("read_atoms takes a tiny radius as it is") {
  const AtomFile file = read_edge("bad_18_radius_tiny.pqr");
  REQUIRE(file.atoms.size() == 60);
  CHECK(file.atoms[19].radius == 1e-300);
}

TEST_CASE("read_atoms reads lines of any length") {
  const std::string remark = "REMARK " + std::string(2'000'000, 'x') + "\n";
  const TemporaryFile file("long_line.pqr", remark + content_of(edge_path("dialect_00_base.pqr")));
  require_same_atoms(read_atoms(file.path()).atoms, read_edge("dialect_00_base.pqr").atoms);
}

TEST_CASE("other compressions are named") {
  const auto told = [](const std::string& kind, const std::string& program) {
    return ": expected plain or gzipped data, got " + kind +
           "; expand it first, or on the way to standard input as in '" + program +
           " FILE | gaussmesh -', with --input-format for molecules that are not PQR";
  };
  CHECK_THAT(error_of_file("a.pqr.bz2", "BZh91AY&SY\x12\0"s), Catch::Matchers::EndsWith(told("bzip2", "bzcat")));
  CHECK_THAT(error_of_file("a.pqr.xz", "\xfd\x37zXZ\0\0"s), Catch::Matchers::EndsWith(told("xz", "xzcat")));
  CHECK_THAT(error_of_file("a.pqr.zst", "\x28\xb5\x2f\xfd\0"s), Catch::Matchers::EndsWith(told("zstd", "zstdcat")));
  std::istringstream input("\xfd\x37zXZ\0\0"s);
  CHECK(input_error_of([&] { read_atoms(input, "standard input"); }) == "standard input" + told("xz", "xzcat"));
  CHECK_THAT(error_of_file("a.pqr", "BZh"), ContainsSubstring("atoms"));
}

TEST_CASE("read_atoms reads gzip of several members and with padding") {
  const TemporaryFile members("members.pqr.gz", gzipped(kAtom) + gzipped(kAtom));
  CHECK(read_atoms(members.path()).atoms.size() == 2);
  const TemporaryFile padded("padded.pqr", gzipped(kAtom) + std::string(512, '\0'));
  CHECK(read_atoms(padded.path()).atoms.size() == 1);
}

TEST_CASE("read_atoms reads plain text under a gzip name") {
  const TemporaryFile plain("plain.pqr.gz", kAtom);
  CHECK(read_atoms(plain.path()).atoms.size() == 1);
}

TEST_CASE("read_atoms refuses damaged gzip") {
  const std::string data = gzipped(content_of(edge_path("dialect_00_base.pqr")));
  CHECK_THAT(error_of_file("cut.pqr.gz", data.substr(0, data.size() / 2)), ContainsSubstring("the file is cut off"));
  CHECK_THAT(error_of_file("head.pqr.gz", data.substr(0, 2)), ContainsSubstring("the file is cut off"));
  std::string flipped = data;
  flipped[data.size() - 6] ^= 1;  // a byte of the check sum
  CHECK_THAT(error_of_file("flipped.pqr.gz", flipped), ContainsSubstring("expected gzip data, got corrupt data"));
  CHECK_THAT(error_of_file("tail.pqr.gz", data + "tail"), ContainsSubstring("other data after it"));
  CHECK_THAT(error_of_file("empty.pqr.gz", gzipped("")), ContainsSubstring("got no atoms"));
}

TEST_CASE("read_atoms refuses gzip that expands without bounds") {
  const std::string bomb = gzipped(std::string(std::size_t{80} << 20, ' '));
  CHECK_THAT(error_of_file("bomb.pqr.gz", bomb), ContainsSubstring("expand more than 200-fold"));
}

TEST_CASE("read_atoms says why a file cannot be read") {
  const auto error_of_path = [](const std::filesystem::path& path) {
    return input_error_of([&] { read_atoms(path); });
  };
  CHECK(error_of_path("no/such/file.pqr") ==
        "no/such/file.pqr: expected a readable file, got 'No such file or directory'");
  CHECK_THAT(error_of_path(std::filesystem::temp_directory_path()), ContainsSubstring("got 'Is a directory'"));

  const TemporaryFile locked("locked.pqr", kAtom);
  std::filesystem::permissions(locked.path(), std::filesystem::perms::none);
  if (geteuid() != 0) {  // root may read everything
    CHECK_THAT(error_of_path(locked.path()), ContainsSubstring("got 'Permission denied'"));
  }
}

TEST_CASE("read_atoms reads streams, and names decide their format") {
  std::istringstream pqr(kAtom);
  CHECK(read_atoms(pqr, "<standard input>").atoms.size() == 1);
  std::istringstream xyzr("1 2 3 4\n");
  CHECK(same_atom(read_atoms(xyzr, "some.xyzr").atoms.at(0), {1, 2, 3, 4, 0}));
  for (const char* name : {"some.xyzrn", "some.xyzrq", "SOME.XYZRN.gz"}) {
    std::istringstream more("1 2 3 4 1 N_ALA_1\n");
    CHECK(same_atom(read_atoms(more, name).atoms.at(0), {1, 2, 3, 4, 0}));
  }
  std::istringstream packed(gzipped(kAtom));
  CHECK(read_atoms(packed, "-").atoms.size() == 1);
  std::istringstream empty;
  CHECK_THAT(input_error_of([&] { read_atoms(empty, "-"); }), ContainsSubstring("-: expected ATOM or HETATM"));
}

TEST_CASE("read_atoms says which formats are not read") {
  const auto error_of_text = [](const std::string& name, const std::string& text, const ReadOptions& options = {}) {
    std::istringstream input(text);
    return input_error_of([&] { read_atoms(input, name, options); });
  };
  CHECK(
      error_of_text("a.gro", "water\n    1\n    1SOL     OW    1   0.126   1.624   1.679\n") ==
      "a.gro: expected PQR, XYZR, PDB or mmCIF, got GRO by its name, which is not read; have another program write it "
      "as one of these, or if it is one, say so with --input-format");
  CHECK_THAT(error_of_text("A.XYZ.gz", "1\nwater\nO 0 0 0\n"), ContainsSubstring("got XYZ by its name"));
  CHECK_THAT(error_of_text("a.bcif", "\x83\0"s), ContainsSubstring("got BinaryCIF by its name"));
  CHECK_THAT(error_of_text("a.sdf", "", {"", "bondi"}), ContainsSubstring("got SDF by its name"));
  CHECK(error_of_text("a.xyz", kAtom, {"pqr", ""}).empty());
  CHECK(error_of_text("-", "@<TRIPOS>MOLECULE\n") ==
        "-:1: expected PQR records, got '@<TRIPOS>MOLECULE'; MOL2 is not read");
  CHECK_THAT(
      error_of_text("-", "\n\n\n  1  0  0     0  0            999 V2000\n", {"pdb", "bondi"}),
      ContainsSubstring("-:4: expected PDB records, got '1  0") && ContainsSubstring("MOL and SDF are not read"));
}

TEST_CASE("PDBQT is read as PDB") {
  std::istringstream input(
      "BEGIN_RES LIG A 1\nROOT\n"
      "ATOM      1  OA  LIG A   1       0.000   0.000   0.000  1.00  0.00     0.148 OA\n"
      "ENDROOT\nBRANCH   1   2\nENDBRANCH   1   2\nTORSDOF 1\nEND_RES LIG A 1\n");
  const AtomFile file = read_atoms(input, "a.pdbqt", {"", "bondi"});
  CHECK(file.atoms.at(0).radius == 1.52);
  CHECK(file.warnings.empty());
}

TEST_CASE("read_atoms does not depend on the locale") {
  struct CommaPoint : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::vector<Atom> expected = read_edge("dialect_00_base.pqr").atoms;
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) {
      break;
    }
  }
  const std::locale global = std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
  const AtomFile file = read_edge("dialect_00_base.pqr");
  const AtomFile gzip = read_edge("dialect_36_gz.pqr");
  const std::string message = error_of_edge("bad_09_comma_decimal.pqr");
  std::locale::global(global);
  std::setlocale(LC_ALL, before.c_str());
  require_same_atoms(file.atoms, expected);
  require_same_atoms(gzip.atoms, expected);
  CHECK_THAT(message, ContainsSubstring("got '-8,901'"));
}

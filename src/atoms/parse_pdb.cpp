// The PDB reader: ATOM and HETATM records by their columns. What a line is, pqr_record.h tells.
//
// https://www.wwpdb.org/documentation/file-format-content/format33/sect9.html#ATOM

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "atoms/pdb_element.h"
#include "atoms/pqr_record.h"
#include "atoms/structure_builder.h"
#include "atoms/unknown_lines.h"
#include "gaussmesh/error.h"
#include "text/text_lines.h"

namespace gaussmesh {
namespace {

/// Columns `first` to `last`, counted from 1 as the format does, without blanks at the ends.
std::string_view columns(std::string_view line, std::size_t first, std::size_t last) {
  return line.size() < first ? std::string_view{} : trim(line.substr(first - 1, last - first + 1));
}

/// Throws the error for a record that its columns do not settle.
[[noreturn]] void fail_at_columns(std::string_view record, const LinePlace& place) {
  fail_at(place, "an atom record in the columns of PDB, x y z in 31-54", record,
          "; no tabs, and blanks only where the format has them");
}

/// `line`, an atom record, with its columns where the format has them. Blanks before it are taken off, and so is what a
/// serial number of six digits or more moves to the right in files of some programs; in those of others it takes the
/// blank column before or behind. The decimal points tell.
///
/// @throws InputError where they do not
std::string_view align_record(std::string_view line, const LinePlace& place) {
  constexpr std::size_t kSerial = 6;
  constexpr std::size_t kEndOfSerial = 11;
  constexpr std::size_t kLastColumn = 80;
  const std::string_view record = line.substr(line.find_first_not_of(" \t\v\f"));
  const bool is_indented = record.size() < line.size();
  if (trim(record).substr(0, kLastColumn).find('\t') != std::string_view::npos ||
      (is_indented && !has_coordinates_at(record, kFirstOfPdb))) {
    fail_at_columns(line, place);
  }
  const std::size_t digits_end = std::min(record.find_first_not_of("0123456789", kSerial), record.size());
  const std::size_t shift = digits_end > kEndOfSerial ? digits_end - kEndOfSerial : 0;
  const bool is_shifted =
      shift > 0 && !has_coordinates_at(record, kFirstOfPdb) && has_coordinates_at(record, kFirstOfPdb + shift);
  if (!is_shifted && columns(record, kSerial + 1, kEndOfSerial).find(' ') != std::string_view::npos) {
    fail_at_columns(line, place);
  }
  return record.substr(is_shifted ? shift : 0);
}

/// x, y and z of `record`.
///
/// @throws InputError where one is no number, has no decimal point, as a residue number that came to stand there, or
/// goes on beyond its columns: what is in them would be a part of it
std::array<double, 3> coordinates(std::string_view record, const LinePlace& place) {
  std::array<double, 3> values{};
  const bool is_regular = has_coordinates_at(record, kFirstOfPdb);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t begin = kFirstOfPdb + i * kCoordinateWidth;
    const std::size_t end = begin + kCoordinateWidth;
    const std::string_view field = columns(record, begin + 1, end);
    const auto value = parse_number(field);
    const bool has_point = field.find('.') != std::string_view::npos;
    const bool is_cut_before = i == 0 && value && !is_blank(record[begin - 1]);
    const bool is_cut_behind = !is_regular && record.size() > end && !is_blank(record[end - 1]) &&
                               (is_digit(record[end]) || record[end] == '.');
    if (!value || !has_point || is_cut_before || is_cut_behind) {
      fail_at(place, "a coordinate (A) in columns " + std::to_string(begin + 1) + "-" + std::to_string(end),
              is_cut_before ? columns(record, begin, end) : field,
              is_cut_behind         ? "; it goes on behind them"
              : value && !has_point ? "; write it with a decimal point"
                                    : "");
    }
    values[i] = *value;
  }
  return values;
}

/// What `line` is.
///
/// @throws InputError if it begins as an atom record and goes on as none
RecordKind kind_of(std::string_view line, const LinePlace& place) {
  const std::string_view content = trim(line);
  const RecordKind kind = classify_record(content).kind;
  if (kind == RecordKind::kUnknown && upper_start(content, 4) == "ATOM") {
    fail_at(place, "a serial number behind ATOM", content);
  }
  return kind;
}

/// Whether columns 73-80 are those of files before 1997: the entry, of a digit and three more, a letter if the line was
/// revised, and its number. That letter is no element.
bool has_line_number(std::string_view record) {
  const std::string_view entry = columns(record, 73, 76), number = columns(record, 78, 80);
  return entry.size() == 4 && is_digit(entry[0]) && record.size() >= 80 && is_digit(record[79]) &&
         std::all_of(number.begin(), number.end(), is_digit);
}

/// The type of an atom in a record of PDBQT, which has its charge in columns 71-76 and the type in 78-79; empty in
/// others. https://autodock.scripps.edu/wp-content/uploads/sites/56/2021/10/AutoDock4.2.6_UserGuide.pdf
std::string_view autodock_type(std::string_view record) {
  const std::string_view charge = columns(record, 71, 76);
  const bool is_charge = charge.find('.') != std::string_view::npos && parse_number(charge).has_value();
  return is_charge && columns(record, 77, 77).empty() && columns(record, 80, 80).empty() ? columns(record, 78, 79)
                                                                                         : std::string_view{};
}

/// The element of a type of AutoDock: a letter behind C, H, N, O or S tells donors, acceptors and carbons of rings.
std::string element_of_type(std::string_view type) {
  constexpr std::string_view kTypes[] = {"HD", "HS", "NA", "NS", "OA", "OS", "SA"};
  if (type == "A") return "C";
  const bool is_marked = std::find(std::begin(kTypes), std::end(kTypes), type) != std::end(kTypes);
  return std::string(type.substr(0, is_marked ? 1 : 2));
}

/// Columns 77-78, or where there is no element, what the name says.
std::string element(std::string_view record) {
  const std::string_view type = autodock_type(record);
  if (!type.empty() && is_letter(type[0])) return element_of_type(type);
  const std::string_view written = columns(record, 77, 78);
  if (!written.empty() && is_letter(written[0]) && !has_line_number(record)) return std::string(written);
  return record.size() < 16 ? std::string{} : element_of_name(record.substr(12, 4), columns(record, 18, 20));
}

/// The atoms of the first frame by their names: what stands behind END is another frame if it has the same ones.
class FrameAtoms {
 public:
  /// `record` must outlive this.
  void add(std::string_view record) { names_.push_back(name_of(record)); }

  /// Whether the atom of `record` was added. Nothing is added after the first call.
  bool has(std::string_view record) {
    if (!is_sorted_) std::sort(names_.begin(), names_.end());
    is_sorted_ = true;
    return std::binary_search(names_.begin(), names_.end(), name_of(record));
  }

 private:
  /// Columns 13-27: atom, alternate location, residue, chain, number and insertion code.
  static std::string_view name_of(std::string_view record) { return record.substr(12, 15); }

  std::vector<std::string_view> names_;
  bool is_sorted_ = false;
};

/// Reads one text; made anew for each.
class PdbParser {
 public:
  PdbParser(std::string_view text, std::string_view name, AtomRadii radii, AtomNames names)
      : name_(name), lines_(text), builder_(name, std::move(radii), names) {}

  AtomFile parse() {
    while (const auto line = lines_.next()) read_line(*line);
    AtomFile file = builder_.finish();
    unknown_lines_.warn(name_, file);
    return file;
  }

 private:
  LinePlace place() const { return {name_, lines_.number()}; }

  void read_line(std::string_view line) {
    switch (kind_of(line, place())) {
      case RecordKind::kAtom:
        read_atom(line);
        break;
      case RecordKind::kEnd:
        if (has_atoms_ && !end_line_) end_line_ = lines_.number();
        [[fallthrough]];
      case RecordKind::kModel:
      case RecordKind::kEndOfModel:
        // Numbers do not tell models apart: frames may all have the same, or none.
        builder_.end_model(lines_.number());
        break;
      case RecordKind::kUnknown:
        unknown_lines_.add(trim(line), "PDB records", place());
        break;
      case RecordKind::kPassedOver:
        break;
    }
  }

  void read_atom(std::string_view line) {
    const std::string_view record = align_record(line, place());
    const auto [x, y, z] = coordinates(record, place());
    require_frame(line, record);
    builder_.add({.where = to_string(place()),
                  .line = lines_.number(),
                  .name = columns(record, 13, 16),
                  .residue = columns(record, 18, 20),
                  .element = element(record),
                  .element_place = "columns 77-78",
                  .site = std::string(columns(record, 22, 22)) + " " + std::string(columns(record, 23, 27)),
                  .chain = columns(record, 22, 22),
                  .number = std::string(columns(record, 23, 27)),
                  .alternate = columns(record, 17, 17),
                  .model = {},
                  .x = x,
                  .y = y,
                  .z = z});
  }

  /// Trajectories have their frames behind END, and so do files that were joined as they are: the other molecule would
  /// be lost with the frames.
  void require_frame(std::string_view line, std::string_view record) {
    has_atoms_ = true;
    if (!end_line_) {
      frame_atoms_.add(record);
    } else if (!frame_atoms_.has(record)) {
      fail_at(place(), "no atoms behind END in line " + std::to_string(*end_line_) + " but those before it again",
              trim(line), "; if all are to be one molecule, take END out");
    }
  }

  std::string_view name_;
  LineReader lines_;
  StructureBuilder builder_;
  FrameAtoms frame_atoms_;
  UnknownLines unknown_lines_;
  bool has_atoms_ = false;
  std::optional<std::size_t> end_line_;  // of the first END behind an atom
};

}  // namespace

AtomFile parse_pdb(std::string_view text, std::string_view name, const std::string& radii,
                   const std::filesystem::path& radii_file, AtomNames names) {
  return PdbParser(require_text(text, name), name, {radii, radii_file}, names).parse();
}

}  // namespace gaussmesh

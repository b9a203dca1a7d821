// The PDB reader: ATOM and HETATM records by their columns. What a line is, pqr_record.h tells.
//
// https://www.wwpdb.org/documentation/file-format-content/format33/sect9.html#ATOM

#include <algorithm>
#include <array>

#include "atoms/pdb_element.h"
#include "atoms/pqr_record.h"
#include "atoms/structure_builder.h"
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
              value && !has_point ? "; write it with a decimal point" : "");
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

/// Columns 77-78, or where they are blank, or have the line numbers of old files, what the name says.
std::string element(std::string_view record) {
  const std::string_view written = columns(record, 77, 78);
  if (!written.empty() && is_letter(written[0])) return std::string(written);
  return record.size() < 16 ? std::string{} : element_of_name(record.substr(12, 4), columns(record, 18, 20));
}

void read_atom(std::string_view line, const LinePlace& place, StructureBuilder& builder) {
  const std::string_view record = align_record(line, place);
  const auto [x, y, z] = coordinates(record, place);
  builder.add({.where = to_string(place),
               .line = place.line,
               .name = columns(record, 13, 16),
               .residue = columns(record, 18, 20),
               .element = element(record),
               .element_place = "columns 77-78",
               .site = std::string(columns(record, 22, 22)) + " " + std::string(columns(record, 23, 27)),
               .alternate = columns(record, 17, 17),
               .model = {},
               .x = x,
               .y = y,
               .z = z});
}

}  // namespace

AtomFile parse_pdb(std::string_view text, std::string_view name, const std::string& radii,
                   const std::filesystem::path& radii_file) {
  StructureBuilder builder(name, {radii, radii_file});
  LineReader lines(require_text(text, name));
  while (const auto line = lines.next()) {
    const LinePlace place{name, lines.number()};
    switch (kind_of(*line, place)) {
      case RecordKind::kAtom:
        read_atom(*line, place, builder);
        break;
      case RecordKind::kModel:
      case RecordKind::kEndOfModel:
      case RecordKind::kEnd:
        // Numbers do not tell models apart: frames may all have the same, or none.
        builder.end_model(place.line);
        break;
      case RecordKind::kPassedOver:
      case RecordKind::kUnknown:
        break;
    }
  }
  return builder.finish();
}

}  // namespace gaussmesh

// The PDB reader: ATOM and HETATM records by their columns.
//
// https://www.wwpdb.org/documentation/file-format-content/format33/sect9.html#ATOM

#include "atoms/structure_builder.h"
#include "gaussmesh/error.h"
#include "text/text_lines.h"

namespace gaussmesh {
namespace {

/// Columns `first` to `last`, counted from 1 as the format does, without blanks at the ends.
std::string_view columns(std::string_view line, std::size_t first, std::size_t last) {
  return line.size() < first ? std::string_view{} : trim(line.substr(first - 1, last - first + 1));
}

double coordinate(std::string_view line, std::size_t first, const LinePlace& place) {
  const std::string_view field = columns(line, first, first + 7);
  const auto value = parse_number(field);
  if (!value) {
    fail_at(place, "a coordinate (A) in columns " + std::to_string(first) + "-" + std::to_string(first + 7), field);
  }
  return *value;
}

/// Columns 77-78, or where they are blank what the name says: the element is right-justified in columns 13-14.
std::string_view element(std::string_view line) {
  const std::string_view written = columns(line, 77, 78);
  if (!written.empty() && is_letter(written[0])) return written;
  const std::string_view guess = columns(line, 13, 14);
  if (guess.size() == 2 && is_digit(guess[0])) return guess.substr(1);
  return line.size() > 12 && line[12] == 'H' ? line.substr(12, 1) : guess;  // names of four letters are of hydrogens
}

}  // namespace

AtomFile parse_pdb(std::string_view text, std::string_view name, const std::string& radii) {
  StructureBuilder builder(name, radii);
  LineReader lines(require_text(text, name));
  std::string_view model;
  while (const auto line = lines.next()) {
    if (line->starts_with("MODEL ")) model = columns(*line, 7, 14);
    if (!line->starts_with("ATOM  ") && !line->starts_with("HETATM")) continue;
    const LinePlace place{name, lines.number()};
    builder.add({.where = to_string(place),
                 .name = columns(*line, 13, 16),
                 .residue = columns(*line, 18, 20),
                 .element = element(*line),
                 .site = std::string(columns(*line, 22, 22)) + " " + std::string(columns(*line, 23, 27)),
                 .alternate = columns(*line, 17, 17),
                 .model = model,
                 .x = coordinate(*line, 31, place),
                 .y = coordinate(*line, 39, place),
                 .z = coordinate(*line, 47, place)});
  }
  return builder.finish();
}

}  // namespace gaussmesh

// One line of PQR: what it is, and which of its fields are the numbers of an atom.
//
// Where the numbers are. A record is free text before and behind its five numbers x y z charge radius: the chain is
// optional, blanks may be missing between names, and residue numbers, chains, even names may look like numbers. So
// the numbers are counted from the end, symbols such as an element left aside, and accepted only if the fields
// before them can be those of an atom: serial, name, residue, [chain], residue number (names_an_atom). A record
// that lacks a number fails there: its fifth field from the end is then the residue number, and a residue or chain
// name comes to stand in the place of a residue number. The one case that passes, a numeric chain, is found by
// comparing the records of a file (pqr_checks.h). Records that this rule does not settle are read by PDB columns,
// if every decimal point is where the columns want it.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "atoms/atom_fields.h"

namespace gaussmesh {

enum class RecordKind { kAtom, kModel, kEndOfModel, kEnd, kPassedOver, kUnknown };

struct Record {
  RecordKind kind = RecordKind::kUnknown;
  std::string_view rest;  ///< of an atom: what follows ATOM or HETATM
};

/// Where the numbers of a record are.
struct NumberFields {
  AtomFields fields;                          ///< x, y, z, radius, charge
  std::span<const std::string_view> leading;  ///< fields before them; empty if found by columns
};

/// Records of PDB, and of PDBQT, that say nothing about charges and radii, in order.
inline constexpr auto kPassedOver = std::to_array<std::string_view>(
    {"ANISOU", "AUTHOR", "BEGIN_", "BRANCH", "CAVEAT", "CISPEP", "COMPND", "CONECT", "CRYST1", "DBREF",  "DBREF1",
     "DBREF2", "ENDBRA", "ENDROO", "END_RE", "EXPDTA", "FORMUL", "FTNOTE", "HEADER", "HELIX",  "HET",    "HETNAM",
     "HETSYN", "HYDBND", "JRNL",   "KEYWDS", "LINK",   "LINKR",  "MASTER", "MDLTYP", "MODRES", "MTRIX1", "MTRIX2",
     "MTRIX3", "NUMMDL", "OBSLTE", "ORIGX1", "ORIGX2", "ORIGX3", "REMARK", "REVDAT", "ROOT",   "SCALE1", "SCALE2",
     "SCALE3", "SEQADV", "SEQRES", "SHEET",  "SIGATM", "SIGUIJ", "SITE",   "SLTBRG", "SOURCE", "SPLIT",  "SPRSDE",
     "SSBOND", "TER",    "TITLE",  "TORSDO", "TURN",   "TVECT",  "USER"});
static_assert(std::is_sorted(kPassedOver.begin(), kPassedOver.end()));

/// The first `size` characters of `text` in upper case.
inline std::string upper_start(std::string_view text, std::size_t size) { return upper_case(text.substr(0, size)); }

/// What `content`, the start of a line that is no atom, is.
inline RecordKind kind_of_other_record(std::string_view content) {
  if (content.empty() || content[0] == '#') {
    return RecordKind::kPassedOver;
  }
  // Six characters are a name even where a number follows at once (CONECT12345).
  const std::string name = upper_start(content.substr(0, content.find_first_of(" \t")), 6);
  if (name == "MODEL") {
    return RecordKind::kModel;
  }
  if (name == "ENDMDL") {
    return RecordKind::kEndOfModel;
  }
  if (name == "END") {
    return RecordKind::kEnd;
  }
  const bool is_known = std::binary_search(kPassedOver.begin(), kPassedOver.end(), name);
  return is_known ? RecordKind::kPassedOver : RecordKind::kUnknown;
}

/// What `content`, a line without the blanks at its ends, is.
inline Record classify_record(std::string_view content) {
  constexpr std::size_t kAtomSize = 4;
  constexpr std::size_t kHetatmSize = 6;
  const bool may_be_atom = content.size() >= kAtomSize && (to_upper(content[0]) == 'A' || to_upper(content[0]) == 'H');
  if (may_be_atom && upper_start(content, kAtomSize) == "ATOM") {
    const std::string_view rest = content.substr(kAtomSize);
    if (rest.empty() || is_blank(rest[0]) || is_digit(rest[0]) || rest[0] == '*' || rest[0] == '-') {
      return {RecordKind::kAtom, rest};
    }
  }
  // No other record begins with HETATM, so whatever is glued to it is a serial number.
  if (may_be_atom && upper_start(content, kHetatmSize) == "HETATM") {
    return {RecordKind::kAtom, content.substr(kHetatmSize)};
  }
  return {kind_of_other_record(content), {}};
}

/// Chains are no longer than this: names of residues mostly are.
inline constexpr std::size_t kLongestChain = 2;

/// True for a residue number, alone or with chain and insertion code: 7, -7, A1001, 1B, ****.
inline bool is_residue_number(std::string_view field) {
  if (field.size() > 1 && is_letter(field.back())) {
    field.remove_suffix(1);
  }
  const std::size_t number = field.find_last_not_of("0123456789*") + 1;
  if (number == field.size()) {
    return false;
  }
  field = field.substr(0, number);
  if (field.ends_with('-')) {
    field.remove_suffix(1);
  }
  return field.size() <= kLongestChain && field.find('.') == std::string_view::npos;
}

inline bool is_integer(std::string_view field) {
  const bool is_signed = field.size() > 1 && (field[0] == '-' || field[0] == '+');
  return !field.empty() && std::all_of(field.begin() + (is_signed ? 1 : 0), field.end(), is_digit);
}

/// Fields before the numbers: at least serial, name glued to residue, number; at most serial, name, alternate
/// location, residue, chain, number.
inline constexpr std::size_t kFewestLeadingFields = 3;
inline constexpr std::size_t kMostLeadingFields = 6;

/// True if `leading`, at least kFewestLeadingFields, can be all that stands before the numbers of a record.
inline bool names_an_atom(std::span<const std::string_view> leading) {
  constexpr std::size_t kShortestGluedNames = 5;  // a name is glued only if it fills its four columns
  const std::string_view last = leading.back();
  if (last.size() == 1 && is_letter(last[0]) && leading.size() > kFewestLeadingFields) {
    leading = leading.first(leading.size() - 1);  // an insertion code apart from its residue number
  }
  if (leading.size() > kMostLeadingFields || !is_residue_number(leading.back())) {
    return false;
  }
  if (leading.size() == kFewestLeadingFields) {
    return leading[1].size() >= kShortestGluedNames;
  }
  // Six fields that end in two integers could as well be five and an x without a decimal point.
  return leading.size() < kMostLeadingFields || !is_integer(leading[kMostLeadingFields - 2]);
}

/// Finds the numbers of an atom by counting `fields`, those behind ATOM or HETATM, from the end.
inline std::optional<NumberFields> find_by_fields(std::span<const std::string_view> fields) {
  constexpr std::size_t kNumbers = 5;
  constexpr std::size_t kFewest = kFewestLeadingFields + kNumbers;
  std::size_t end = std::min(kFewest, fields.size());
  while (end < fields.size() && fields[end][0] != '#') {
    ++end;
  }
  while (end > 0 && is_symbol(fields[end - 1])) {
    --end;
  }
  if (end < kFewest || !names_an_atom(fields.first(end - kNumbers))) {
    return std::nullopt;
  }
  const auto numbers = fields.subspan(end - kNumbers, kNumbers);
  return NumberFields{{numbers[0], numbers[1], numbers[2], numbers[4], numbers[3]}, fields.first(end - kNumbers)};
}

/// Where x begins in a record of PDB, counted from 0, and how many columns each coordinate has.
inline constexpr std::size_t kFirstOfPdb = 30;
inline constexpr std::size_t kCoordinateWidth = 8;

/// True if x, y and z take eight columns each of `line` from `first` on, with three decimals.
inline bool has_coordinates_at(std::string_view line, std::size_t first) {
  constexpr std::size_t kPoint = 4;
  if (line.size() < first + 3 * kCoordinateWidth) {
    return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string_view slot = line.substr(first + i * kCoordinateWidth, kCoordinateWidth);
    if (slot[kPoint] != '.' || !std::all_of(slot.begin() + kPoint + 1, slot.end(), is_digit)) {
      return false;
    }
  }
  return true;
}

/// Finds the numbers of an atom in `line` if x, y, z take their columns from `first` on, and charge and radius stand
/// behind. Uses `splitter`.
inline std::optional<NumberFields> find_at_column(std::string_view line, std::size_t first, FieldSplitter& splitter) {
  const std::size_t end = first + 3 * kCoordinateWidth;
  // A blank before x shows that x has not grown out of its columns.
  if (!has_coordinates_at(line, first) || is_blank(line[0]) || !is_blank(line[first - 1])) {
    return std::nullopt;
  }
  NumberFields result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.fields[i] = trim(line.substr(first + i * kCoordinateWidth, kCoordinateWidth));
  }
  const auto behind = splitter.split(line.substr(end));
  if (behind.size() < 2 || (behind.size() > 2 && !is_symbol(behind[2]) && behind[2][0] != '#')) {
    return std::nullopt;
  }
  result.fields[3] = behind[1];
  result.fields[4] = behind[0];
  return result;
}

/// Finds the numbers of an atom by columns: coordinates in columns 31-54 as in PDB, or in 32-55, where pdb2pqr puts
/// them if it writes no chains. The decimal points tell which; both at once they cannot be.
inline std::optional<NumberFields> find_by_columns(std::string_view line, FieldSplitter& splitter) {
  const auto found = find_at_column(line, kFirstOfPdb, splitter);
  return found ? found : find_at_column(line, kFirstOfPdb + 1, splitter);
}

/// True for 1.00 and its like, the way PDB writes occupancies and B-factors.
inline bool has_two_decimals(std::string_view field) { return field.size() > 3 && field[field.size() - 3] == '.'; }

/// True if `line` has an occupancy and a B-factor in PDB's columns 55-60 and 61-66.
inline bool has_pdb_columns(std::string_view line) {
  return line.size() >= 66 && has_two_decimals(line.substr(54, 6)) && has_two_decimals(line.substr(60, 6));
}

}  // namespace gaussmesh

// The mmCIF reader: the loop _atom_site.
//
// https://mmcif.wwpdb.org/dictionaries/mmcif_pdbx_v50.dic/Categories/atom_site.html

#include <algorithm>
#include <string_view>

#include "atoms/cif_table.h"
#include "atoms/structure_builder.h"
#include "gaussmesh/error.h"
#include "text/text_lines.h"

namespace gaussmesh {
namespace {

/// Columns of the table, in the order of columns().
enum Column { kName, kResidue, kElement, kAlternate, kModel, kChain, kAuthorChain, kNumber, kInsertion, kX, kY, kZ };

/// Tags of authors stand in for those that the dictionary asks for.
std::vector<CifColumn> columns() {
  constexpr auto kOptional = CifColumn::Need::kOptional;
  return {{"label_atom_id", "auth_atom_id"},
          {"label_comp_id", "auth_comp_id"},
          {"type_symbol", ""},
          {"label_alt_id", "", kOptional},
          {"pdbx_PDB_model_num", "", kOptional},
          {"label_asym_id", "auth_asym_id", kOptional},
          {"auth_asym_id", "label_asym_id", kOptional},
          {"auth_seq_id", "label_seq_id", kOptional},
          {"pdbx_PDB_ins_code", "", kOptional},
          {"Cartn_x", ""},
          {"Cartn_y", ""},
          {"Cartn_z", ""}};
}

/// `text` without the standard uncertainty that a number of CIF may have: `19.594(5)`.
std::string_view without_uncertainty(std::string_view text) {
  const std::size_t open = text.find('(');
  if (open == std::string_view::npos || !text.ends_with(')')) return text;
  const std::string_view digits = text.substr(open + 1, text.size() - open - 2);
  const bool is_one = !digits.empty() && std::all_of(digits.begin(), digits.end(), is_digit);
  return is_one ? text.substr(0, open) : text;
}

double coordinate(const std::string& text, const std::string& where) {
  const auto value = parse_number(without_uncertainty(text));
  if (!value) throw InputError(where + ": expected a coordinate (A), got " + gaussmesh::quoted(text));
  return *value;
}

}  // namespace

AtomFile parse_mmcif(std::string_view text, std::string_view name, const std::string& radii,
                     const std::filesystem::path& radii_file, AtomNames names) {
  StructureBuilder builder(name, {radii, radii_file}, names);
  const CifTable table = read_cif_table(require_text(text, name), name, "_atom_site.", columns());
  std::size_t number = 0;
  for (const std::vector<std::string>& row : table.rows) {
    const std::string where = std::string(name) + ": atom " + std::to_string(++number);
    builder.add({.where = where,
                 .line = number,
                 .name = row[kName],
                 .residue = row[kResidue],
                 .element = row[kElement],
                 .element_place = "type_symbol",
                 .site = row[kChain] + " " + row[kNumber] + row[kInsertion],
                 .chain = row[kAuthorChain],
                 .number = row[kNumber] + row[kInsertion],
                 .alternate = row[kAlternate],
                 .model = row[kModel],
                 .x = coordinate(row[kX], where),
                 .y = coordinate(row[kY], where),
                 .z = coordinate(row[kZ], where)});
  }
  return builder.finish();
}

}  // namespace gaussmesh

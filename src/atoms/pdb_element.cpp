#include "atoms/pdb_element.h"

#include <algorithm>
#include <iterator>

#include "atoms/residue_names.h"
#include "text/text_lines.h"

namespace gaussmesh {
namespace {

/// Symbols of two letters up to plutonium, in order; beyond it there are no molecules to mesh.
constexpr std::string_view kLongSymbols[] = {
    "AC", "AG", "AL", "AR", "AS", "AT", "AU", "BA", "BE", "BI", "BR", "CA", "CD", "CE", "CL", "CO",
    "CR", "CS", "CU", "DY", "ER", "EU", "FE", "FR", "GA", "GD", "GE", "HE", "HF", "HG", "HO", "IN",
    "IR", "KR", "LA", "LI", "LU", "MG", "MN", "MO", "NA", "NB", "ND", "NE", "NI", "NP", "OS", "PA",
    "PB", "PD", "PM", "PO", "PR", "PT", "PU", "RA", "RB", "RE", "RH", "RN", "RU", "SB", "SC", "SE",
    "SI", "SM", "SN", "SR", "TA", "TB", "TC", "TE", "TH", "TI", "TL", "TM", "XE", "YB", "ZN", "ZR"};
static_assert(std::is_sorted(std::begin(kLongSymbols), std::end(kLongSymbols)));

/// Elements whose atoms have names of the element, a letter for the place and a number.
constexpr std::string_view kOrganic = "CHNOPS";

/// Letters for places, from alpha to eta as names in the PDB have them.
constexpr std::string_view kPlaces = "ABGDEZH";

constexpr std::size_t kNameWidth = 4;

bool holds(std::string_view letters, char c) { return letters.find(c) != std::string_view::npos; }

/// What a name says that begins with two letters in the first two columns, outside of standard residues.
std::string_view element_of_two(std::string_view name, std::string_view residue) {
  const std::string_view two = name.substr(0, 2);
  const std::string_view one = name.substr(0, 1);
  const bool is_symbol = std::binary_search(std::begin(kLongSymbols), std::end(kLongSymbols), two);
  const bool is_organic = holds(kOrganic, name[0]);
  if (!is_symbol) return is_organic ? one : std::string_view{};
  if (!is_organic || two == residue) return two;
  if (name[0] == 'H') return name.size() == kNameWidth ? one : std::string_view{};
  return holds(kPlaces, name[1]) ? std::string_view{} : two;
}

}  // namespace

std::string element_of_name(std::string_view name, std::string_view residue) {
  const std::string upper_name = upper_case(name.substr(0, kNameWidth));
  const std::string upper_residue = upper_case(residue);
  const auto first = std::find_if(upper_name.begin(), upper_name.end(), is_letter);
  if (first == upper_name.end()) return {};
  std::string letters(first, std::find(first, upper_name.end(), ' '));
  if (is_standard_residue(upper_residue)) {
    if (letters == "SE") return letters;
    if (holds(kOrganic, letters[0]) || letters[0] == 'D') return letters.substr(0, 1);
  }
  const bool is_justified_left = first == upper_name.begin();
  if (!is_justified_left || letters.size() == 1 || !is_letter(letters[1])) return letters.substr(0, 1);
  return std::string(element_of_two(letters, upper_residue));
}

}  // namespace gaussmesh

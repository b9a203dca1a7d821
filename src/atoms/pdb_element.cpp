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

/// Ions as CHARMM names their residues, and mostly their only atom.
struct IonName {
  std::string_view residue;
  std::string_view element;
};
constexpr IonName kIons[] = {{"BAR", "BA"}, {"CAD", "CD"}, {"CAL", "CA"}, {"CES", "CS"}, {"CLA", "CL"},
                             {"LIT", "LI"}, {"POT", "K"},  {"RUB", "RB"}, {"SOD", "NA"}};

constexpr std::size_t kNameWidth = 4;

bool holds(std::string_view letters, char c) { return letters.find(c) != std::string_view::npos; }

bool is_long_symbol(std::string_view letters) {
  return std::binary_search(std::begin(kLongSymbols), std::end(kLongSymbols), letters);
}

/// `name` without blanks at its ends, and the number or charge there.
std::string_view without_number(std::string_view name) {
  constexpr std::string_view kNumber = " 0123456789+-";
  const std::size_t first = std::min(name.find_first_not_of(kNumber), name.size());
  return name.substr(first, name.find_last_not_of(kNumber) + 1 - first);
}

/// The element of an ion, whose atom is named as its residue, whatever the columns; empty if it is none.
std::string_view element_of_ion(std::string_view name, std::string_view residue) {
  const std::string_view letters = without_number(name);
  if (letters == without_number(residue) && is_long_symbol(letters)) return letters;
  const auto ion = std::find_if(std::begin(kIons), std::end(kIons), [&](const IonName& known) {
    return residue == known.residue && (letters == known.residue || letters == known.element);
  });
  return ion == std::end(kIons) ? std::string_view{} : ion->element;
}

/// What a name says that begins with two letters in the first two columns, outside of standard residues.
std::string_view element_of_two(std::string_view name) {
  const std::string_view two = name.substr(0, 2);
  const std::string_view one = name.substr(0, 1);
  const bool is_symbol = is_long_symbol(two);
  const bool is_organic = holds(kOrganic, name[0]);
  if (!is_symbol) return is_organic ? one : std::string_view{};
  if (!is_organic) return two;
  if (name[0] == 'H') return name.size() == kNameWidth ? one : std::string_view{};
  return holds(kPlaces, name[1]) ? std::string_view{} : two;
}

}  // namespace

std::string element_of_name(std::string_view name, std::string_view residue) {
  const std::string upper_name = upper_case(name.substr(0, kNameWidth));
  const std::string upper_residue = upper_case(residue);
  if (const auto ion = element_of_ion(upper_name, upper_residue); !ion.empty()) return std::string(ion);
  const auto first = std::find_if(upper_name.begin(), upper_name.end(), is_letter);
  if (first == upper_name.end()) return {};
  std::string letters(first, std::find(first, upper_name.end(), ' '));
  if (is_standard_residue(upper_residue)) {
    if (letters == "SE") return letters;
    if (holds(kOrganic, letters[0]) || letters[0] == 'D') return letters.substr(0, 1);
  }
  const bool is_justified_left = first == upper_name.begin();
  if (!is_justified_left || letters.size() == 1 || !is_letter(letters[1])) return letters.substr(0, 1);
  return std::string(element_of_two(letters));
}

}  // namespace gaussmesh

#include "atoms/residue_names.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "text/text_lines.h"

namespace gaussmesh {
namespace {

struct Alias {
  std::string_view name;
  std::string_view canonical;
};

/// States of protonation as AMBER and CHARMM name them, and selenomethionine.
constexpr Alias kResidues[] = {{"ASH", "ASP"}, {"CYM", "CYS"}, {"CYX", "CYS"}, {"GLH", "GLU"},
                               {"HID", "HIS"}, {"HIE", "HIS"}, {"HIP", "HIS"}, {"HSD", "HIS"},
                               {"HSE", "HIS"}, {"HSP", "HIS"}, {"LYN", "LYS"}, {"MSE", "MET"}};

/// Names of CHARMM, and those that the PDB had before 2007. Selenium takes the place of the sulphur.
constexpr Alias kAtoms[] = {{"HN", "H"}, {"OT1", "O"}, {"OT2", "OXT"}, {"O1P", "OP1"}, {"O2P", "OP2"}, {"SE", "SD"}};

constexpr std::string_view kWaters[] = {"DOD", "H2O", "HOH", "SOL", "TIP", "TIP3", "WAT"};

/// Names that programs give to water and the PDB to other molecules: here the atoms have to be those of water.
constexpr std::string_view kPerhapsWaters[] = {"SPC", "T3P", "T4P", "TIP4", "TP3", "TP4"};
constexpr std::string_view kWaterAtoms[] = {"1H", "2H", "H1", "H2", "HW1", "HW2", "MW", "O", "OH2", "OW"};

template <class Names>
bool holds(const Names& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

template <class Aliases>
std::string_view canonical(const Aliases& aliases, std::string_view name) {
  const auto alias =
      std::find_if(std::begin(aliases), std::end(aliases), [&](const Alias& entry) { return entry.name == name; });
  return alias == std::end(aliases) ? name : alias->canonical;
}

constexpr std::string_view kStandard[] = {"A",   "ALA", "ARG", "ASN", "ASP", "C",   "CYS", "DA",  "DC",  "DG",
                                          "DT",  "G",   "GLN", "GLU", "GLY", "HIS", "ILE", "LEU", "LYS", "MET",
                                          "PHE", "PRO", "SER", "THR", "TRP", "TYR", "U",   "VAL"};
static_assert(std::is_sorted(std::begin(kStandard), std::end(kStandard)));

}  // namespace

std::string_view canonical_residue(std::string_view residue) { return canonical(kResidues, residue); }

bool is_standard_residue(std::string_view residue) {
  return std::binary_search(std::begin(kStandard), std::end(kStandard), canonical_residue(residue));
}

std::string_view canonical_atom(std::string_view atom) { return canonical(kAtoms, atom); }

bool is_water(std::string_view residue, std::string_view atom) {
  const std::string upper_residue = upper_case(residue);
  return holds(kWaters, upper_residue) ||
         (holds(kPerhapsWaters, upper_residue) && holds(kWaterAtoms, upper_case(atom)));
}

}  // namespace gaussmesh

#include "atoms/residue_names.h"

#include <algorithm>
#include <iterator>

namespace gaussmesh {
namespace {

/// States of protonation as AMBER and CHARMM name them, and selenomethionine.
struct ResidueAlias {
  std::string_view name;
  std::string_view canonical;
};
constexpr ResidueAlias kAliases[] = {{"ASH", "ASP"}, {"CYM", "CYS"}, {"CYX", "CYS"}, {"GLH", "GLU"},
                                     {"HID", "HIS"}, {"HIE", "HIS"}, {"HIP", "HIS"}, {"HSD", "HIS"},
                                     {"HSE", "HIS"}, {"HSP", "HIS"}, {"LYN", "LYS"}, {"MSE", "MET"}};

constexpr std::string_view kStandard[] = {"A",   "ALA", "ARG", "ASN", "ASP", "C",   "CYS", "DA",  "DC",  "DG",
                                          "DT",  "G",   "GLN", "GLU", "GLY", "HIS", "ILE", "LEU", "LYS", "MET",
                                          "PHE", "PRO", "SER", "THR", "TRP", "TYR", "U",   "VAL"};
static_assert(std::is_sorted(std::begin(kStandard), std::end(kStandard)));

}  // namespace

std::string_view canonical_residue(std::string_view residue) {
  const auto alias = std::find_if(std::begin(kAliases), std::end(kAliases),
                                  [&](const ResidueAlias& entry) { return entry.name == residue; });
  return alias == std::end(kAliases) ? residue : alias->canonical;
}

bool is_standard_residue(std::string_view residue) {
  return std::binary_search(std::begin(kStandard), std::end(kStandard), canonical_residue(residue));
}

}  // namespace gaussmesh

// Radii for atoms that come without: named sets.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gaussmesh {

/// One set. Bondi's goes by the element; those of the force fields by residue and atom, for amino acids and
/// nucleotides.
class RadiusSet {
 public:
  /// @throws OptionError if there is no set of that name
  explicit RadiusSet(const std::string& name);

  const std::string& name() const { return name_; }

  /// The radius (A) of an atom; nothing if the set has none. Names in any case. Where a set by residues has no entry of
  /// its own for them, names of other programs stand for those of the PDB (residue_names.h).
  std::optional<double> find(std::string_view residue, std::string_view atom, std::string_view element) const;

 private:
  std::optional<double> find_entry(std::string_view key) const;

  std::string name_;
  bool is_by_residue_ = false;
  std::map<std::string, double, std::less<>> radii_;  // by element, or by residue and atom with a blank between
};

}  // namespace gaussmesh

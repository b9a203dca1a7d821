// What PDB and mmCIF have in common: which of their atoms are taken, and what radius they get.
//
// The formats are parse_pdb.cpp and parse_mmcif.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "atoms/alternate_locations.h"
#include "atoms/missing_radii.h"
#include "atoms/radius_file.h"
#include "gaussmesh/read_atoms.h"

namespace gaussmesh {

/// One atom as a file of structures has it.
struct AtomSite {
  std::string where;      ///< `file:line`, or what else a message should begin with
  std::size_t line = 0;   ///< as AtomFile::lines has it
  std::string_view name;  ///< of the atom
  std::string_view residue;
  std::string element;             ///< empty if there is none
  std::string_view element_place;  ///< where the file has elements, for messages
  std::string site;                ///< chain, number and insertion code of the residue: the same for all its atoms
  std::string_view chain;          ///< as AtomName has it
  std::string number;              ///< likewise
  std::string_view alternate;      ///< location; empty if there is only one
  std::string_view model;          ///< the same for all atoms of a model, or empty where end_model parts them
  double x = 0.0, y = 0.0, z = 0.0;
};

/// `atom CA of residue GLY A 7`
std::string name_of(const AtomSite& site);

/// Takes the first model, of each atom one location (alternate_locations.h), and no water; counts what it leaves out.
class StructureBuilder {
 public:
  StructureBuilder(std::string_view file, AtomRadii radii, AtomNames names)
      : file_name_(file), radii_(std::move(radii)), names_(names) {}

  /// The text that the names of `site` are in must outlive this. @throws InputError if a coordinate is out of range
  void add(const AtomSite& site);

  /// Ends the model of the atoms so far, in that line of the file; those added from now on are of other models. Does
  /// nothing before the first atom.
  void end_model(std::size_t line);

  /// What was found, with warnings of what was left out. @throws InputError if there is no atom, or the radii have none
  /// for some
  AtomFile finish();

 private:
  bool is_taken(const AtomSite& site);
  void take_one_location_each();

  std::string file_name_;
  AtomRadii radii_;
  AtomNames names_;
  AtomFile file_;
  AlternateLocations locations_;           // of the atoms in file_
  std::vector<AtomSite> without_radius_;   // of these
  std::vector<std::size_t> their_places_;  // in file_
  bool has_model_ = false;
  std::string model_;                          // the first
  std::optional<std::size_t> model_end_line_;  // of the first
  std::size_t other_models_ = 0;
  std::size_t other_locations_ = 0;
  std::size_t waters_ = 0;
};

}  // namespace gaussmesh

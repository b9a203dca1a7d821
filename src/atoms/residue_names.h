// Names of residues: which are amino acids and nucleotides, and which stand for others.
//
// Radii of their atoms are radii.h; what their atoms' names say of elements is pdb_element.h.
#pragma once

#include <string_view>

namespace gaussmesh {

/// The residue of which `residue` is a state or a variant, under its name in the PDB: HIS for HID, MET for MSE; any
/// other name as it is. In upper case.
std::string_view canonical_residue(std::string_view residue);

/// True for the amino acids and nucleotides that proteins and nucleic acids are made of, and their variants. In upper
/// case.
bool is_standard_residue(std::string_view residue);

}  // namespace gaussmesh

// Names of residues, and of their atoms: which are amino acids, nucleotides and water, and which stand for others.
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

/// The name in the PDB of an atom that other programs name otherwise in amino acids and nucleotides: H for HN, O and
/// OXT for OT1 and OT2, OP1 for O1P, SD for the SE of selenomethionine; any other as it is. In upper case.
std::string_view canonical_atom(std::string_view atom);

/// True if `atom` of `residue` is one of water. Both in any case.
bool is_water(std::string_view residue, std::string_view atom);

}  // namespace gaussmesh

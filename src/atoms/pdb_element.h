// The element of an atom in a PDB file.
#pragma once

#include <string>
#include <string_view>

namespace gaussmesh {

/// The element that `name`, the four columns 13-16 of an atom record with their blanks, means in `residue`; empty if
/// that is not clear. Both in any case; the result is in upper case.
///
/// The format puts the element right-justified into the first two columns, and names of four letters that begin with
/// its only letter into all four. Since many programs put all names into the first column, a name that would be read
/// as C, H, N, O, P or S there is not taken for another element, unless it can be no other:
///
/// - where residue and atom are the same symbol of two letters, perhaps with a number or charge, as ` CL ` and `CL-`,
///   it is an ion in whatever columns; so are CHARMM's, as `SOD ` or ` NA ` in `SOD`
/// - in amino acids and nucleotides the first letter is the element, if it is one of these or D; SE is selenium
/// - elsewhere `CA  `, `HG  ` or `NE  ` say nothing; `CL  `, `ZN  ` and `C1  ` do
std::string element_of_name(std::string_view name, std::string_view residue);

}  // namespace gaussmesh

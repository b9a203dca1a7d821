// The tables of radii, and the looking up.

#include "atoms/radii.h"

#include "atoms/residue_names.h"
#include "gaussmesh/error.h"
#include "gaussmesh/nearest_name.h"
#include "gaussmesh/read_atoms.h"
#include "text/text_lines.h"

namespace gaussmesh {
namespace {

struct ElementRadius {
  std::string_view element;
  double radius;
};

/// Radii by element. Bondi, J. Phys. Chem. 68:441 (1964), tables I, XIV and XV.
constexpr ElementRadius kBondi[] = {
    {"H", 1.20},  {"HE", 1.40}, {"LI", 1.82}, {"C", 1.70},  {"N", 1.55},  {"O", 1.52},  {"F", 1.47},  {"NE", 1.54},
    {"NA", 2.27}, {"MG", 1.73}, {"SI", 2.10}, {"P", 1.80},  {"S", 1.80},  {"CL", 1.75}, {"AR", 1.88}, {"K", 2.75},
    {"NI", 1.63}, {"CU", 1.40}, {"ZN", 1.39}, {"GA", 1.87}, {"AS", 1.85}, {"SE", 1.90}, {"BR", 1.85}, {"KR", 2.02},
    {"PD", 1.63}, {"AG", 1.72}, {"CD", 1.58}, {"IN", 1.93}, {"SN", 2.17}, {"TE", 2.06}, {"I", 1.98},  {"XE", 2.16},
    {"PT", 1.72}, {"AU", 1.66}, {"HG", 1.55}, {"TL", 1.96}, {"PB", 2.02}, {"U", 1.86}};

/// Elements of the main groups that Bondi left out, made to go with his. Mantina et al., J. Phys. Chem. A 113:5806
/// (2009), table 12. Of the other metals neither has more: iron and manganese stay without.
constexpr ElementRadius kMantina[] = {
    {"BE", 1.53}, {"B", 1.92},  {"AL", 1.84}, {"CA", 2.31}, {"GE", 2.11}, {"RB", 3.03}, {"SR", 2.49}, {"SB", 2.06},
    {"CS", 3.43}, {"BA", 2.68}, {"BI", 2.07}, {"PO", 1.97}, {"AT", 2.02}, {"RN", 2.20}, {"FR", 3.48}, {"RA", 2.83}};

/// The atoms of a residue: each radius (A), and the names of the atoms that have it, as the PDB has them since
/// 2007.
struct ResidueRadii {
  std::string_view residue;
  std::string_view radii;
};

/// R* of the AMBER force field: Cornell et al., J. Am. Chem. Soc. 117:5179 (1995), by atom types as PDB2PQR's
/// AMBER.DAT has them. Histidine has both hydrogens; ends of chains and protonated acids are included.
constexpr ResidueRadii kAmber[] = {
    {"ALA", "1.824 N 0.6 H H1 H2 H3 1.908 CA CB C 1.387 HA 1.487 HB1 HB2 HB3 1.6612 O OXT"},
    {"ARG",
     "1.824 N NE NH1 NH2 0.6 H HE HH11 HH12 HH21 HH22 H1 H2 H3 1.908 CA CB CG CD CZ C 1.387 HA "
     "HD2 HD3 1.487 HB2 HB3 HG2 HG3 1.6612 O OXT"},
    {"ASN",
     "1.824 N ND2 0.6 H HD21 HD22 H1 H2 H3 1.908 CA CB CG C 1.387 HA 1.487 HB2 HB3 1.6612 OD1 "
     "O OXT"},
    {"ASP",
     "1.824 N 0.6 H H1 H2 H3 1.908 CA CB CG C 1.387 HA 1.487 HB2 HB3 1.6612 OD1 OD2 O OXT 0 "
     "HD2"},
    {"CYS", "1.824 N 0.6 H HG H1 H2 H3 1.908 CA CB C 1.387 HA HB2 HB3 2. SG 1.6612 O OXT"},
    {"GLN",
     "1.824 N NE2 0.6 H HE21 HE22 H1 H2 H3 1.908 CA CB CG CD C 1.387 HA 1.487 HB2 HB3 HG2 HG3 "
     "1.6612 OE1 O OXT"},
    {"GLU",
     "1.824 N 0.6 H H1 H2 H3 1.908 CA CB CG CD C 1.387 HA 1.487 HB2 HB3 HG2 HG3 1.6612 OE1 OE2 "
     "O OXT 0 HE2"},
    {"GLY", "1.824 N 0.6 H H1 H2 H3 1.908 CA C 1.387 HA2 HA3 1.6612 O OXT"},
    {"HIS",
     "1.824 N ND1 NE2 0.6 H HD1 HE2 H1 H2 H3 1.908 CA CB CG CE1 CD2 C 1.387 HA 1.487 HB2 HB3 "
     "1.359 HE1 1.409 HD2 1.6612 O OXT"},
    {"ILE",
     "1.824 N 0.6 H H1 H2 H3 1.908 CA CB CG2 CG1 CD1 C 1.387 HA 1.487 HB HG21 HG22 HG23 HG12 "
     "HG13 HD11 HD12 HD13 1.6612 O OXT"},
    {"LEU",
     "1.824 N 0.6 H H1 H2 H3 1.908 CA CB CG CD1 CD2 C 1.387 HA 1.487 HB2 HB3 HG HD11 HD12 HD13 "
     "HD21 HD22 HD23 1.6612 O OXT"},
    {"LYS",
     "1.824 N NZ 0.6 H HZ1 HZ2 HZ3 H1 H2 H3 1.908 CA CB CG CD CE C 1.387 HA 1.487 HB2 HB3 HG2 "
     "HG3 HD2 HD3 1.1 HE2 HE3 1.6612 O OXT"},
    {"MET",
     "1.824 N 0.6 H H1 H2 H3 1.908 CA CB CG CE C 1.387 HA HG2 HG3 HE1 HE2 HE3 1.487 HB2 HB3 2. "
     "SD 1.6612 O OXT"},
    {"PHE",
     "1.824 N 0.6 H H1 H2 H3 1.908 CA CB CG CD1 CE1 CZ CE2 CD2 C 1.387 HA 1.487 HB2 HB3 1.459 "
     "HD1 HE1 HZ HE2 HD2 1.6612 O OXT"},
    {"PRO",
     "1.824 N 1.908 CD CG CB CA C 1.387 HD2 HD3 HA 1.487 HG2 HG3 HB2 HB3 1.6612 O OXT 0.6 H2 "
     "H3"},
    {"SER", "1.824 N 0.6 H H1 H2 H3 1.908 CA CB C 1.387 HA HB2 HB3 1.721 OG 0 HG 1.6612 O OXT"},
    {"THR",
     "1.824 N 0.6 H H1 H2 H3 1.908 CA CB CG2 C 1.387 HA HB 1.487 HG21 HG22 HG23 1.721 OG1 0 "
     "HG1 1.6612 O OXT"},
    {"TRP",
     "1.824 N NE1 0.6 H HE1 H1 H2 H3 1.908 CA CB CG CD1 CE2 CZ2 CH2 CZ3 CE3 CD2 C 1.387 HA "
     "1.487 HB2 HB3 1.409 HD1 1.459 HZ2 HH2 HZ3 HE3 1.6612 O OXT"},
    {"TYR",
     "1.824 N 0.6 H H1 H2 H3 1.908 CA CB CG CD1 CE1 CZ CE2 CD2 C 1.387 HA 1.487 HB2 HB3 1.459 "
     "HD1 HE1 HE2 HD2 1.721 OH 0 HH 1.6612 O OXT"},
    {"VAL",
     "1.824 N 0.6 H H1 H2 H3 1.908 CA CB CG1 CG2 C 1.387 HA 1.487 HB HG11 HG12 HG13 HG21 HG22 "
     "HG23 1.6612 O OXT"},
    {"A",
     "2.1 P 1.6612 OP1 OP2 1.6837 O5' O4' O3' 1.908 C5' C4' C1' C8 C5 C6 C2 C4 C3' C2' 1.387 "
     "H5' H5'' H4' H3' H2' 1.287 H1' 1.824 N9 N7 N6 N1 N3 1.359 H8 H2 0.6 H61 H62 1.721 O2' 0 "
     "HO2' HO5' HO3'"},
    {"C",
     "2.1 P 1.6612 OP1 OP2 O2 1.6837 O5' O4' O3' 1.908 C5' C4' C1' C6 C5 C4 C2 C3' C2' 1.387 "
     "H5' H5'' H4' H3' H2' 1.287 H1' 1.824 N1 N4 N3 1.409 H6 1.459 H5 0.6 H41 H42 1.721 O2' 0 "
     "HO2' HO5' HO3'"},
    {"G",
     "2.1 P 1.6612 OP1 OP2 O6 1.6837 O5' O4' O3' 1.908 C5' C4' C1' C8 C5 C6 C2 C4 C3' C2' "
     "1.387 H5' H5'' H4' H3' H2' 1.287 H1' 1.824 N9 N7 N1 N2 N3 1.359 H8 0.6 H1 H21 H22 1.721 "
     "O2' 0 HO2' HO5' HO3'"},
    {"U",
     "2.1 P 1.6612 OP1 OP2 O4 O2 1.6837 O5' O4' O3' 1.908 C5' C4' C1' C6 C5 C4 C2 C3' C2' "
     "1.387 H5' H5'' H4' H3' H2' 1.287 H1' 1.824 N1 N3 1.409 H6 1.459 H5 0.6 H3 1.721 O2' 0 "
     "HO2' HO5' HO3'"},
    {"DA",
     "2.1 P 1.6612 OP1 OP2 1.6837 O5' O4' O3' 1.908 C5' C4' C1' C8 C5 C6 C2 C4 C3' C2' 1.387 "
     "H5' H5'' H4' H3' 1.287 H1' 1.824 N9 N7 N6 N1 N3 1.359 H8 H2 0.6 H61 H62 1.487 H2' H2'' "
     "0 HO5' HO3'"},
    {"DC",
     "2.1 P 1.6612 OP1 OP2 O2 1.6837 O5' O4' O3' 1.908 C5' C4' C1' C6 C5 C4 C2 C3' C2' 1.387 "
     "H5' H5'' H4' H3' 1.287 H1' 1.824 N1 N4 N3 1.409 H6 1.459 H5 0.6 H41 H42 1.487 H2' H2'' "
     "0 HO5' HO3'"},
    {"DG",
     "2.1 P 1.6612 OP1 OP2 O6 1.6837 O5' O4' O3' 1.908 C5' C4' C1' C8 C5 C6 C2 C4 C3' C2' "
     "1.387 H5' H5'' H4' H3' 1.287 H1' 1.824 N9 N7 N1 N2 N3 1.359 H8 0.6 H1 H21 H22 1.487 H2' "
     "H2'' 0 HO5' HO3'"},
    {"DT",
     "2.1 P 1.6612 OP1 OP2 O4 O2 1.6837 O5' O4' O3' 1.908 C5' C4' C1' C6 C5 C7 C4 C2 C3' C2' "
     "1.387 H5' H5'' H4' H3' 1.287 H1' 1.824 N1 N3 1.409 H6 1.487 H71 H72 H73 H2' H2'' 0.6 H3 "
     "0 HO5' HO3'"},
};

/// Rmin/2 of the CHARMM force field: MacKerell et al., J. Phys. Chem. B 102:3586 (1998), and Foloppe, MacKerell, J.
/// Comput. Chem. 21:86 (2000) for nucleic acids, by atom types as PDB2PQR's CHARMM.DAT has them.
constexpr ResidueRadii kCharmm[] = {
    {"ALA", "1.85 N 0.2245 H H1 H2 H3 2.275 CA 1.32 HA HB1 HB2 HB3 2.06 CB 2. C 1.7 O OXT"},
    {"ARG",
     "1.85 N NE NH1 NH2 0.2245 H HE HH11 HH12 HH21 HH22 H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 HG2 "
     "HG3 HD2 HD3 2.175 CB CG CD 2. CZ C 1.7 O OXT"},
    {"ASN",
     "1.85 N ND2 0.2245 H HD21 HD22 H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 2.175 CB 2. CG C 1.7 OD1 "
     "O OXT"},
    {"ASP", "1.85 N 0.2245 H H1 H2 H3 HD2 2.275 CA 1.32 HA HB2 HB3 2.175 CB 2. CG C 1.7 OD1 OD2 O OXT"},
    {"CYS", "1.85 N 0.2245 H H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 2.175 CB 2. SG C 0.45 HG 1.7 O OXT"},
    {"GLN",
     "1.85 N NE2 0.2245 H HE21 HE22 H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 HG2 HG3 2.175 CB CG 2. "
     "CD C 1.7 OE1 O OXT"},
    {"GLU",
     "1.85 N 0.2245 H H1 H2 H3 HE2 2.275 CA 1.32 HA HB2 HB3 HG2 HG3 2.175 CB CG 2. CD C 1.7 "
     "OE1 OE2 O OXT"},
    {"GLY", "1.85 N 0.2245 H H1 H2 H3 2.175 CA 1.32 HA2 HA3 2. C 1.7 O OXT"},
    {"HIS",
     "1.85 N ND1 NE2 0.2245 H HD1 HE2 H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 2.175 CB 1.8 CG CE1 "
     "CD2 0.7 HE1 0.9 HD2 2. C 1.7 O OXT"},
    {"ILE",
     "1.85 N 0.2245 H H1 H2 H3 2.275 CA CB 1.32 HA HB HG21 HG22 HG23 HG12 HD11 HD12 HD13 HG13 "
     "2.06 CG2 CD1 2.175 CG1 2. C 1.7 O OXT"},
    {"LEU",
     "1.85 N 0.2245 H H1 H2 H3 2.275 CA CG 1.32 HA HB2 HB3 HG HD11 HD12 HD13 HD21 HD22 HD23 "
     "2.175 CB 2.06 CD1 CD2 2. C 1.7 O OXT"},
    {"LYS",
     "1.85 N NZ 0.2245 H HZ1 HZ2 HZ3 H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 HG2 HG3 HD2 HD3 HE2 HE3 "
     "2.175 CB CG CD CE 2. C 1.7 O OXT"},
    {"MET",
     "1.85 N 0.2245 H H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 HG2 HG3 HE1 HE2 HE3 2.175 CB CG 2. SD "
     "C 2.06 CE 1.7 O OXT"},
    {"PHE",
     "1.85 N 0.2245 H H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 2.175 CB 1.9924 CG CD1 CE1 CZ CE2 CD2 "
     "1.3582 HD1 HE1 HZ HE2 HD2 2. C 1.7 O OXT"},
    {"PRO",
     "1.85 N 2.175 CD CG CB 1.32 HD2 HD3 HG2 HG3 HB2 HB3 HA 2.275 CA 2. C 1.7 O OXT 0.2245 H2 "
     "H3"},
    {"SER", "1.85 N 0.2245 H HG H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 2.175 CB 1.77 OG 2. C 1.7 O OXT"},
    {"THR",
     "1.85 N 0.2245 H HG1 H1 H2 H3 2.275 CA CB 1.32 HA HB HG21 HG22 HG23 2.06 CG2 1.77 OG1 2. "
     "C 1.7 O OXT"},
    {"TRP",
     "1.85 N NE1 0.2245 H HE1 H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 2.175 CB 1.9924 CG CD1 CZ2 CH2 "
     "CZ3 CE3 1.3582 HD1 HZ2 HH2 HZ3 HE3 1.8 CE2 CD2 2. C 1.7 O OXT"},
    {"TYR",
     "1.85 N 0.2245 H HH H1 H2 H3 2.275 CA 1.32 HA HB2 HB3 2.175 CB 1.9924 CG CD1 CE1 CZ CE2 "
     "CD2 1.3582 HD1 HE1 HE2 HD2 1.77 OH 2. C 1.7 O OXT"},
    {"VAL",
     "1.85 N 0.2245 H H1 H2 H3 2.275 CA CB 1.32 HA HB HG11 HG12 HG13 HG21 HG22 HG23 2.06 CG1 "
     "CG2 2. C 1.7 O OXT"},
    {"A",
     "2.15 P 1.7 OP1 OP2 1.77 O5' O4' O2' O3' 2.01 C5' 1.34 H5' H5'' 2.275 C4' C1' C3' C2' "
     "1.32 H4' H1' H3' H2' 1.85 N9 N7 N6 N1 N3 1.9 C8 C5 C6 C2 C4 1.1 H8 H2 0.2245 H61 H62 "
     "HO2' HO5' HO3'"},
    {"C",
     "2.15 P 1.7 OP1 OP2 O2 1.77 O5' O4' O2' O3' 2.01 C5' 1.34 H5' H5'' 2.275 C4' C1' C3' C2' "
     "1.32 H4' H1' H3' H2' 1.85 N1 N4 N3 1.9 C6 C5 C4 C2 1.1 H6 H5 0.2245 H41 H42 HO2' HO5' "
     "HO3'"},
    {"G",
     "2.15 P 1.7 OP1 OP2 O6 1.77 O5' O4' O2' O3' 2.01 C5' 1.34 H5' H5'' 2.275 C4' C1' C3' C2' "
     "1.32 H4' H1' H3' H2' 1.85 N9 N7 N1 N2 N3 1.9 C8 C5 C6 C2 C4 1.1 H8 0.2245 H1 H21 H22 "
     "HO2' HO5' HO3'"},
    {"U",
     "2.15 P 1.7 OP1 OP2 O4 O2 1.77 O5' O4' O2' O3' 2.01 C5' 1.34 H5' H5'' 2.275 C4' C1' C3' "
     "C2' 1.32 H4' H1' H3' H2' 1.85 N1 N3 1.9 C6 C5 C4 C2 1.1 H6 H5 0.2245 H3 HO2' HO5' HO3'"},
    {"DA",
     "2.15 P 1.7 OP1 OP2 1.77 O5' O4' O3' 2.01 C5' 1.34 H5' H5'' H2' H2'' 2.275 C4' C1' C3' "
     "C2' 1.32 H4' H1' H3' 1.85 N9 N7 N6 N1 N3 1.9 C8 C5 C6 C2 C4 1.1 H8 H2 0.2245 H61 H62 "
     "HO5' HO3'"},
    {"DC",
     "2.15 P 1.7 OP1 OP2 O2 1.77 O5' O4' O3' 2.01 C5' 1.34 H5' H5'' H2' H2'' 2.275 C4' C1' C3' "
     "C2' 1.32 H4' H1' H3' 1.85 N1 N4 N3 1.9 C6 C5 C4 C2 1.1 H6 H5 0.2245 H41 H42 HO5' HO3'"},
    {"DG",
     "2.15 P 1.7 OP1 OP2 O6 1.77 O5' O4' O3' 2.01 C5' 1.34 H5' H5'' H2' H2'' 2.275 C4' C1' C3' "
     "C2' 1.32 H4' H1' H3' 1.85 N9 N7 N1 N2 N3 1.9 C8 C5 C6 C2 C4 1.1 H8 0.2245 H1 H21 H22 "
     "HO5' HO3'"},
    {"DT",
     "2.15 P 1.7 OP1 OP2 O4 O2 1.77 O5' O4' O3' 2.01 C5' 1.34 H5' H5'' H71 H72 H73 H2' H2'' "
     "2.275 C4' C1' C3' C2' 1.32 H4' H1' H3' 1.85 N1 N3 1.9 C6 C5 C4 C2 1.1 H6 2.04 C7 0.2245 "
     "H3 HO5' HO3'"},
};

}  // namespace

const std::vector<std::string>& radius_set_names() {
  static const std::vector<std::string> names = {"bondi", "amber", "charmm"};
  return names;
}

RadiusSet::RadiusSet(const std::string& name) : name_(name) {
  if (name == "bondi") {
    for (const ElementRadius& entry : kBondi) radii_.emplace(entry.element, entry.radius);
    for (const ElementRadius& entry : kMantina) radii_.emplace(entry.element, entry.radius);
    radii_.emplace("D", radii_.at("H"));
    return;
  }
  if (name != "amber" && name != "charmm") {
    throw OptionError("radii: expected bondi, amber or charmm, got '" + name + "'" +
                      did_you_mean(name, radius_set_names()));
  }
  is_by_residue_ = true;
  const std::span<const ResidueRadii> table = name == "amber" ? std::span<const ResidueRadii>(kAmber) : kCharmm;
  FieldSplitter splitter;
  for (const ResidueRadii& residue : table) {
    double radius = 0.0;
    for (const std::string_view word : splitter.split(residue.radii)) {
      if (const auto number = parse_number(word)) {
        radius = *number;
      } else {
        radii_.emplace(std::string(residue.residue) + " " + std::string(word), radius);
      }
    }
  }
}

std::optional<double> RadiusSet::find_entry(std::string_view key) const {
  const auto entry = radii_.find(key);
  return entry == radii_.end() ? std::nullopt : std::optional<double>(entry->second);
}

std::optional<double> RadiusSet::find(std::string_view residue, std::string_view atom, std::string_view element) const {
  if (!is_by_residue_) return find_entry(upper_case(element));
  const std::string own_residue = upper_case(residue);
  const std::string own_atom = upper_case(atom);
  const std::string canonical_name(canonical_atom(own_atom));
  for (const std::string& residue_name : {own_residue, std::string(canonical_residue(own_residue))}) {
    for (const std::string& atom_name : {own_atom, canonical_name}) {
      std::string key = residue_name;
      key.append(" ").append(atom_name);
      if (const auto radius = find_entry(key)) return radius;
    }
  }
  return std::nullopt;
}

}  // namespace gaussmesh

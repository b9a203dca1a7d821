// Reading atoms from files: PQR, as many programs write it, XYZR, and PDB and mmCIF with radii from a named set or a
// file.
//
// Every error and warning names the file and, where there is one, the line. Nothing is guessed: a record that
// cannot be read in one way only is an error, and what is left out of a file is told in a warning.
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "gaussmesh/atom.h"

namespace gaussmesh {

/// What a file calls an atom. Empty is what it does not say, or where it is not clear.
struct AtomName {
  std::string name;
  std::string residue;
  std::string chain;
  std::string number;  ///< of the residue, with its insertion code
};

/// What a reader found.
struct AtomFile {
  std::vector<Atom> atoms;            ///< in the order of the file; at least one
  std::vector<std::size_t> lines;     ///< of each atom, from 1; of mmCIF its number in the table, from 1
  std::vector<AtomName> names;        ///< of each atom if they are to be kept; else, and of XYZR, empty
  std::vector<std::string> warnings;  ///< `file:line: ...`, each worth a line on the terminal
};

/// Largest coordinate (A) that is read, in absolute value.
inline constexpr double kLargestCoordinate = 1e6;

/// Largest radius (A) that is read.
inline constexpr double kLargestRadius = 1e5;

/// Radii (A) above this are read but warned of: atoms stay below 4 A, residues as one bead below 6 A.
inline constexpr double kSuspectRadius = 10.0;

/// Whether names are kept: some 130 bytes for each atom, which no stage of meshing needs.
enum class AtomNames { kLeaveOut, kKeep };

struct ReadOptions {
  std::string format;  ///< one of atom_formats(); empty: the name decides
  std::string radii;   ///< one of radius_set_names(), for PDB and mmCIF; other files have radii of their own

  /// A file of radii for PDB and mmCIF, whose entries come before those of `radii`, which may then be empty.
  ///
  /// A line is `[residue] name radius` (A): the name of an atom, or an element, in any case; `#` starts a comment.
  /// For an atom the first of these is taken: residue and name, residue and element, name, element. So `CA 2.3` is
  /// every alpha carbon, and `CA CA 2.3` a calcium ion. Any other line, a radius out of range and an entry that stands
  /// twice are an InputError. A warning names entries of a residue that the molecule has, but not with such an atom;
  /// since tables may be made for all molecules, not hydrogens, nor amino acids and nucleotides of which others fit.
  std::filesystem::path radii_file = {};

  AtomNames names = AtomNames::kLeaveOut;
};

/// pqr, xyzr, pdb, mmcif.
const std::vector<std::string>& atom_formats();

/// bondi, amber, charmm.
const std::vector<std::string>& radius_set_names();

/// Reads a file of atoms, plain or gzipped.
///
/// Names that end in `.xyzr`, `.xyzrn` or `.xyzrq` are XYZR, in `.pdb`, `.ent` or `.pdbqt` PDB, in `.cif` or `.mmcif`
/// mmCIF, in any case and perhaps with `.gz` behind; every other is PQR, but for those of formats that are not read
/// (`.gro`, `.mol2`, `.sdf`, `.xyz`, ...). Gzip is known by its first bytes, whatever the name; data that expand to
/// more than 64 MiB and 200-fold are refused.
///
/// A warning names the first atom nearer than 0.1 A to one before it, and counts them: copies and alternate locations
/// are all in the field.
///
/// @throws OptionError if a format or set of radii is unknown, no radii are given for PDB or mmCIF, or any for PQR or
///         XYZR
/// @throws InputError as the parsers do, if the name is one of a format that is not read, and if the file is missing, a
///         directory, unreadable, or corrupt gzip
///
/// Cost: one pass over the file held in memory; a million atoms take about 0.3 s, as PDB, whose
/// alternate locations are compared, some 1.5 s.
/// Thread-safe. Does not depend on the locale.
AtomFile read_atoms(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads what is left of `input` (say, standard input), as above; `name` stands for the file.
AtomFile read_atoms(std::istream& input, std::string_view name, const ReadOptions& options = {});

/// Reads PQR text that is already in memory; `name` stands for the file in messages.
///
/// An atom is a line that begins with ATOM or HETATM, in any case, indented or not, the serial number glued to it
/// or not. Fields are separated by blanks or tabs:
///
///     ATOM serial name residue [chain] number [insertion code] x y z charge radius [symbols] [# comment]
///
/// - The numbers are the last five fields, not counting names behind them that begin with a letter (element,
///   segment). Names may be glued to each other, and chain or insertion code to the residue number, as PDB columns
///   allow. Coordinates that run together are read from the PDB columns 31-54, or from 32-55 where pdb2pqr puts
///   them without chains. An integer x in a record with fewer names than others of the file is refused, since the
///   chain may be a number and a value missing.
/// - Numbers may have an exponent, with E or Fortran's D; they must be finite and fit a double. Coordinates lie
///   within +-kLargestCoordinate, radii in [0, kLargestRadius]. A radius of 0 is normal.
/// - Lines end in LF, CRLF or CR. A UTF-8 byte order mark is skipped.
/// - Of several models (MODEL ... ENDMDL) the first is read; a warning counts the atoms left out. Reading goes on
///   after TER and after END; atoms after END are warned of, since files of a complex are often joined so. But where
///   they are those before END over again, by name and in the same order, they may be other frames, copies, or other
///   molecules of the same kind: that is an error. Alternate locations are all read.
/// - Blank lines, # comments and the other records of PDB are passed over; a warning counts lines of any other
///   kind.
/// - A warning names the first radius above kSuspectRadius, and the largest. A file of at least 4 atoms whose
///   charges and radii are the occupancies and B-factors of a PDB file is an error: all have two decimals, charges
///   are in [0, 1] and at least half of them 1.00, and either a radius is above kSuspectRadius, or all are 0, or
///   each record ends in an element symbol in columns 77-78.
///
/// @throws InputError  on anything else in an atom record, above all a missing field; on text without atoms; on
///                     UTF-16, NUL bytes, PQR-XML and mmCIF
AtomFile parse_pqr(std::string_view text, std::string_view name, AtomNames names = AtomNames::kLeaveOut);

/// Reads XYZR text that is already in memory; `name` stands for the file in messages.
///
/// A line is `x y z radius` (A), separated by blanks or tabs; other fields may follow, as the flag and name of MSMS's
/// xyzrn, or NanoShaper's charge, and are passed over. `#` starts a comment. The first line may be the number of atoms
/// alone, and must then be right. Charges are 0. Numbers, line ends and large radii are as in parse_pqr.
///
/// @throws InputError  on any other line, a wrong number of atoms, text without atoms, UTF-16 and NUL bytes; on four
///                     lines or more of five numbers that begin with 0 or 1, the next integer, and so on: they are
///                     numbers of atoms, and x y z radius behind
AtomFile parse_xyzr(std::string_view text, std::string_view name);

/// Reads PDB text that is already in memory.
///
/// ATOM and HETATM records, in any case, are read by their columns. They may be indented, and their serial number may
/// take more than its columns, if the decimal points of the coordinates tell where the columns are then. The first
/// model is taken, which ends at ENDMDL, END or the next MODEL, and no water (HOH, WAT, TIP3, SOL, ...). Of alternate
/// locations each atom is taken at one: that which comes first in its residue, or if the atom has not got that, the
/// first that it has. To have none counts as a location of atoms that also stand there with one. Of a residue that is
/// of one kind at one location and of another at the next, the first kind is taken. Warnings count what is left out.
/// Hydrogens are taken if they are there; none are added. Charges are 0. Behind END there may be other frames of the
/// same atoms; what has other atoms was joined from several files, and is refused. A warning counts lines that are no
/// records of PDB. Radii come from a file, as ReadOptions has it, or from a set:
///
/// - bondi: by element, which is in columns 77-78, or known from the names of atom and residue where that is clear;
///   Bondi, J. Phys. Chem. 68:441 (1964), and for elements of the main groups that he has not, such as calcium,
///   Mantina et al., J. Phys. Chem. A 113:5806 (2009); of transition metals Ni, Cu, Zn, Pd, Ag, Cd, Pt, Au and Hg alone
///   are in these
/// - amber: amino acids and nucleotides, R* by atom type; Cornell et al., J. Am. Chem. Soc. 117:5179 (1995)
/// - charmm: the same, Rmin/2; MacKerell et al., J. Phys. Chem. B 102:3586 (1998)
///
/// The latter two know residues and atoms by other names too where they have no entry for these: HID, HIE, HIP, HSD,
/// HSE and HSP are HIS, CYX and CYM CYS, ASH ASP, GLH GLU, LYN LYS, MSE MET with SE for SD; HN is H, OT1 and OT2 are O
/// and OXT, O1P and O2P are OP1 and OP2.
///
/// @throws OptionError  if there is no such set
/// @throws InputError   if an atom record is not in its columns, a coordinate is no number or out of range, there is no
///                      atom, or no radius for some: the message has them as lines for a file of radii; on atoms behind
///                      END that are not before it; on mmCIF and XML
AtomFile parse_pdb(std::string_view text, std::string_view name, const std::string& radii,
                   const std::filesystem::path& radii_file = {}, AtomNames names = AtomNames::kLeaveOut);

/// Reads mmCIF text that is already in memory: its loop _atom_site, as parse_pdb does. Where that has no label_atom_id
/// or label_comp_id, the tags of the authors (auth_...) are read instead. Coordinates may have a standard uncertainty,
/// as `19.594(5)`. Names that are kept have the authors' chains and numbers, which PDB files of the same entry have.
///
/// @throws InputError  as parse_pdb does, and if the text is no CIF, a column is missing, or several blocks have atoms
AtomFile parse_mmcif(std::string_view text, std::string_view name, const std::string& radii,
                     const std::filesystem::path& radii_file = {}, AtomNames names = AtomNames::kLeaveOut);

}  // namespace gaussmesh

// What the commands that read a molecule share.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gaussmesh/read_atoms.h"

namespace gaussmesh::app {

struct MoleculeOptions {
  ReadOptions reading;
  std::optional<double> probe;  ///< A, added to every radius
};

/// What help says of a molecule.
inline constexpr const char* kMoleculeHelp = "PQR, XYZR, PDB or mmCIF file, plain or gzipped; -: standard input";

/// Adds --radii, --radii-file, --input-format and --probe; `options` must outlive the command. @return the options
std::vector<CLI::Option*> add_molecule_options(CLI::App& command, MoleculeOptions& options);

/// What is read for the molecule, and must not be written over; names may be empty.
std::vector<std::string> files_of_molecule(const std::string& path, const MoleculeOptions& options);

/// What becomes of the warnings of a reader.
enum class Warnings { kPrint, kKeepBack };

/// Reads the molecule, prints its warnings on standard error if they are to be, and adds the probe.
/// @throws InputError, OptionError
AtomFile read_molecule(const std::string& path, const MoleculeOptions& options, Warnings warnings = Warnings::kPrint);

}  // namespace gaussmesh::app

#include "molecule_options.h"

#include <iostream>

#include "validators.h"

namespace gaussmesh::app {

std::vector<CLI::Option*> add_molecule_options(CLI::App& command, MoleculeOptions& options) {
  return {
      command
          .add_option("--radii", options.reading.radii,
                      "radii of a PDB or mmCIF file: " + join_names(radius_set_names(), ", ") +
                          " (required for these, or --radii-file; others have their own)")
          ->type_name("NAME")
          ->check(one_of(radius_set_names())),
      command
          .add_option_function<std::string>(
              "--radii-file", [&options](const std::string& file) { options.reading.radii_file = file; },
              "lines of [RESIDUE] NAME-or-ELEMENT radius (A): radii that come before those of --radii, or stand alone "
              "(default: none)")
          ->type_name("FILE")
          ->check(file_name_of_option()),
      command
          .add_option("--input-format", options.reading.format,
                      join_names(atom_formats(), ", ") + " (default: by the extension, else PQR)")
          ->type_name("NAME")
          ->check(one_of(atom_formats())),
      command
          .add_option("--probe", options.probe,
                      "added to every radius, say for a Stern layer (A, 0 to 1000; default: 0)")
          ->type_name("R")
          ->check(number_between(0.0, 1000.0))};
}

std::vector<std::string> files_of_molecule(const std::string& path, const MoleculeOptions& options) {
  return {path, options.reading.radii_file.string()};
}

AtomFile read_molecule(const std::string& path, const MoleculeOptions& options, Warnings warnings) {
  AtomFile input =
      path == "-" ? read_atoms(std::cin, "standard input", options.reading) : read_atoms(path, options.reading);
  if (warnings == Warnings::kPrint)
    for (const std::string& warning : input.warnings) std::cerr << "gaussmesh: warning: " << warning << "\n";
  input.atoms = add_probe(std::move(input.atoms), options.probe.value_or(0.0));
  return input;
}

}  // namespace gaussmesh::app

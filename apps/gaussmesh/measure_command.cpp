#include "measure_command.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include "exit_code.h"
#include "gaussmesh/check_mesh.h"
#include "gaussmesh/error.h"
#include "gaussmesh/measure_mesh.h"
#include "gaussmesh/write_mesh.h"
#include "output_options.h"
#include "report_parts.h"
#include "threads.h"
#include "validators.h"

namespace gaussmesh::app {
namespace {

struct Measured {
  std::string name;
  MeshCheck mesh;
  std::optional<AtomMeasures> by_atoms;  ///< there if a molecule was given
};

std::string measured_text(const Measured& found) {
  std::string text = found.name + ": " + size_text(found.mesh) + "\n" + components_text(found.mesh);
  if (!all_are_closed(found.mesh)) text += "  WARNING: the volume of what is not closed says nothing\n";
  if (!found.by_atoms) return text;
  const AtomMeasures& atoms = *found.by_atoms;
  const auto exposed = std::count_if(atoms.areas.begin(), atoms.areas.end(), [](double area) { return area > 0.0; });
  text += line("Atoms with a share of the area: %td of %zu\n", exposed, atoms.areas.size());
  return text + (atoms.vdw_distance
                     ? line("Mean relative distance from the van der Waals spheres: %.4f\n", *atoms.vdw_distance)
                     : "Mean relative distance from the van der Waals spheres: none, no radius is above 0\n");
}

std::string measured_json(const Measured& found) {
  Json json = {{"mesh", found.name},
               {"vertices", found.mesh.vertices},
               {"triangles", found.mesh.triangles},
               {"closed", all_are_closed(found.mesh)},
               {"chi", found.mesh.chi},
               {"area_A2", found.mesh.area},
               {"volume_A3", found.mesh.volume},
               {"components", components_json(found.mesh)}};
  if (found.by_atoms) {
    const auto& distance = found.by_atoms->vdw_distance;
    json["mean_relative_vdw_distance"] = distance ? Json(*distance) : Json();
    json["atom_areas_A2"] = found.by_atoms->areas;
  }
  return json_text(json);
}

/// A name as one field of a table; a dot stands for none, as in mmCIF.
std::string field(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return " " + (name.empty() ? "." : name);
}

/// One line for each atom: its number, counted from 1 in the order of the file, its area, and what the file calls it.
/// @param names  as many as areas, or none
std::string areas_text(const std::vector<double>& areas, const std::vector<AtomName>& names) {
  std::string text;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const AtomName atom = names.empty() ? AtomName{} : names[i];
    text += line("%zu %.6f", i + 1, areas[i]) + field(atom.name) + field(atom.residue) + field(atom.chain) +
            field(atom.number) + "\n";
  }
  return text;
}

}  // namespace

CLI::App* add_measure_command(CLI::App& program, MeasureCommand& command) {
  CLI::App* app = program.add_subcommand("measure", "area and volume of a mesh, in all and at each atom");
  app->add_option("mesh", command.mesh, "mesh, in any format that convert reads; -: standard input")
      ->type_name("MESH")
      ->check(file_name())
      ->required();
  CLI::Option* molecule = app->add_option("molecule", command.molecule, "its molecule: PQR, XYZR, PDB, mmCIF")
                              ->type_name("MOL")
                              ->check(file_name());
  app->add_option(
         "--atom-areas", command.atom_areas,
         "write a line for each atom: its number, counted from 1, the area nearest to it (A^2), and its name, residue, "
         "chain and residue number, . for what MOL does not say (default: none)")
      ->type_name("FILE")
      ->check(file_name_of_option())
      ->needs(molecule);
  for (CLI::Option* option : add_molecule_options(*app, command.reading)) option->needs(molecule);
  add_json_option(*app, command.json);
  add_threads_option(*app, command.threads);
  app->footer(
      "Area and volume are given for each component too; a cavity's volume is negative. With a molecule: the area "
      "that\n"
      "is nearest to each atom, and the mean over the vertices of the distance from the nearest atom's centre over "
      "its\n"
      "radius, less 1; atoms of radius 0 do not count in that.\n\n"
      "Example:  gaussmesh measure out.off in.pqr --atom-areas areas.txt");
  return app;
}

int run_measure(const MeasureCommand& command) {
  std::vector<std::string> inputs = files_of_molecule(command.molecule.value_or(""), command.reading);
  inputs.push_back(command.mesh);
  require_files(inputs, {command.json.value_or(""), command.atom_areas.value_or("")});
  take_threads(command.threads);
  const TriangleMesh mesh = read_mesh_argument(command.mesh).mesh;
  Measured found{command.mesh, check_mesh(mesh), std::nullopt};
  if (found.mesh.bad_indices > 0 || found.mesh.bad_coordinates > 0)
    throw InputError(command.mesh + ": expected a mesh to measure, got " +
                     counted(found.mesh.bad_indices, "triangle that names a missing vertex",
                             "triangles that name a missing vertex") +
                     " and " +
                     counted(found.mesh.bad_coordinates, "vertex without usable coordinates",
                             "vertices without usable coordinates"));
  AtomFile molecule;
  if (command.molecule) {
    MoleculeOptions reading = command.reading;
    if (command.atom_areas) reading.reading.names = AtomNames::kKeep;
    molecule = read_molecule(*command.molecule, reading);
    found.by_atoms = measure_by_atoms(mesh, molecule.atoms);
  }
  OutputFiles files;
  if (command.atom_areas) files.add_text(areas_text(found.by_atoms->areas, molecule.names), *command.atom_areas);
  const bool is_taken = is_standard_output(command.atom_areas.value_or(""));
  put_report(measured_text(found), measured_json(found), command.json, is_taken ? std::cerr : std::cout,
             std::move(files));
  return kGood;
}

}  // namespace gaussmesh::app

#include "convert_command.h"

#include "gaussmesh/error.h"
#include "gaussmesh/read_mesh.h"
#include "output_options.h"

namespace gaussmesh::app {

CLI::App* add_convert_command(CLI::App& program, ConvertOptions& options) {
  CLI::App* command = program.add_subcommand("convert", "write a mesh in other formats");
  command
      ->add_option("input", options.input,
                   "mesh to read: OFF, PLY, OBJ, STL, Gmsh .msh, .smesh, MSMS; also gzipped")
      ->type_name("MESH")
      ->required();
  command->add_option("output", options.outputs, "meshes to write; -: standard output")
      ->type_name("OUT...")
      ->required();
  CLI::Option* molecule = command
                              ->add_option("--molecule", options.molecule,
                                           "molecule of the mesh, for the nearest atoms that MSMS holds")
                              ->type_name("MOL");
  for (CLI::Option* option : add_molecule_options(*command, options.reading)) option->needs(molecule);
  add_format_options(*command, options.writing, options.no_header);
  return command;
}

int run_convert(const ConvertOptions& options) {
  const WriteOptions writing = writing_options(options.writing, options.no_header);
  require_writable_outputs(options.outputs, "", writing);
  MeshFile file = read_mesh(options.input);
  const MeshCheck check = check_mesh(file.mesh);
  if (check.bad_indices > 0) {
    throw InputError(options.input + ": expected vertices for all triangles, got none for " +
                     std::to_string(check.bad_indices) + " of them");
  }
  if (file.data.components.empty()) file.data.components = find_vertex_components(file.mesh, check);
  if (options.molecule) {
    const std::vector<Atom> atoms = read_molecule(*options.molecule, options.reading, false);
    file.data.atoms = find_nearest_atoms(file.mesh, atoms, 0);
  }
  OutputFiles files;
  for (const std::string& output : options.outputs) files.add_mesh(file.mesh, file.data, output, writing);
  files.commit();
  return 0;
}

}  // namespace gaussmesh::app

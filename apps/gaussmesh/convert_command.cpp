#include "convert_command.h"

#include <algorithm>

#include "exit_code.h"
#include "gaussmesh/error.h"
#include "output_options.h"
#include "report_parts.h"
#include "validators.h"

namespace gaussmesh::app {
namespace {

bool needs_normals(const std::vector<std::string>& outputs, const WriteOptions& writing) {
  return std::any_of(outputs.begin(), outputs.end(),
                     [&](const std::string& output) { return format_of(output, writing).held != HeldData::kNothing; });
}

}  // namespace

CLI::App* add_convert_command(CLI::App& program, ConvertOptions& options) {
  CLI::App* command = program.add_subcommand("convert", "write a mesh in other formats");
  command
      ->add_option(
          "input", options.input,
          "mesh to read: OFF, PLY, OBJ, STL, VTP, Gmsh .msh, .smesh, MSMS, each also gzipped; -: standard input")
      ->type_name("MESH")
      ->check(file_name())
      ->required();
  command->add_option("output", options.outputs, "meshes to write, gzipped if they end in .gz; -: standard output")
      ->type_name("OUT...")
      ->check(file_name())
      ->required();
  CLI::Option* molecule =
      command->add_option("--molecule", options.molecule, "molecule of the mesh, for the nearest atoms (default: none)")
          ->type_name("MOL")
          ->check(file_name_of_option());
  for (CLI::Option* option : add_molecule_options(*command, options.reading)) option->needs(molecule);
  add_format_options(*command, options.writing);
  command->footer(
      "Without a molecule, nearest atoms are those that the input has, if any. Normals that it has not are averaged\n"
      "over the triangles.\n\n"
      "Examples:\n"
      "  gaussmesh convert out.vert out.ply out.vtp\n"
      "  gaussmesh convert out.off out.vert --molecule in.pqr --no-header\n"
      "  gaussmesh convert out.ply - --format off | less");
  return command;
}

int run_convert(const ConvertOptions& options) {
  const WriteOptions& writing = options.writing;
  require_header_to_leave_out(options.outputs, writing);
  // The mesh itself may be written over: all of it has been read by then.
  require_writable_outputs(options.outputs, "", writing,
                           files_of_molecule(options.molecule.value_or(""), options.reading));
  MeshFile file = read_mesh_argument(options.input);
  const MeshCheck check = check_mesh(file.mesh);
  if (check.bad_indices > 0) {
    throw InputError(options.input + ": expected vertices for all triangles, got none for " +
                     std::to_string(check.bad_indices) + " of them");
  }
  if (file.data.components.empty()) file.data.components = find_vertex_components(file.mesh, check);
  if (options.molecule) {
    const std::vector<Atom> atoms = read_molecule(*options.molecule, options.reading).atoms;
    file.data.atoms = find_nearest_atoms(file.mesh, atoms, 0);
  }
  if (file.data.normals.empty() && needs_normals(options.outputs, writing)) {
    file.data.normals = average_normals(file.mesh);
  }
  OutputFiles files;
  for (const std::string& output : options.outputs) files.add_mesh(file.mesh, file.data, output, writing);
  files.commit();
  return kGood;
}

}  // namespace gaussmesh::app

#include "convert_command.h"

#include <algorithm>

#include "exit_code.h"
#include "gaussmesh/error.h"
#include "output_options.h"
#include "report_parts.h"
#include "threads.h"
#include "validators.h"

namespace gaussmesh::app {
namespace {

bool needs_normals(const std::vector<std::string>& outputs, const WriteOptions& writing) {
  return std::any_of(outputs.begin(), outputs.end(),
                     [&](const std::string& output) { return format_of(output, writing).held != HeldData::kNothing; });
}

}  // namespace

CLI::App* add_convert_command(CLI::App& program, ConvertCommand& command) {
  CLI::App* app = program.add_subcommand("convert", "write a mesh in other formats");
  app->add_option(
         "input", command.input,
         "mesh to read: OFF, PLY, OBJ, STL, VTP, Gmsh .msh, .smesh, MSMS, each also gzipped; -: standard input")
      ->type_name("MESH")
      ->check(file_name())
      ->required();
  app->add_option("output", command.outputs, "meshes to write, gzipped if they end in .gz; -: standard output")
      ->type_name("OUT...")
      ->check(file_name())
      ->required();
  CLI::Option* molecule =
      app->add_option("--molecule", command.molecule, "molecule of the mesh, for the nearest atoms (default: none)")
          ->type_name("MOL")
          ->check(file_name_of_option());
  for (CLI::Option* option : add_molecule_options(*app, command.reading)) option->needs(molecule);
  add_format_options(*app, command.writing);
  add_threads_option(*app, command.writing.threads);
  app->footer(
      "Without a molecule, nearest atoms are those that the input has, if any. Normals that it has not are averaged\n"
      "over the triangles.\n\n"
      "Examples:\n"
      "  gaussmesh convert out.vert out.ply out.vtp\n"
      "  gaussmesh convert out.off out.vert --molecule in.pqr --no-header\n"
      "  gaussmesh convert out.ply - --format off | less");
  return app;
}

int run_convert(const ConvertCommand& command) {
  WriteOptions writing = command.writing;
  require_header_to_leave_out(command.outputs, writing);
  const std::vector<std::string> outputs = without_second_names(command.outputs, writing);
  // The mesh itself may be written over: all of it has been read by then.
  require_writable_outputs(outputs, "", writing, files_of_molecule(command.molecule.value_or(""), command.reading));
  writing.threads = take_threads(command.writing.threads);
  MeshFile file = read_mesh_argument(command.input);
  const MeshCheck check = check_mesh(file.mesh);
  if (check.bad_indices > 0) {
    throw InputError(command.input + ": expected vertices for all triangles, got none for " +
                     std::to_string(check.bad_indices) + " of them");
  }
  if (file.data.components.empty()) file.data.components = find_vertex_components(file.mesh, check);
  if (command.molecule) {
    const std::vector<Atom> atoms = read_molecule(*command.molecule, command.reading).atoms;
    file.data.atoms = find_nearest_atoms(file.mesh, atoms, writing.threads);
    file.data.atom_count = atoms.size();
  }
  if (file.data.normals.empty() && needs_normals(outputs, writing)) {
    file.data.normals = average_normals(file.mesh);
  }
  OutputFiles files;
  for (const std::string& output : outputs) files.add_mesh(file.mesh, file.data, output, writing);
  files.commit();
  return kGood;
}

}  // namespace gaussmesh::app

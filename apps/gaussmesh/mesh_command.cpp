#include "mesh_command.h"

#include <iostream>

#include "gaussmesh/error.h"
#include "gaussmesh/read_atoms.h"
#include "output_options.h"

namespace gaussmesh::app {

void add_mesh_options(CLI::App& program, MeshCommand& command) {
  program.add_option("molecule", command.molecule, "PQR or XYZR file, plain or gzipped")->type_name("MOL");
  program
      .add_option("-o,--output", command.outputs, "mesh to write; may be given several times; -: standard output")
      ->type_name("FILE")
      ->take_all();
  add_format_options(program, command.writing, command.no_header);
  program.add_option("--d,--decay", command.options.decay, "decay d of the Gaussians (1/A^2, 0.001 to 1000)")
      ->type_name("D")
      ->capture_default_str();
  program.add_option("--c,--isovalue", command.options.isovalue, "isovalue c of the surface (1e-9 to 1e9)")
      ->type_name("C")
      ->capture_default_str();
  program.add_option("--spacing", command.options.spacing, "size of the triangles (A, 0.01 to 1000)")
      ->type_name("H")
      ->capture_default_str();
  program.add_flag("--improve", command.options.improve, "make the triangles nearly equilateral (experimental)");
  program.add_option("--threads", command.options.threads, "threads (0: one for each processor)")
      ->type_name("N")
      ->capture_default_str();
  program.add_option("--report", command.report, "write everything that is known of the mesh, JSON")
      ->type_name("FILE");
  program.add_flag("--allow-uncertified", command.options.allow_uncertified,
                   "where c is too near a critical value for a proof, mesh a level beside it");
}

int run_mesh(const MeshCommand& command) {
  if (command.molecule.empty()) throw OptionError("MOL: expected a PQR or XYZR file, got nothing; see --help");
  if (command.outputs.empty()) throw OptionError("-o: expected a file to write, got nothing");
  const WriteOptions writing = writing_options(command.writing, command.no_header);
  require_writable_outputs(command.outputs, command.report, writing);
  const AtomFile input = read_atoms(command.molecule);
  for (const std::string& warning : input.warnings) std::cerr << "gaussmesh: warning: " << warning << "\n";
  const MeshResult result = mesh_surface(input.atoms, command.options);
  const VertexData data = {result.normals, find_nearest_atoms(result.mesh, input.atoms, command.options.threads),
                           find_vertex_components(result.mesh, result.report.check)};
  OutputFiles files;
  for (const std::string& output : command.outputs) files.add_mesh(result.mesh, data, output, writing);
  if (!command.report.empty()) files.add_text(report_json(result.report), command.report);
  files.commit();
  std::cout << command.outputs.front() << ": " << report_summary(result.report);
  return 0;
}

}  // namespace gaussmesh::app

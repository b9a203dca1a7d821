#include "check_command.h"

#include "check_report.h"
#include "exit_code.h"
#include "output_options.h"
#include "report_parts.h"
#include "threads.h"
#include "validators.h"

namespace gaussmesh::app {
namespace {

/// A: with 250 pairs nearer than this, TABI-PB's GMRES did not converge.
constexpr double kSolverSeparation = 0.05;

CheckFindings find_all(const CheckCommand& command) {
  const TriangleMesh mesh = read_mesh_argument(command.mesh).mesh;
  CheckFindings found;
  found.name = command.mesh;
  found.mesh = check_mesh(mesh);
  const bool is_measurable = found.mesh.bad_indices == 0 && found.mesh.bad_coordinates == 0;
  found.separation = command.min_separation.value_or(kSolverSeparation);
  found.separation_is_required = command.min_separation.has_value();
  if (is_measurable) found.near = find_near_vertices(mesh, found.separation);
  if (!command.molecule) return found;
  const Surface surface = surface_of(command.surface, command.reading);
  const std::vector<Atom> atoms = read_molecule(*command.molecule, surface.reading).atoms;
  found.tolerance = command.tolerance;
  if (!is_measurable) return found;
  found.distance = distance_to_surface(mesh, atoms, surface.decay, surface.isovalue);
  found.two_sided = two_sided_distance(mesh, atoms, surface.decay, surface.isovalue);
  if (all_are_closed(found.mesh)) found.charges_outside = find_charges_outside(mesh, found.mesh, atoms);
  return found;
}

}  // namespace

CLI::App* add_check_command(CLI::App& program, CheckCommand& command) {
  CLI::App* app = program.add_subcommand("check", "judge whether a solver can trust a mesh");
  app->add_option("mesh", command.mesh, "mesh to judge, in any format that convert reads; -: standard input")
      ->type_name("MESH")
      ->check(file_name())
      ->required();
  CLI::Option* molecule =
      app->add_option("molecule", command.molecule, "molecule that it should be the surface of: PQR, XYZR, PDB, mmCIF")
          ->type_name("MOL")
          ->check(file_name());
  const std::string surface = "Surface of the molecule";
  for (CLI::Option* option : add_surface_options(*app, command.surface)) option->needs(molecule)->group(surface);
  for (CLI::Option* option : add_molecule_options(*app, command.reading))
    option->needs(molecule)->group(option->check_lname("probe") ? surface : "Input");
  const std::string judgement = "Judgement";
  app->add_option("--tolerance", command.tolerance,
                  "largest distance of a vertex from the surface (A, > 0; default: 1e-6)")
      ->type_name("T")
      ->check(positive_number())
      ->needs(molecule)
      ->group(judgement);
  app->add_option("--min-separation", command.min_separation,
                  "least distance of any two vertices (A, > 0; default: none, pairs nearer than 0.05 are told)")
      ->type_name("S")
      ->check(positive_number())
      ->group(judgement);
  add_json_option(*app, command.json);
  add_threads_option(*app, command.threads);
  app->footer(
      "Examples:\n"
      "  gaussmesh check out.off                             is it closed, embedded, right side out?\n"
      "  gaussmesh check out.off in.pqr --d 0.6 --c 1.7      and on that surface, with all charges inside?\n"
      "  gaussmesh check out.vert in.pqr --preset sas\n"
      "  gaussmesh check out.off --min-separation 0.05       fails where vertices are nearer\n\n"
      "Exit codes: 0 the mesh is closed, oriented, embedded and right side out, its vertices are as far apart as\n"
      "asked for, and if there is a molecule they are on its surface and its charges inside; 5 it is not; 2 wrong\n"
      "use; 3 bad input");
  return app;
}

int run_check(const CheckCommand& command) {
  std::vector<std::string> inputs = files_of_molecule(command.molecule.value_or(""), command.reading);
  inputs.push_back(command.mesh);
  require_files(inputs, {command.json.value_or("")});
  take_threads(command.threads);
  const CheckFindings found = find_all(command);
  put_report(findings_text(found), findings_json(found), command.json);
  return found.is_good() ? kGood : kCheckFailed;
}

}  // namespace gaussmesh::app

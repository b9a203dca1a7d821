#include "check_command.h"

#include "check_report.h"
#include "gaussmesh/read_mesh.h"
#include "report_parts.h"

namespace gaussmesh::app {
namespace {

constexpr int kGood = 0;
constexpr int kCheckFailed = 5;

/// A: with 250 pairs nearer than this, TABI-PB's GMRES did not converge.
constexpr double kSolverSeparation = 0.05;

CheckFindings find_all(const CheckOptions& options) {
  const TriangleMesh mesh = read_mesh(options.mesh).mesh;
  CheckFindings found;
  found.name = options.mesh;
  found.mesh = check_mesh(mesh);
  const bool is_measurable = found.mesh.bad_indices == 0 && found.mesh.bad_coordinates == 0;
  found.separation = options.min_separation.value_or(kSolverSeparation);
  found.separation_is_required = options.min_separation.has_value();
  if (is_measurable) found.near = find_near_vertices(mesh, found.separation);
  if (!options.molecule) return found;
  const std::vector<Atom> atoms = read_molecule(*options.molecule, options.reading, false);
  found.tolerance = options.tolerance;
  if (!is_measurable) return found;
  found.distance = distance_to_surface(mesh, atoms, options.decay, options.isovalue);
  found.two_sided = two_sided_distance(mesh, atoms, options.decay, options.isovalue);
  found.charges_outside = find_charges_outside(mesh, found.mesh, atoms);
  return found;
}

}  // namespace

CLI::App* add_check_command(CLI::App& program, CheckOptions& options) {
  CLI::App* command = program.add_subcommand("check", "judge a mesh by its triangles alone, exactly");
  const CLI::Validator positive = positive_number();
  command->add_option("mesh", options.mesh, "mesh to judge, in any format that convert reads")
      ->type_name("MESH")
      ->required();
  CLI::Option* molecule = command
                              ->add_option("molecule", options.molecule,
                                           "molecule that it should be the surface of: PQR, XYZR, PDB, mmCIF")
                              ->type_name("MOL");
  CLI::Option* decay = command->add_option("--d,--decay", options.decay, "decay d of its Gaussians (1/A^2)")
                           ->type_name("D")
                           ->check(positive);
  CLI::Option* isovalue = command->add_option("--c,--isovalue", options.isovalue, "isovalue c of its surface")
                              ->type_name("C")
                              ->check(positive);
  molecule->needs(decay)->needs(isovalue);
  decay->needs(molecule);
  isovalue->needs(molecule);
  command->add_option("--tolerance", options.tolerance, "largest distance of a vertex from the surface (A)")
      ->type_name("T")
      ->check(positive)
      ->capture_default_str()
      ->needs(molecule);
  command
      ->add_option("--min-separation", options.min_separation,
                   "least distance of any two vertices (A); else pairs nearer than 0.05 are only told")
      ->type_name("S")
      ->check(positive);
  add_json_option(*command, options.json);
  for (CLI::Option* option : add_molecule_options(*command, options.reading)) option->needs(molecule);
  command->footer(
      "Exit codes: 0 the mesh is closed, oriented, embedded and right side out, its vertices are as far apart as\n"
      "asked for, and if there is a molecule they are on its surface and its charges inside; 5 it is not; 2 wrong\n"
      "use; 3 bad input");
  return command;
}

int run_check(const CheckOptions& options) {
  const CheckFindings found = find_all(options);
  put_report(findings_text(found), findings_json(found), options.json);
  return found.is_good() ? kGood : kCheckFailed;
}

}  // namespace gaussmesh::app

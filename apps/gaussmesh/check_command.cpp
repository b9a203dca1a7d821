#include "check_command.h"

#include <charconv>
#include <cmath>
#include <iostream>

#include "check_report.h"
#include "gaussmesh/read_atoms.h"
#include "gaussmesh/read_mesh.h"
#include "gaussmesh/write_mesh.h"

namespace gaussmesh::app {
namespace {

constexpr int kGood = 0;
constexpr int kCheckFailed = 5;

/// CLI11's own PositiveNumber answers with a bound of 309 digits.
std::string refuse_unless_positive(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  if (is_number && std::isfinite(value) && value > 0.0) return {};
  return "expected a number > 0, got '" + text + "'";
}

CheckFindings find_all(const CheckOptions& options) {
  const TriangleMesh mesh = read_mesh(options.mesh).mesh;
  CheckFindings found;
  found.name = options.mesh;
  found.mesh = check_mesh(mesh);
  if (!options.molecule) return found;
  const AtomFile input = read_atoms(*options.molecule);
  for (const std::string& warning : input.warnings) std::cerr << "gaussmesh: warning: " << warning << "\n";
  found.tolerance = options.tolerance;
  if (found.mesh.bad_indices == 0 && found.mesh.bad_coordinates == 0)
    found.distance = distance_to_surface(mesh, input.atoms, options.decay, options.isovalue);
  return found;
}

}  // namespace

CLI::App* add_check_command(CLI::App& program, CheckOptions& options) {
  CLI::App* command = program.add_subcommand("check", "judge a mesh by its triangles alone, exactly");
  const CLI::Validator positive(refuse_unless_positive, "", "positive");
  command->add_option("mesh", options.mesh, "mesh to judge, in any format that convert reads")->type_name("MESH")->required();
  CLI::Option* molecule =
      command->add_option("molecule", options.molecule, "PQR or XYZR file that it should be the surface of")
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
  command->add_option("--json", options.json, "write what is found as JSON; -: to the terminal, and nothing else")
      ->type_name("FILE");
  command->footer(
      "Exit codes: 0 the mesh is closed, oriented, embedded and right side out, and its vertices are on the\n"
      "surface if there is a molecule; 5 it is not; 2 wrong use; 3 bad input");
  return command;
}

int run_check(const CheckOptions& options) {
  const CheckFindings found = find_all(options);
  const bool json_to_terminal = options.json == "-";
  if (options.json && !json_to_terminal) write_text(findings_json(found), *options.json);
  std::cout << (json_to_terminal ? findings_json(found) : findings_text(found)) << std::flush;
  return found.is_good() ? kGood : kCheckFailed;
}

}  // namespace gaussmesh::app

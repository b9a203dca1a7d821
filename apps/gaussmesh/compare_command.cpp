#include "compare_command.h"

#include "exit_code.h"
#include "output_options.h"
#include "report_parts.h"
#include "threads.h"
#include "validators.h"

namespace gaussmesh::app {
namespace {

std::string side_text(const char* name, const OneSidedDistance& d) {
  return line("  %-16s %12.5g %12.5g %12.5g %12.5g %12zu\n", name, d.max, d.max_bound, d.mean, d.rms, d.samples) +
         line("    farthest at (%.6g, %.6g, %.6g)\n", d.farthest[0], d.farthest[1], d.farthest[2]);
}

Json side_json(const OneSidedDistance& d) {
  return {{"max_A", d.max}, {"max_bound_A", d.max_bound}, {"mean_A", d.mean},
          {"rms_A", d.rms}, {"farthest_A", d.farthest},   {"samples", d.samples}};
}

std::string comparison_text(const CompareCommand& command, const MeshComparison& found) {
  return "A: " + command.first + "\nB: " + command.second + "\n" +
         line("Distances (A), %.4g samples per A^2\n", command.options.samples_per_A2) +
         "                            max    at most         mean          rms      samples\n" +
         side_text("from A to B", found.first_to_second) + side_text("from B to A", found.second_to_first) +
         line("Hausdorff distance: %.5g A; no more than %.5g A\n", found.hausdorff(), found.hausdorff_bound());
}

std::string comparison_json(const CompareCommand& command, const MeshComparison& found) {
  return json_text({{"first", command.first},
                    {"second", command.second},
                    {"samples_per_A2", command.options.samples_per_A2},
                    {"first_to_second", side_json(found.first_to_second)},
                    {"second_to_first", side_json(found.second_to_first)},
                    {"hausdorff_A", found.hausdorff()},
                    {"hausdorff_bound_A", found.hausdorff_bound()}});
}

}  // namespace

CLI::App* add_compare_command(CLI::App& program, CompareCommand& command) {
  CLI::App* app = program.add_subcommand("compare", "measure how far two meshes are from each other");
  app->add_option("A", command.first, "mesh, in any format that convert reads; -: standard input")
      ->type_name("A")
      ->check(file_name())
      ->required();
  app->add_option("B", command.second, "the other mesh")->type_name("B")->check(file_name())->required();
  app->add_option("--density", command.options.samples_per_A2,
                  "samples per area of the surfaces (1/A^2, > 0; default: 25)")
      ->type_name("N")
      ->check(positive_number());
  add_json_option(*app, command.json);
  add_threads_option(*app, command.threads);
  app->footer(
      "For each direction: the largest distance of a sample, what no point of the surface exceeds, and the mean "
      "and\n"
      "root mean square over the surface. Every distance is that to the nearest point of the nearest triangle.\n\n"
      "Example:  gaussmesh compare coarse.off fine.off --density 100");
  return app;
}

int run_compare(const CompareCommand& command) {
  require_files({command.first, command.second}, {command.json.value_or("")});
  take_threads(command.threads);
  const TriangleMesh first = read_mesh_argument(command.first).mesh;
  const TriangleMesh second = read_mesh_argument(command.second).mesh;
  const MeshComparison found = compare_meshes(first, second, command.options);
  put_report(comparison_text(command, found), comparison_json(command, found), command.json);
  return kGood;
}

}  // namespace gaussmesh::app

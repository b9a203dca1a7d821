#include "mesh_command.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <limits>
#include <sstream>

#include "exit_code.h"
#include "gaussmesh/error.h"
#include "gaussmesh/select_components.h"
#include "memory_limit.h"
#include "output_names.h"
#include "output_options.h"
#include "progress.h"
#include "threads.h"
#include "validators.h"

namespace gaussmesh::app {
namespace {

/// What --cavities and the report call them, in the order of Cavities.
constexpr std::array<const char*, 3> kCavityNames = {"keep", "drop", "separate"};

const char* name_of(Cavities cavities) { return kCavityNames[static_cast<std::size_t>(cavities)]; }

/// `name` is one of them.
Cavities cavities_of(const std::string& name) {
  return static_cast<Cavities>(std::find(kCavityNames.begin(), kCavityNames.end(), name) - kCavityNames.begin());
}

bool is_separate(const MeshCommand& command) { return command.cavities == Cavities::kSeparate; }

bool is_standard_output_taken(const MeshCommand& command) {
  return is_standard_output(command.report) ||
         std::any_of(command.outputs.begin(), command.outputs.end(), is_standard_output);
}

/// Larger triangles are not made equilateral. Said in terms of what was given: spacing or density.
void require_spacing_for_improvement(const MeshCommand& command) {
  constexpr double kLargest = 200.0;      // A
  constexpr double kLeastDensity = 3e-5;  // 1/A^2
  if (!command.options.improve) return;
  const auto fail = [](const std::string& option, const std::string& expected, double got) {
    std::ostringstream number;
    number << got;
    throw OptionError(option + ": expected " + expected + " without --raw, got '" + number.str() + "'");
  };
  if (command.density && *command.density < kLeastDensity) {
    fail("--density", "a number from 3e-05 to 10000", *command.density);
  }
  if (!command.density && command.options.spacing > kLargest) {
    fail("--spacing", "a number from 0.01 to 200", command.options.spacing);
  }
}

void require_sense(const MeshCommand& command) {
  if (command.molecule.empty()) throw OptionError("MOL: expected a file of atoms, got nothing; see --help");
  if (command.outputs.empty()) throw OptionError("-o: expected a file to write, got nothing");
  require_header_to_leave_out(command.outputs, command.writing);
  require_spacing_for_improvement(command);
  if (is_separate(command) && std::find(command.outputs.begin(), command.outputs.end(), "-") != command.outputs.end())
    throw OptionError("--cavities separate: expected files to write, got '-' for standard output");
  for (const std::string& output : command.outputs) {
    // Its hole and region points are those of a whole molecule: a cavity by itself has nothing inside.
    if (is_separate(command) && format_of(output, command.writing).name == "smesh")
      throw OptionError("--cavities separate: expected a format that holds a surface alone, got smesh for '" + output +
                        "', which wants cavities together with what they are in");
  }
}

/// The names of all meshes where there are so many surfaces.
std::vector<std::string> names_of_meshes(const MeshCommand& command, std::size_t surfaces) {
  if (!is_separate(command)) return command.outputs;
  std::vector<std::string> names;
  for (std::size_t number = 1; number <= surfaces; ++number) {
    for (const std::string& output : command.outputs) names.push_back(numbered(output, number));
  }
  return names;
}

/// Finds out what cannot be written where there are so many surfaces.
void require_writable_files(const MeshCommand& command, std::size_t surfaces) {
  std::vector<std::string> inputs = files_of_molecule(command.molecule, command.reading);
  inputs.push_back(command.config);
  require_writable_outputs(names_of_meshes(command, surfaces), command.report, command.writing, inputs);
}

/// What is written.
struct Product {
  MeshFile surface;
  MeshReport report;
};

/// The surface with its cavities as the command wants them, and what was done told in the report.
Product select_cavities(const MeshCommand& command, Product product) {
  const double least =
      command.cavities == Cavities::kDrop ? std::numeric_limits<double>::infinity() : command.min_cavity_volume;
  const MeshCheck check = product.report.check;
  const ComponentList kept = leave_out_cavities(check, least);
  if (kept.size() < check.components.size()) {
    product.surface = extract_components(product.surface.mesh, product.surface.data, check, kept);
    product.report.check = check_mesh(product.surface.mesh);
    product.report.left_out = {check.components.size() - kept.size(), product.report.check.volume - check.volume};
  }
  if (is_separate(command)) {
    const ComponentList order = outsides_first(product.report.check);
    product.report.check = reorder_components(std::move(product.report.check), order);
  }
  return product;
}

/// Writes down what the library does not know.
void tell_of_input(const MeshCommand& command, const Surface& surface, const AtomFile& input, MeshReport& report) {
  const ReadOptions& reading = surface.reading.reading;
  report.source = {command.molecule, reading.radii, input.warnings, reading.radii_file.string()};
  report.probe_radius = surface.reading.probe.value_or(0.0);
  report.cavities = name_of(command.cavities);
  report.min_cavity_volume = command.min_cavity_volume;
}

/// What the formats of the outputs hold.
VertexData find_vertex_data(const MeshCommand& command, const std::vector<Atom>& atoms, const MeshResult& result,
                            int threads) {
  VertexData data;
  data.normals = result.normals;
  for (const std::string& output : command.outputs) {
    if (format_of(output, command.writing).held != HeldData::kAll) continue;
    data.atoms = find_nearest_atoms(result.mesh, atoms, threads);
    data.atom_count = atoms.size();
    data.components = find_vertex_components(result.mesh, result.report.check);
    break;
  }
  return data;
}

/// Writes all meshes and the report; they still have to be put in their places.
OutputFiles write_all(const MeshCommand& command, const Product& product, int threads) {
  const auto& [surface, report] = product;
  WriteOptions writing = command.writing;
  writing.threads = threads;
  OutputFiles files;
  if (is_separate(command)) {
    const auto write = [&](std::uint32_t component, const MeshFile& part) {
      for (const std::string& output : command.outputs)
        files.add_mesh(part.mesh, part.data, numbered(output, component + 1), writing);
    };
    split_components(surface.mesh, surface.data, report.check, write);
  } else {
    for (const std::string& output : command.outputs) files.add_mesh(surface.mesh, surface.data, output, writing);
  }
  if (!command.report.empty()) files.add_text(report_json(report), command.report);
  return files;
}

void print_details(const MeshReport& report, std::ostream& out) {
  out << "cells " << report.cells << ", cut along folds " << report.cells_cut_by_folds << ", split "
      << report.cells_split << "; smallest box " << report.smallest_box << " A; largest distance of a vertex "
      << report.vertex_distance_max << " A\n"
      << "angles " << report.check.min_angle_deg << " to " << report.check.max_angle_deg
      << " deg, smallest one of a triangle " << report.check.mean_min_angle_deg << " deg on average\n";
  for (const StageCost& stage : report.stages)
    out << "  " << stage.name << ": " << stage.time_s << " s, " << stage.peak_memory_MB << " MB\n";
}

/// What the first output became.
std::string name_of_first(const MeshCommand& command, std::size_t surfaces) {
  const std::string& first = command.outputs.front();
  if (!is_separate(command)) return first;
  return numbered(first, 1) + (surfaces > 1 ? " to " + numbered(first, surfaces) : "");
}

/// Tells of files that are there as if there were more surfaces.
void warn_of_others(const MeshCommand& command, std::size_t surfaces) {
  for (const std::string& output : command.outputs) {
    const std::string others = numbered_from(output, surfaces + 1, command.writing);
    if (others.empty()) continue;
    std::cerr << "gaussmesh: warning: expected no more than " << numbered(output, surfaces) << ", got " << others
              << " too, which an earlier run may have left\n";
  }
}

/// Prints what was made.
void print_summary(const MeshCommand& command, const MeshReport& report) {
  std::ostringstream text;
  text << name_of_first(command, report.check.components.size()) << ": " << report_summary(report);
  if (command.verbose) print_details(report, text);
  print_at_once(is_standard_output_taken(command) ? std::cerr : std::cout, text.str());
}

void add_surface_group(CLI::App& program, MeshCommand& command) {
  const std::string group = "Surface";
  for (CLI::Option* option : add_surface_options(program, command.surface)) option->group(group);
  for (CLI::Option* option : add_molecule_options(program, command.reading))
    option->group(option->check_lname("probe") ? group : "Input");
  program
      .add_option_function<std::string>(
          "--cavities", [&command](const std::string& name) { command.cavities = cavities_of(name); },
          "keep; drop: fill them; separate: a file for each closed surface, OUT_1 and on, outer ones "
          "first (default: keep)")
      ->type_name("NAME")
      ->check(one_of(cavity_choices()))
      ->group(group);
  program
      .add_option("--min-cavity-volume", command.min_cavity_volume,
                  "fill cavities of less than this (A^3, >= 0; one water is 11.4; default: 0)")
      ->type_name("V")
      ->check(number_from(0.0))
      ->group(group);
  program
      .add_flag("--allow-uncertified", command.options.allow_uncertified,
                "where c is too near a critical value for a proof, mesh a level beside it (default: off)")
      ->group(group);
}

void add_triangle_group(CLI::App& program, MeshCommand& command) {
  const std::string group = "Triangles";
  CLI::Option* spacing =
      program
          .add_option("--spacing", command.options.spacing,
                      "wanted mean edge of the triangles (A, 0.01 to 200, with --raw to 1000; default: 0.5)")
          ->type_name("H")
          ->check(number_between(0.01, 1000.0, "a number from 0.01 to 200, with --raw to 1000"))
          ->group(group);
  program
      .add_option(
          "--density", command.density,
          "the same by vertices per area (1/A^2, 3e-5 to 1e4, with --raw from 2e-6; default: none, --spacing 0.5 is "
          "4.6)")
      ->type_name("V")
      ->check(number_between(2e-6, 1e4, "a number from 3e-05 to 10000, with --raw from 2e-06"))
      ->excludes(spacing)
      ->group(group);
  CLI::Option* tolerance =
      program
          .add_option("--tolerance", command.options.tolerance,
                      "smaller triangles where they would be farther than this from the surface (A, 1e-6 to 1000; "
                      "default: 0, no limit)")
          ->type_name("T")
          ->check(zero_or_number_between(
              1e-6, 1000.0, "0 or a number from 1e-06 to 1000, since vertices may be 1e-06 A from the surface"))
          ->group(group);
  program
      .add_flag_callback(
          "--raw", [&command] { command.options.improve = false; },
          "leave the triangles as traced, slivers and all; not with --tolerance (default: off)")
      ->excludes(tolerance)
      ->group(group);
}

void add_output_group(CLI::App& program, MeshCommand& command) {
  const std::string group = "Output";
  program
      .add_option("-o,--output", command.outputs,
                  "mesh to write, gzipped if it ends in .gz; may be given several times; -: standard output (required)")
      ->type_name("FILE")
      ->take_all()
      ->allow_extra_args(false)  // one behind each -o: the next word is the molecule, or the `--` before it
      ->check(file_name_of_option())
      ->group(group);
  for (CLI::Option* option : add_format_options(program, command.writing)) option->group(group);
  program
      .add_option("--report", command.report,
                  "write everything that is known of the mesh, JSON; -: standard output (default: none)")
      ->type_name("FILE")
      ->check(file_name_of_option())
      ->group(group);
}

void add_running_group(CLI::App& program, MeshCommand& command) {
  const std::string group = "Running";
  add_threads_option(program, command.options.threads)->group(group);
  program
      .add_option("--max-memory", command.max_memory,
                  "memory to get by with, such as 500M or 4G, at least 128M: what does not fit is kept in a temporary "
                  "file beside the mesh (bytes, or K, M, G, T of 1024, 1024^2 and so on; default: no limit)")
      ->type_name("SIZE")
      ->transform(memory_size(kLeastMemory))
      ->group(group);
  CLI::Option* quiet =
      program.add_flag("--quiet", command.quiet, "say nothing but errors (default: off)")->group(group);
  program.add_flag("--verbose", command.verbose, "say also how each stage went (default: off)")
      ->excludes(quiet)
      ->group(group);
}

}  // namespace

std::vector<std::string> cavity_choices() { return {kCavityNames.begin(), kCavityNames.end()}; }

void add_mesh_options(CLI::App& program, MeshCommand& command) {
  program.add_option("molecule", command.molecule, kMoleculeHelp)->type_name("MOL");
  add_surface_group(program, command);
  add_triangle_group(program, command);
  add_output_group(program, command);
  add_running_group(program, command);
}

int run_mesh(MeshCommand command) {
  require_sense(command);
  command.outputs = without_second_names(command.outputs, command.writing);
  require_writable_files(command, 1);
  if (command.max_memory > 0) limit_memory(command.max_memory, folder_of_temporary(command.outputs.front()));
  const int threads =
      take_threads(command.options.threads, command.quiet ? FewerThreads::kSayNothing : FewerThreads::kWarn);
  const Surface surface = surface_of(command.surface, command.reading);
  const AtomFile input =
      read_molecule(command.molecule, surface.reading, command.quiet ? Warnings::kKeepBack : Warnings::kPrint);
  MeshOptions options = command.options;
  options.threads = threads;
  options.decay = surface.decay;
  options.isovalue = surface.isovalue;
  if (command.density) options.spacing = spacing_for_density(*command.density);
  options.measure_distance = !command.report.empty();
  if (command.max_memory == 0) options.memory_bytes = physical_memory();
  MeshResult result = [&] {
    std::optional<ProgressBar> bar;
    if (!command.quiet) {
      bar.emplace(options.improve);
      options.on_stage_end = [&](const std::string& stage) { bar->stage_ended(stage); };
      options.on_improving = [&](double share_done) { bar->improving(share_done); };
    }
    return mesh_surface(input.atoms, options);
  }();
  tell_of_input(command, surface, input, result.report);
  VertexData data = find_vertex_data(command, input.atoms, result, threads);
  const Product product =
      select_cavities(command, {{std::move(result.mesh), std::move(data)}, std::move(result.report)});
  const std::size_t surfaces = product.report.check.components.size();
  if (is_separate(command)) require_writable_files(command, surfaces);
  OutputFiles files = write_all(command, product, threads);
  if (!command.quiet) print_summary(command, product.report);
  files.commit();
  if (is_separate(command) && !command.quiet) warn_of_others(command, surfaces);
  return kGood;
}

}  // namespace gaussmesh::app

#include "surface_options.h"

#include <array>
#include <cstdio>

#include "validators.h"

namespace gaussmesh::app {
namespace {

/// Parameters by the surface that they match: [LCL15] for the first three.
struct Preset {
  const char* name;
  double decay;
  double isovalue;
  double probe;
};

constexpr std::array<Preset, 5> kPresets = {{{"ses-volume", 0.6, 1.7, 0.0},
                                             {"ses-area", 0.4, 1.8, 0.0},
                                             {"ses-hausdorff", 0.4, 1.2, 0.0},
                                             {"vdw", 2.0, 1.0, 0.0},
                                             {"sas", 2.0, 1.0, 1.4}}};

/// All of them with their parameters, for help.
std::string preset_table() {
  std::string text;
  for (const Preset& preset : kPresets) {
    char parameters[64];
    std::snprintf(parameters, sizeof parameters, preset.probe > 0.0 ? " (%g, %g, %g)" : " (%g, %g)", preset.decay,
                  preset.isovalue, preset.probe);
    text += (text.empty() ? "" : ", ") + std::string(preset.name) + parameters;
  }
  return text;
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) names.push_back(preset.name);
  return names;
}

std::vector<CLI::Option*> add_surface_options(CLI::App& command, SurfaceOptions& options) {
  CLI::Option* preset =
      command
          .add_option("--preset", options.preset,
                      "d, c and probe by name, instead of --d and --c: " + preset_table() + " (default: ses-volume)")
          ->type_name("NAME")
          ->check(one_of(preset_names()));
  CLI::Option* decay =
      command.add_option("--d,--decay", options.decay, "decay d of the Gaussians (1/A^2, 0.001 to 1000; default: 0.6)")
          ->type_name("D")
          ->check(number_between(1e-3, 1e3))
          ->excludes(preset);
  CLI::Option* isovalue =
      command.add_option("--c,--isovalue", options.isovalue, "isovalue c of the surface (1e-9 to 1e9; default: 1.7)")
          ->type_name("C")
          ->check(number_between(1e-9, 1e9))
          ->excludes(preset);
  return {preset, decay, isovalue};
}

Surface surface_of(const SurfaceOptions& options, MoleculeOptions reading) {
  for (const Preset& preset : kPresets) {
    if (options.preset != preset.name) continue;
    if (!reading.probe) reading.probe = preset.probe;
    return {preset.decay, preset.isovalue, std::move(reading)};
  }
  return {options.decay, options.isovalue, std::move(reading)};
}

}  // namespace gaussmesh::app

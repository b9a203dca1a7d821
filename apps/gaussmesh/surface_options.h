// Which surface of the molecule is meant: decay, isovalue and probe, by number or by a name for all three.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "molecule_options.h"

namespace gaussmesh::app {

/// As they stand on the command line; without any, the surface is that of `ses-volume`.
struct SurfaceOptions {
  std::string preset;     ///< names decay, isovalue and probe; empty: they stand below
  double decay = 0.6;     ///< d, 1/A^2
  double isovalue = 1.7;  ///< c
};

/// What they mean.
struct Surface {
  double decay = 0.0;       ///< d, 1/A^2
  double isovalue = 0.0;    ///< c
  MoleculeOptions reading;  ///< of the molecule, with the preset's probe where none was given
};

std::vector<std::string> preset_names();

/// Adds --preset, --d and --c; `options` must outlive the command. @return the options
std::vector<CLI::Option*> add_surface_options(CLI::App& command, SurfaceOptions& options);

/// @param reading  as given; its probe comes before that of a preset
/// @throws OptionError if decay or isovalue is out of its range
Surface surface_of(const SurfaceOptions& options, MoleculeOptions reading);

}  // namespace gaussmesh::app

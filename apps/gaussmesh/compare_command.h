// `gaussmesh compare`: how far two meshes are from each other.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "gaussmesh/compare_meshes.h"

namespace gaussmesh::app {

struct CompareCommand {
  std::string first;
  std::string second;
  CompareOptions options;
  int threads = 0;                  ///< 0: one for each processor
  std::optional<std::string> json;  ///< write JSON here; "-": to the terminal, in place of the report
};

/// Adds the sub-command to the program; parsing fills `command`, which must outlive it. @return the sub-command
CLI::App* add_compare_command(CLI::App& program, CompareCommand& command);

/// Reads both meshes, measures and says so. @return the exit code @throws InputError, OptionError
int run_compare(const CompareCommand& command);

}  // namespace gaussmesh::app

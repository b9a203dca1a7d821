// How help looks, and what the manual and the completions tell of the same options.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gaussmesh::app {

/// Help of the program or a sub-command: options in groups, names on the left, words broken into lines on the
/// right.
std::string help_text(const CLI::App& app);

/// The options of one group, in their order.
struct OptionGroup {
  std::string name;  ///< "Arguments" for positional ones
  std::vector<const CLI::Option*> options;
};

/// All options that help shows, positional ones first.
std::vector<OptionGroup> option_groups(const CLI::App& app);

std::vector<const CLI::App*> subcommands(const CLI::App& app);

/// Its names with their dashes, short ones first; none for a positional one.
std::vector<std::string> dashed_names(const CLI::Option& option);

/// What stands for its value, such as FILE; empty for a flag.
std::string value_name(const CLI::Option& option);

/// Both, such as `-o, --output FILE`.
std::string names_and_value(const CLI::Option& option);

/// The ways to call the program or a sub-command, such as `gaussmesh check [OPTIONS] MESH [MOL]`.
std::vector<std::string> usage_lines(const CLI::App& app);

}  // namespace gaussmesh::app

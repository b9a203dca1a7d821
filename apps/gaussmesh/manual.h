// The manual page and the completions of the shells, made of the options themselves.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gaussmesh::app {

/// man(7) source of gaussmesh.1.
std::string manual_page(const CLI::App& program);

/// A script that completes options, their names and sub-commands in bash; /usr/share/bash-completion/completions.
std::string bash_completion(const CLI::App& program);

/// The same for zsh; a folder of its fpath, as _gaussmesh.
std::string zsh_completion(const CLI::App& program);

}  // namespace gaussmesh::app

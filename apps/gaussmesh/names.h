// Options whose value is one of a few names.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "gaussmesh/nearest_name.h"

namespace gaussmesh::app {

/// Joined with `separator`.
inline std::string join_names(const std::vector<std::string>& names, const std::string& separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
  return text;
}

/// Refuses every other name, and says which one is nearest.
inline CLI::Validator one_of(const std::vector<std::string>& names) {
  return CLI::Validator(
      [names](const std::string& name) {
        if (std::find(names.begin(), names.end(), name) != names.end()) return std::string();
        return "expected " + join_names(names, ", ") + ", got '" + name + "'; did you mean '" +
               nearest_name(name, names) + "'?";
      },
      "");
}

}  // namespace gaussmesh::app

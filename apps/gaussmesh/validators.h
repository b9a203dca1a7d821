// What an option takes: one of a few names, or numbers within a range.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gaussmesh::app {

/// Joined with `separator`.
std::string join_names(const std::vector<std::string>& names, const std::string& separator);

/// Refuses every other name, and says which one is nearest. @param names  at least one
CLI::Validator one_of(const std::vector<std::string>& names);

/// Takes numbers from `low` to `high`, both included.
CLI::Validator number_between(double low, double high);

/// Takes numbers above 0. CLI11's own PositiveNumber answers with a bound of 309 digits.
CLI::Validator positive_number();

}  // namespace gaussmesh::app

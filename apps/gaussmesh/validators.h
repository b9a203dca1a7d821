// What an option takes: one of a few names, or numbers within a range.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace gaussmesh::app {

/// Joined with `separator`.
std::string join_names(const std::vector<std::string>& names, const std::string& separator);

/// Refuses every other name, and says which one is near. @param names  at least one
CLI::Validator one_of(const std::vector<std::string>& names);

/// Takes numbers from `low` to `high`, both included. Messages have `expected` for them, where that is not empty.
CLI::Validator number_between(double low, double high, const std::string& expected = "");

/// Takes 0 too.
CLI::Validator zero_or_number_between(double low, double high, const std::string& expected);

/// Takes whole numbers from `low` to `high`, both included.
CLI::Validator whole_number_between(int low, int high);

/// Takes numbers above 0. CLI11's own PositiveNumber answers with a bound of 309 digits.
CLI::Validator positive_number();

/// Takes numbers from `low` on.
CLI::Validator number_from(double low);

/// Takes every text but none, which scripts give where a variable of theirs is not set.
CLI::Validator file_name();

/// The same behind an option: what begins with a dash, but for `-`, is the next option, and a name has been forgotten.
CLI::Validator file_name_of_option();

/// Takes sizes of memory from `least` (bytes) on: numbers of bytes, such as 1e9, or of K, M, G or T of 1024, 1024^2,
/// ... bytes, with or without a B or iB behind. Makes bytes of them.
CLI::Validator memory_size(std::uint64_t least);

}  // namespace gaussmesh::app

// A table of a CIF file, by gemmi's parser; mmCIF is parse_mmcif.cpp.
//
// This header and its source keep to C++17: in C++20, clang 14 with libstdc++ 12 refuses gemmi's own headers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gaussmesh {

/// The rows of the columns that were asked for.
struct CifTable {
  bool is_there = false;
  std::vector<std::vector<std::string>> rows;  ///< without quotes; `.` and `?` are empty
};

/// Finds the loop of the first block whose tags are `prefix` and `tags`; a tag that begins with `?` may be missing.
///
/// @throws InputError if the text is no CIF; what gemmi says names the line
CifTable read_cif_table(std::string_view text, std::string_view name, const std::string& prefix,
                        const std::vector<std::string>& tags);

}  // namespace gaussmesh

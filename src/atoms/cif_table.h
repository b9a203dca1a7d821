// A table of a CIF file, by gemmi's parser; mmCIF is parse_mmcif.cpp.
//
// This header and its source keep to C++17: in C++20, clang 14 with libstdc++ 12 refuses gemmi's own headers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gaussmesh {

/// A column by its tag, or another that is taken where there is none of that.
struct CifColumn {
  std::string tag;
  std::string other_tag;  ///< empty: there is none
  enum class Need { kRequired, kOptional } need = Need::kRequired;
};

/// The rows of the columns that were asked for.
struct CifTable {
  std::vector<std::vector<std::string>> rows;  ///< without quotes; `.` and `?` are empty
};

/// Finds the loop whose tags begin with `prefix`, in whichever block it is, and in it the columns, which are optional
/// or not.
///
/// @throws InputError if the text is no CIF, there is no such loop or more than one, or a required column is missing,
///                    and names the line
CifTable read_cif_table(std::string_view text, std::string_view name, const std::string& prefix,
                        const std::vector<CifColumn>& columns);

}  // namespace gaussmesh

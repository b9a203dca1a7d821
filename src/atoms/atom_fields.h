// What the text formats of atoms share: the atom that some fields make, and what is wrong with them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "gaussmesh/read_atoms.h"
#include "text/text_lines.h"

namespace gaussmesh {

/// The fields of one atom, as written: x, y, z, radius and charge, the last empty in formats without charges.
using AtomFields = std::array<std::string_view, 5>;

/// The atom that `fields` describe; nothing if one of them is no number. Ranges are for require_in_range.
std::optional<Atom> parse_atom(const AtomFields& fields);

/// Throws the error for the first of `fields` that is no number.
[[noreturn]] void fail_at_number(const AtomFields& fields, const LinePlace& place);

/// Throws InputError if a coordinate or the radius of `atom`, made of `fields`, is out of its range.
void require_in_range(const Atom& atom, const AtomFields& fields, const LinePlace& place);

/// Collects radii above kSuspectRadius for one warning.
class LargeRadii {
 public:
  void add(double radius, std::size_t line);

  /// Adds the warning to those of `file`, if there is anything to warn of.
  void warn(std::string_view name, AtomFile& file) const;

 private:
  std::size_t count_ = 0;
  double first_ = 0.0;
  std::size_t first_line_ = 0;
  double largest_ = 0.0;
  std::size_t largest_line_ = 0;
};

}  // namespace gaussmesh

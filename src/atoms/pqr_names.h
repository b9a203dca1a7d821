// What the fields before the numbers of a PQR record say of its atom.
//
// Which fields these are is pqr_record.h.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "atoms/pqr_record.h"

namespace gaussmesh {

/// Takes a chain of letters off the front of a residue number that it is glued to: A of A1001, A of A-5.
inline std::string_view take_glued_chain(std::string_view& number) {
  const std::size_t digits = number.find_first_of("-0123456789*");
  const std::string_view chain = number.substr(0, digits);
  number.remove_prefix(chain.size());
  return chain;
}

/// The name of an atom from `leading`, all fields behind ATOM or HETATM and before the numbers; empty if they can be
/// read in no way that pqr_record.h knows. An alternate location that is a field of its own is left out, one that is
/// glued to the residue stays there.
inline AtomName name_of(std::span<const std::string_view> leading) {
  constexpr std::size_t kColumnsOfName = 4;
  if (leading.size() < kFewestLeadingFields || !names_an_atom(leading)) return {};
  std::string_view insertion;
  if (leading.back().size() == 1 && is_letter(leading.back()[0])) {
    insertion = leading.back();
    leading = leading.first(leading.size() - 1);
  }
  std::string_view number = leading.back();
  const std::string_view glued_chain = take_glued_chain(number);
  const auto names = leading.subspan(1, leading.size() - 2);  // without serial and number
  const bool is_glued = names.size() == 1 ||
                        (names.size() == 2 && names[0].size() > kColumnsOfName + 1 && names[1].size() <= kLongestChain);
  const bool has_alternate = names.size() == 4 || (names.size() == 3 && names[2].size() > kLongestChain);
  const std::size_t place_of_chain = is_glued ? 1 : has_alternate ? 3 : 2;
  const std::string_view name = is_glued ? names[0].substr(0, kColumnsOfName) : names[0];
  const std::string_view residue = is_glued ? names[0].substr(kColumnsOfName) : names[place_of_chain - 1];
  const std::string_view chain = names.size() > place_of_chain ? names[place_of_chain] : glued_chain;
  return {std::string(name), std::string(residue), std::string(chain), std::string(number) + std::string(insertion)};
}

}  // namespace gaussmesh

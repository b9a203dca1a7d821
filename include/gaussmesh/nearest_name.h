// What somebody may have meant who wrote a name that there is not.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace gaussmesh {

/// Letters to insert, take out or replace to make `a` of `b` (Levenshtein's distance). Cost: the product of the
/// lengths.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j] ? 1 : 0);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

/// The first of `names` that begins with `name`, if that has three letters or more; else the first that is nearest to
/// it by edit_distance. @param names  at least one
template <class Names>
std::string nearest_name(std::string_view name, const Names& names) {
  constexpr std::size_t kLeastBeginning = 3;
  const auto begun = std::find_if(std::begin(names), std::end(names), [&](const auto& other) {
    return name.size() >= kLeastBeginning && std::string_view(other).starts_with(name);
  });
  if (begun != std::end(names)) return std::string(*begun);
  const auto distance = [&](const auto& other) { return edit_distance(name, other); };
  return std::string(*std::min_element(std::begin(names), std::end(names),
                                       [&](const auto& a, const auto& b) { return distance(a) < distance(b); }));
}

}  // namespace gaussmesh

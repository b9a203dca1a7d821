// What somebody may have meant who wrote a name that there is not.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gaussmesh {

/// ASCII letters in lower case.
inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

/// Letters to insert, take out, replace or swap with their neighbour to make `a` of `b` (Damerau and Levenshtein's
/// distance, where no place is changed twice). Cost: the product of the lengths.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    next[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      next[j + 1] = std::min({next[j] + 1, row[j + 1] + 1, row[j] + (a[i] != b[j] ? 1 : 0)});
      const bool is_swapped = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
      if (is_swapped) next[j + 1] = std::min(next[j + 1], before[j - 1] + 1);
    }
    std::swap(before, row);
    std::swap(row, next);
  }
  return row.back();
}

/// Whether `other` begins with `name`, in any case, and that is three letters or more.
inline bool is_beginning(std::string_view name, std::string_view other) {
  constexpr std::size_t kLeastBeginning = 3;
  return name.size() >= kLeastBeginning && lower_case(other).starts_with(lower_case(name));
}

/// The first of `names` that begins with `name`, if that has three letters or more; else the first that is nearest to
/// it by edit_distance. Case does not matter. @param names  at least one
template <class Names>
std::string nearest_name(std::string_view name, const Names& names) {
  const auto begun =
      std::find_if(std::begin(names), std::end(names), [&](const auto& other) { return is_beginning(name, other); });
  if (begun != std::end(names)) return std::string(*begun);
  const auto distance = [&](const auto& other) { return edit_distance(lower_case(name), lower_case(other)); };
  return std::string(*std::min_element(std::begin(names), std::end(names),
                                       [&](const auto& a, const auto& b) { return distance(a) < distance(b); }));
}

/// For the end of a message: `; did you mean 'NAME'?` with the nearest name, or nothing where all of them are farther
/// from `name` than half its length. @param names  at least one
template <class Names>
std::string did_you_mean(std::string_view name, const Names& names) {
  const std::string nearest = nearest_name(name, names);
  const bool is_near =
      is_beginning(name, nearest) || 2 * edit_distance(lower_case(name), lower_case(nearest)) <= name.size();
  return is_near ? "; did you mean '" + nearest + "'?" : "";
}

}  // namespace gaussmesh

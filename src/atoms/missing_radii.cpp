#include "atoms/missing_radii.h"

#include <algorithm>

#include "atoms/structure_builder.h"
#include "core/number_text.h"
#include "gaussmesh/error.h"
#include "text/text_lines.h"

namespace gaussmesh {
namespace {

constexpr std::size_t kMostLines = 20;

std::string description(const AtomSite& site) {
  return name_of(site) + ", " +
         (site.element.empty() ? "no element in " + std::string(site.element_place) : "element '" + site.element + "'");
}

/// Whether a file of radii can have it as a field.
bool is_field(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~' && c != '#'; });
}

/// The entry that would give `site` a radius, with `?` for it; a comment where there can be none. Names are in upper
/// case, since the file takes those that differ in case alone for the same.
std::string entry_for(const AtomSite& site) {
  const std::string_view name = is_field(site.name) ? site.name : std::string_view(site.element);
  if (!is_field(name) || !(site.residue.empty() || is_field(site.residue)))
    return "# atom " + quoted(site.name) + " of residue " + quoted(site.residue);
  const std::string residue = site.residue.empty() ? "" : upper_case(site.residue) + " ";
  return residue + upper_case(name) + " ?";
}

}  // namespace

void MissingRadii::add(const AtomSite& site) {
  if (count_++ == 0) first_ = description(site);
  const std::string line = entry_for(site);
  const auto [place, is_new] = place_.try_emplace(line, kinds_.size());
  if (is_new) kinds_.push_back({line, site.where, 0});
  ++kinds_[place->second].count;
}

void MissingRadii::require_none(const std::string& radii) const {
  if (count_ == 0) return;
  std::string text = kinds_.front().where + ": expected atoms that the radii " + radii + " know, got " + first_;
  if (count_ > 1) text += ", and " + counted(count_ - 1, "other", "others");
  text +=
      "; take them out, use other radii, or write a radius (A) for each '?' of these lines and give them with "
      "--radii-file:";
  for (std::size_t i = 0; i < std::min(kinds_.size(), kMostLines); ++i) {
    const Kind& kind = kinds_[i];
    text += "\n" + kind.line + "  # " + counted(kind.count, "atom", "atoms") + ", first " + kind.where;
  }
  if (kinds_.size() > kMostLines) text += "\n# and " + std::to_string(kinds_.size() - kMostLines) + " more";
  throw InputError(text);
}

}  // namespace gaussmesh

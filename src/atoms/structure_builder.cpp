#include "atoms/structure_builder.h"

#include <cmath>
#include <utility>

#include "atoms/residue_names.h"
#include "core/number_text.h"
#include "gaussmesh/error.h"
#include "text/text_lines.h"

namespace gaussmesh {
namespace {

void warn_of(std::size_t count, const std::string& what, const std::string& name, AtomFile& file) {
  if (count > 0) file.warnings.push_back(name + ": left out " + counted(count, "atom", "atoms") + " " + what);
}

}  // namespace

std::string name_of(const AtomSite& site) {
  return "atom " + std::string(site.name) + " of residue " + std::string(site.residue) + " " + site.site;
}

bool StructureBuilder::is_taken(const AtomSite& site) {
  if (!has_model_) {
    has_model_ = true;
    model_ = site.model;
  }
  if (model_end_line_ || site.model != model_) {
    ++other_models_;
    return false;
  }
  if (is_water(site.residue, site.name)) {
    ++waters_;
    return false;
  }
  return true;
}

void StructureBuilder::add(const AtomSite& site) {
  if (!is_taken(site)) return;
  for (const double value : {site.x, site.y, site.z}) {
    if (!(std::abs(value) <= kLargestCoordinate)) {
      throw InputError(site.where + ": expected coordinates within +-1e6 A, got another of " + name_of(site));
    }
  }
  const auto radius = radii_.find(site.residue, site.name, site.element);
  if (!radius) {
    without_radius_.push_back(site);
    their_places_.push_back(file_.atoms.size());
  }
  locations_.add(site.site, {site.name, site.residue, site.alternate});
  file_.atoms.push_back({site.x, site.y, site.z, radius.value_or(0.0), 0.0});
  file_.lines.push_back(site.line);
  if (names_ == AtomNames::kLeaveOut) return;
  file_.names.push_back({std::string(site.name), std::string(site.residue), std::string(site.chain), site.number});
}

void StructureBuilder::end_model(std::size_t line) {
  if (has_model_ && !model_end_line_) model_end_line_ = line;
}

void StructureBuilder::take_one_location_each() {
  const std::vector<bool> is_taken = locations_.choose();
  MissingRadii missing_radii;
  for (std::size_t i = 0; i < without_radius_.size(); ++i) {
    if (is_taken[their_places_[i]]) missing_radii.add(without_radius_[i]);
  }
  missing_radii.require_none(radii_.name());
  std::size_t taken = 0;
  for (std::size_t i = 0; i < is_taken.size(); ++i) {
    if (!is_taken[i]) continue;
    file_.atoms[taken] = file_.atoms[i];
    file_.lines[taken] = file_.lines[i];
    if (names_ == AtomNames::kKeep && taken < i) file_.names[taken] = std::move(file_.names[i]);
    ++taken;
  }
  file_.atoms.resize(taken);
  file_.lines.resize(taken);
  if (names_ == AtomNames::kKeep) file_.names.resize(taken);
  other_locations_ = is_taken.size() - taken;
}

AtomFile StructureBuilder::finish() {
  take_one_location_each();
  if (file_.atoms.empty()) {
    throw InputError(file_name_ + ": expected atoms, got none" + (waters_ > 0 ? " but of water" : ""));
  }
  const std::string end = model_end_line_ ? ", which ends in line " + std::to_string(*model_end_line_) : "";
  warn_of(other_models_, "of models other than the first" + end, file_name_, file_);
  warn_of(waters_, "of water", file_name_, file_);
  warn_of(other_locations_, "at alternate locations other than the first", file_name_, file_);
  radii_.warn(file_);
  return std::move(file_);
}

}  // namespace gaussmesh

#include "atoms/structure_builder.h"

#include <cmath>

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
  if (!site.alternate.empty() && alternates_.try_emplace(site.site, site.alternate).first->second != site.alternate) {
    ++other_locations_;
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
    missing_radii_.add(site);
    return;
  }
  file_.atoms.push_back({site.x, site.y, site.z, *radius, 0.0});
  file_.lines.push_back(site.line);
  if (names_ == AtomNames::kLeaveOut) return;
  file_.names.push_back({std::string(site.name), std::string(site.residue), std::string(site.chain), site.number});
}

void StructureBuilder::end_model(std::size_t line) {
  if (has_model_ && !model_end_line_) model_end_line_ = line;
}

AtomFile StructureBuilder::finish() {
  missing_radii_.require_none(radii_.name());
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

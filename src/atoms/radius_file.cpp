#include "atoms/radius_file.h"

#include <iterator>
#include <set>
#include <utility>

#include "atoms/residue_names.h"
#include "core/number_text.h"
#include "gaussmesh/error.h"
#include "text/read_file.h"

namespace gaussmesh {
namespace {

std::string key_of(std::string_view residue, std::string_view name) {
  return upper_case(residue) + " " + upper_case(name);
}

/// The residue of a key, which may be empty.
std::string residue_of(const std::string& key) { return key.substr(0, key.find(' ')); }

/// Whether `name`, in upper case, is that of a hydrogen, such as HA or 1HB.
bool is_hydrogen(std::string_view name) {
  const std::size_t first = name.find_first_not_of("0123456789");
  return first != std::string_view::npos && (name[first] == 'H' || name[first] == 'D');
}

double read_radius(std::string_view field, const LinePlace& place) {
  const AtomFields fields = {"0", "0", "0", field, {}};
  const std::optional<Atom> atom = parse_atom(fields);
  if (!atom) fail_at_number(fields, place);
  require_in_range(*atom, fields, place);
  return atom->radius;
}

}  // namespace

RadiusFile::RadiusFile(std::string_view text, std::string_view name) : name_(name) {
  LineReader lines(require_text(text, name));
  while (const auto line = lines.next()) {
    const std::string_view content = trim(line->substr(0, line->find('#')));
    if (!content.empty()) add_line(content, {name, lines.number()});
  }
  if (entries_.empty()) throw InputError(name_ + ": expected lines of [residue] name radius, got none");
}

void RadiusFile::add_line(std::string_view content, const LinePlace& place) {
  const auto fields = splitter_.split(content);
  if (fields.size() != 2 && fields.size() != 3) fail_at(place, "[residue] name radius", content);
  const std::string_view residue = fields.size() == 3 ? fields[0] : std::string_view{};
  const double radius = read_radius(fields.back(), place);
  const auto [entry, is_new] =
      entries_.try_emplace(key_of(residue, fields[fields.size() - 2]), Entry{radius, place.line});
  if (!is_new) {
    fail_at(place, "each atom once", content, ", which line " + std::to_string(entry->second.line) + " has");
  }
  if (!residue.empty()) residues_.try_emplace(upper_case(residue), false);
  large_radii_.add(radius, place.line);
}

void RadiusFile::note(std::string_view residue, std::string_view atom, std::string_view element) {
  const auto noted = residues_.find(upper_case(residue));
  if (noted == residues_.end()) return;
  noted->second = true;
  for (const std::string_view name : {atom, element}) {
    const auto entry = entries_.find(key_of(residue, name));
    if (entry != entries_.end()) entry->second.fits = true;
  }
}

void RadiusFile::warn(AtomFile& file) const {
  large_radii_.warn(name_, file);
  warn_of_unused(file);
}

void RadiusFile::warn_of_unused(AtomFile& file) const {
  std::set<std::string> fitting;  // residues
  for (const auto& [key, entry] : entries_) {
    if (entry.fits) fitting.insert(residue_of(key));
  }
  std::map<std::size_t, std::string> unused;  // by line
  for (const auto& [key, entry] : entries_) {
    const std::string residue = residue_of(key);
    const auto noted = residues_.find(residue);
    const bool is_noted = noted != residues_.end() && noted->second;
    const bool is_excused =
        is_hydrogen(key.substr(residue.size() + 1)) || (is_standard_residue(residue) && fitting.count(residue) > 0);
    if (is_noted && !entry.fits && !is_excused) unused.emplace(entry.line, key);
  }
  if (unused.empty()) return;
  const auto& [line, first] = *unused.begin();
  std::string message =
      to_string({name_, line}) + ": no atom fits " + gaussmesh::quoted(first) + ", though its residue is there";
  if (unused.size() > 1) {
    message += "; as in " + counted(unused.size() - 1, "more line", "more lines") + ", the next " +
               std::to_string(std::next(unused.begin())->first);
  }
  file.warnings.push_back(std::move(message));
}

std::optional<double> RadiusFile::find(std::string_view residue, std::string_view atom,
                                       std::string_view element) const {
  for (const std::string_view of_residue : {residue, std::string_view{}}) {
    for (const std::string_view name : {atom, element}) {
      if (name.empty()) continue;
      const auto entry = entries_.find(key_of(of_residue, name));
      if (entry != entries_.end()) return entry->second.radius;
    }
  }
  return std::nullopt;
}

AtomRadii::AtomRadii(const std::string& set, const std::filesystem::path& file) {
  if (!file.empty()) {
    file_.emplace(read_file(file), file.string());
    name_.append("'").append(file.string()).append("'");
  }
  if (!set.empty() || file.empty()) {
    set_.emplace(set);
    name_.append(name_.empty() ? "'" : " and '").append(set).append("'");
  }
}

std::optional<double> AtomRadii::find(std::string_view residue, std::string_view atom, std::string_view element) {
  if (file_) file_->note(residue, atom, element);
  const auto radius = file_ ? file_->find(residue, atom, element) : std::nullopt;
  return radius || !set_ ? radius : set_->find(residue, atom, element);
}

void AtomRadii::warn(AtomFile& file) const {
  if (file_) file_->warn(file);
}

}  // namespace gaussmesh

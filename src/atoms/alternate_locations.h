// Alternate locations of atoms: which are taken.
//
// A location is a letter, and the atoms of a residue that have the same one make a conformer. But files are not always
// so regular: atoms may have letters of their own, only some of the conformers, or none in the first of two places.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gaussmesh {

/// Chooses one location for each atom that has several. As far as atoms have them, those of a residue are at the
/// location that comes first in it; others keep the first that they have.
class AlternateLocations {
 public:
  /// What tells atoms of one place apart; must outlive this.
  struct Names {
    std::string_view atom;
    std::string_view residue;
    std::string_view location;  ///< empty: none
  };

  /// Adds the next atom of the file. `site` is the same for all atoms of a residue, which may be apart in the file.
  void add(const std::string& site, const Names& names) {
    if (atoms_.empty() || site != site_) start_run(site, names);
    if (!names.location.empty()) has_locations_[residue_] = true;
    atoms_.push_back({names, residue_});
  }

  /// Of each atom, in the order in which they were added, whether it is taken. Cost: n log n.
  std::vector<bool> choose() const {
    std::vector<bool> is_taken(atoms_.size(), true);
    std::map<std::size_t, std::vector<std::size_t>> residues;
    for (std::size_t i = 0; i < atoms_.size(); ++i) {
      if (has_locations_[atoms_[i].residue]) residues[atoms_[i].residue].push_back(i);
    }
    for (const auto& [residue, members] : residues) choose_in_residue(members, is_taken);
    return is_taken;
  }

 private:
  struct AtomOfResidue {
    Names names;
    std::size_t residue = 0;
  };

  /// The latest residue of a site, and its first atom.
  struct ResidueStart {
    std::size_t residue = 0;
    Names first;
  };

  /// Begins atoms of another site than those before. Some files have second locations at their end, so a site may come
  /// again; it may also be another residue with the same number, as behind 9999 or in files that were joined.
  void start_run(const std::string& site, const Names& names) {
    site_ = site;
    const auto [start, is_new] = starts_.try_emplace(site);
    const Names& first = start->second.first;
    const bool is_other = names.location.empty() || (names.atom == first.atom && names.location == first.location);
    if (is_new || is_other) {
      start->second = {has_locations_.size(), names};
      has_locations_.push_back(false);
    }
    residue_ = start->second.residue;
  }

  /// By name, the `members` of a residue whose atoms have alternate locations. Of a residue that is one kind at one
  /// location and another at the next, the kind that comes first is kept; atoms of the others are marked as not taken.
  std::map<std::string_view, std::vector<std::size_t>> group_by_name(const std::vector<std::size_t>& members,
                                                                     std::vector<bool>& is_taken) const {
    std::set<std::string_view> names;
    for (const std::size_t i : members) {
      if (!atoms_[i].names.location.empty()) names.insert(atoms_[i].names.atom);
    }
    std::map<std::string_view, std::vector<std::size_t>> groups;
    const Names* kept = nullptr;
    for (const std::size_t i : members) {
      const Names& atom = atoms_[i].names;
      if (names.count(atom.atom) == 0) continue;
      if (kept == nullptr) kept = &atom;
      if (atom.residue == kept->residue || atom.location.empty()) {
        groups[atom.atom].push_back(i);
      } else {
        is_taken[i] = false;
      }
    }
    return groups;
  }

  /// What is known of the locations of a residue: of two that were chosen, the earlier has the lower number.
  using Ranks = std::map<std::string_view, std::size_t>;
  static constexpr std::size_t kPassedOver = std::numeric_limits<std::size_t>::max();
  static constexpr std::size_t kUnknown = kPassedOver - 1;

  static std::size_t rank_of(std::string_view location, const Ranks& ranks) {
    const auto found = ranks.find(location);
    return found == ranks.end() ? kUnknown : found->second;
  }

  /// The location for `atoms`, all of one name: the earliest of those chosen before, or else the first that was not
  /// passed over for one of them, or else the first. Notes it in `ranks`, and those that it passes over.
  std::string_view choose_location(const std::vector<std::size_t>& atoms, Ranks& ranks) const {
    std::string_view chosen = atoms_[atoms.front()].names.location;
    for (const std::size_t i : atoms) {
      const std::string_view location = atoms_[i].names.location;
      if (rank_of(location, ranks) < rank_of(chosen, ranks)) chosen = location;
    }
    ranks.try_emplace(chosen, ranks.size());
    for (const std::size_t i : atoms) ranks.try_emplace(atoms_[i].names.location, kPassedOver);
    return chosen;
  }

  void choose_in_residue(const std::vector<std::size_t>& members, std::vector<bool>& is_taken) const {
    const auto groups = group_by_name(members, is_taken);
    std::map<std::string_view, std::string_view> locations;
    Ranks ranks;
    for (const std::size_t i : members) {
      const auto group = groups.find(atoms_[i].names.atom);
      if (group == groups.end() || !is_taken[i]) continue;
      const auto [location, is_new] = locations.try_emplace(group->first);
      if (is_new) location->second = choose_location(group->second, ranks);
      is_taken[i] = atoms_[i].names.location == location->second;
    }
  }

  std::vector<AtomOfResidue> atoms_;
  std::vector<bool> has_locations_;             // of each residue
  std::map<std::string, ResidueStart> starts_;  // by site
  std::string site_;                            // of the last atom
  std::size_t residue_ = 0;                     // likewise
};

}  // namespace gaussmesh

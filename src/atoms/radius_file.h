// Radii that a user wrote into a file, and how they go together with a named set (radii.h).
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "atoms/atom_fields.h"
#include "atoms/radii.h"

namespace gaussmesh {

/// The radii of one file; read_atoms.h has its format.
class RadiusFile {
 public:
  /// @throws InputError as ReadOptions::radii_file says
  RadiusFile(std::string_view text, std::string_view name);

  /// The radius (A) of an atom; nothing if the file has none. Names in any case.
  std::optional<double> find(std::string_view residue, std::string_view atom, std::string_view element) const;

  /// Notes that the molecule has such an atom.
  void note(std::string_view residue, std::string_view atom, std::string_view element);

  /// Warns of large radii, and of entries with residues that were noted, but not with such an atom. Tables that are
  /// made for all molecules have more than one of these needs, so hydrogens do not count, nor entries of amino acids
  /// and nucleotides of which others fit.
  void warn(AtomFile& file) const;

 private:
  struct Entry {
    double radius = 0.0;
    std::size_t line = 0;
    bool fits = false;  // an atom that was noted
  };
  void warn_of_unused(AtomFile& file) const;
  void add_line(std::string_view content, const LinePlace& place);

  std::string name_;
  FieldSplitter splitter_;
  LargeRadii large_radii_;
  std::map<std::string, Entry, std::less<>> entries_;  // by residue, which may be empty, and name, with a blank between
  std::map<std::string, bool, std::less<>> residues_;  // of entries: whether one of their atoms was noted
};

/// All radii that were asked for: an entry of the file comes before those of the set.
class AtomRadii {
 public:
  /// Either may be empty, not both. @throws OptionError, InputError as RadiusSet and RadiusFile do, and if the file
  /// cannot be read
  AtomRadii(const std::string& set, const std::filesystem::path& file);

  /// What messages call them, in quotes.
  const std::string& name() const { return name_; }

  /// As the two do; and notes the atom, for warn().
  std::optional<double> find(std::string_view residue, std::string_view atom, std::string_view element);
  void warn(AtomFile& file) const;

 private:
  std::string name_;
  std::optional<RadiusSet> set_;
  std::optional<RadiusFile> file_;
};

}  // namespace gaussmesh

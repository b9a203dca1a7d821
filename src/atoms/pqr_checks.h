// What only all the records of a PQR file together give away: that it is a PDB file, that a value is missing, that what
// stands behind END is what stands before it.
//
// Single records are pqr_record.h.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "atoms/atom_fields.h"
#include "atoms/pqr_record.h"
#include "core/number_text.h"

namespace gaussmesh {

/// Weighs whether charges and radii are the occupancies and B-factors of a PDB file; the rule is in read_atoms.h.
class PdbCheck {
 public:
  void add(const Atom& atom, const AtomFields& fields, std::string_view line, std::size_t number) {
    is_possible_ = is_possible_ && has_two_decimals(fields[3]) && has_two_decimals(fields[4]) && atom.charge >= 0.0 &&
                   atom.charge <= 1.0;
    if (!is_possible_) {
      return;
    }
    if (!first_line_) {
      first_line_ = number;
      first_values_ = std::string(fields[4]) + " " + std::string(fields[3]);
    }
    ones_ += atom.charge == 1.0 ? 1 : 0;
    largest_radius_ = std::max(largest_radius_, atom.radius);
    has_elements_ = has_elements_ && line.size() >= 78 && is_letter(line[77]);
  }

  /// Throws InputError if the `atoms` records added are those of a PDB file.
  void require_pqr(std::size_t atoms, std::string_view name) const {
    constexpr std::size_t kFewestToJudge = 4;  // fewer may well be spheres made by hand
    const bool is_pdb = is_possible_ && atoms >= kFewestToJudge && 2 * ones_ >= atoms &&
                        (largest_radius_ > kSuspectRadius || largest_radius_ == 0.0 || has_elements_);
    if (is_pdb) {
      fail_at({name, *first_line_}, "charge and radius behind the coordinates", first_values_,
              ", which look like occupancy and B-factor, here as in every record: is it a PDB file? pdb2pqr gives it "
              "charges and radii, or read it with --input-format pdb and --radii; if these are meant, set the charges "
              "to 0, the surface does not use them");
    }
  }

 private:
  bool is_possible_ = true;
  bool has_elements_ = true;
  std::optional<std::size_t> first_line_;
  std::string first_values_;
  std::size_t ones_ = 0;
  double largest_radius_ = 0.0;
};

/// Finds a record that lacks one value although its fields pass, because its chain is a number: the chain is then
/// taken for the residue number, and the residue number for x. Such a record has an integer x, decimals in y and z,
/// and fewer fields before x than other records.
class MissingFieldCheck {
 public:
  void add(const NumberFields& found, std::size_t line) {
    const std::size_t leading = found.leading.size();
    const bool is_suspect = leading > 0 && found.leading.back().size() <= kLongestChain &&
                            is_integer(found.fields[0]) && has_point(found.fields[1]) && has_point(found.fields[2]);
    if (!is_suspect) {
      most_leading_ = std::max(most_leading_, leading);
    } else if (!suspect_line_ || leading < suspect_leading_) {
      suspect_line_ = line;
      suspect_leading_ = leading;
      suspect_x_ = found.fields[0];
    }
  }

  /// Throws InputError if such a record was added.
  void require_complete(std::string_view name) const {
    if (suspect_line_ && suspect_leading_ < most_leading_) {
      fail_at({name, *suspect_line_}, "as many fields as in the other records", suspect_x_,
              " in the place of x; is a value missing? If not, write x with a decimal point");
    }
  }

 private:
  static bool has_point(std::string_view field) { return field.find('.') != std::string_view::npos; }

  std::size_t most_leading_ = 0;
  std::optional<std::size_t> suspect_line_;
  std::size_t suspect_leading_ = 0;
  std::string_view suspect_x_;
};

/// Tells what is joined at END, as the chains of a complex often are, from the same atoms over again, which may be
/// frames, copies, or more molecules of one kind.
class EndCheck {
 public:
  /// Notes an END in that line. The first one behind an atom counts.
  void end(std::size_t line) {
    if (!end_line_ && !names_.empty()) end_line_ = line;
  }

  /// Notes an atom. Its record, and `names`, the part of it between serial number and x, must outlive this.
  void add(std::string_view names, std::string_view record, std::size_t line) {
    if (!end_line_) {
      names_.push_back(names);
      return;
    }
    if (behind_ == 0) {
      first_record_ = record;
      first_line_ = line;
    }
    is_repetition_ = is_repetition_ && names == names_[behind_ % names_.size()];
    ++behind_;
  }

  /// Throws InputError if the atoms behind END are once or several times those before it, in the same order.
  void require_other_atoms(std::string_view name) const {
    if (behind_ == 0 || !is_repetition_ || behind_ % names_.size() != 0) return;
    fail_at({name, first_line_},
            "other atoms behind END in line " + std::to_string(*end_line_) + " than those before it", first_record_,
            " and so on, as before; keep one of the frames or copies, or if all are to be one molecule, take END out");
  }

  /// Adds a warning to `file`, named `name`, if there are atoms behind END.
  void warn(std::string_view name, AtomFile& file) const {
    if (behind_ == 0) return;
    file.warnings.push_back(to_string({name, *end_line_}) + ": END is followed by " +
                            counted(behind_, "atom that is", "atoms that are") + " read too");
  }

 private:
  std::optional<std::size_t> end_line_;
  std::vector<std::string_view> names_;  // of the atoms before END
  std::size_t behind_ = 0;               // atoms
  bool is_repetition_ = true;            // as far as they go
  std::string_view first_record_;        // behind END
  std::size_t first_line_ = 0;
};

}  // namespace gaussmesh

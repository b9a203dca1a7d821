// The atoms near one box, in lists of different length.
#pragma once

#include "field/gaussian_field.h"

namespace gaussmesh {

/// How many of the atoms are wanted; each list is for any part of the box.
enum class Reach : std::uint8_t {
  kProof,  ///< kProofTruncation: bounds, where the atoms left out are part of them
  kPlain,  ///< kTruncation: values
  kFine,   ///< kFineTruncation: values and bounds in small boxes near singular places
};

/// Makes the lists for a box when they are asked for. Keeps buffers: one for each thread.
class LocalAtoms {
 public:
  explicit LocalAtoms(const GaussianField& field) : field_(field) {}

  /// Goes on to another box. Lists will come from those of `around`, a box that contains this one and which stays
  /// where it is as long as this does; or from the field.
  void move_to(const Box& box, LocalAtoms* around = nullptr) {
    box_ = box;
    around_ = around;
    for (List& list : lists_) list.is_made = false;
  }

  /// Valid until the next move.
  const NearAtoms& within(Reach reach) {
    List& list = lists_[static_cast<std::size_t>(reach)];
    if (!list.is_made) make(reach, list.atoms);
    list.is_made = true;
    return list.atoms;
  }

 private:
  static constexpr double kCuts[] = {kProofTruncation, kTruncation, kFineTruncation};
  struct List {
    NearAtoms atoms;
    bool is_made = false;
  };

  void make(Reach reach, NearAtoms& atoms) {
    const double cut = kCuts[static_cast<std::size_t>(reach)];
    if (around_) {
      atoms.restrict_from(around_->within(reach), box_, field_.decay(), cut);
    } else if (reach == Reach::kProof) {
      // Atoms are left out one by one: by nodes, as from the field, too many of them would count as at the cut.
      atoms.restrict_from(within(Reach::kPlain), box_, field_.decay(), cut);
    } else {
      field_.collect_near(box_, atoms, cut);
    }
  }

  const GaussianField& field_;
  Box box_;
  LocalAtoms* around_ = nullptr;
  List lists_[3];
};

}  // namespace gaussmesh

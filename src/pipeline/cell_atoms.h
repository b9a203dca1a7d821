// The atoms near cells of level 0, kept for the cells that were asked for last.
#pragma once

#include <vector>

#include "field/gaussian_field.h"

namespace gaussmesh {

/// What smaller cells, their edges and faces take their atoms from. Keeps lists: one for each thread.
class CellAtoms {
 public:
  CellAtoms(const GaussianField& field, const Lattice& lattice) : field_(field), lattice_(lattice), slots_(kSlots) {}

  /// Atoms collected with kFineTruncation for the closed cell of level 0 that `place` is in; valid until the next call.
  const NearAtoms& around(const FineIndex& place) {
    CellKey key;
    for (int k = 0; k < 3; ++k) key.lo[k] = place[k] - ((place[k] % kFinePerCell) + kFinePerCell) % kFinePerCell;
    Slot& slot = slots_[CellKeyHash{}(key) % kSlots];
    if (!slot.is_filled || slot.lo != key.lo) {
      field_.collect_near(cell_box(lattice_, key), slot.atoms, kFineTruncation);
      slot.lo = key.lo;
      slot.is_filled = true;
    }
    return slot.atoms;
  }

 private:
  static constexpr std::size_t kSlots = 256;
  struct Slot {
    bool is_filled = false;
    FineIndex lo{};
    NearAtoms atoms;
  };

  const GaussianField& field_;
  const Lattice& lattice_;
  std::vector<Slot> slots_;
};

}  // namespace gaussmesh

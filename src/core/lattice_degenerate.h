// The one failure that another lattice mends.
#pragma once

#include <stdexcept>

#include "core/lattice.h"
#include "core/place_text.h"

namespace gaussmesh {

/// The surface meets the lattice in a way that double precision cannot tell apart (through a lattice point, or tangent
/// to a lattice line, to some 1e-13). Another offset of the lattice mends it; the pipeline tries one.
struct LatticeDegenerate : std::runtime_error {
  explicit LatticeDegenerate(const Vec3& at_place)
      : std::runtime_error("the surface is degenerate with respect to the lattice at " + place_text(at_place)),
        place(at_place) {}
  Vec3 place;
};

}  // namespace gaussmesh

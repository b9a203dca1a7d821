// The one failure that another lattice mends.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/lattice.h"
#include "core/number_text.h"

namespace gaussmesh {

/// The surface meets the lattice in a way that double precision cannot tell apart (through a lattice point, or tangent
/// to a lattice line, to some 1e-13). Another offset of the lattice mends it; the pipeline tries one.
struct LatticeDegenerate : std::runtime_error {
  explicit LatticeDegenerate(const Vec3& at_place)
      : std::runtime_error("the surface is degenerate with respect to the lattice at (" + coordinate(at_place[0]) +
                           ", " + coordinate(at_place[1]) + ", " + coordinate(at_place[2]) + ")"),
        place(at_place) {}
  Vec3 place;

 private:
  static std::string coordinate(double x) { return number_text(std::round(x * 1e6) / 1e6 + 0.0, 13); }
};

}  // namespace gaussmesh

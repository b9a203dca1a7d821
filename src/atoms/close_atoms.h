// Atoms that lie on each other: copies, or alternate locations of one atom.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "gaussmesh/atom.h"
#include "gaussmesh/read_atoms.h"

namespace gaussmesh {

/// No two atoms are nearer than this (A): the shortest bond is 0.74 A long, and the dummy of a four-point water is
/// 0.15 A from its oxygen.
inline constexpr double kCloseDistance = 0.1;

/// Atoms nearer than kCloseDistance to one before them.
struct CloseAtoms {
  std::size_t count = 0;
  std::size_t first = 0;    ///< the first of them
  std::size_t partner = 0;  ///< the one before it that it is near to
  double distance = 0.0;    ///< of these two
};

/// Finds them all. Coordinates lie within +-kLargestCoordinate.
///
/// Cost: linear in the atoms, some 0.15 s for a million in the order of a molecule, however many lie in one place.
CloseAtoms find_close_atoms(const std::vector<Atom>& atoms);

/// What the numbers in AtomFile::lines count.
enum class PlaceKind { kLine, kAtom };

/// Adds a warning of close atoms to those of `file`, named `name`, if there are any.
void warn_of_close_atoms(std::string_view name, PlaceKind kind, AtomFile& file);

}  // namespace gaussmesh

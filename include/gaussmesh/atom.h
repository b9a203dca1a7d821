// The atoms that every other part of gaussmesh starts from.
#pragma once

#include <vector>

namespace gaussmesh {

/// One atom: a sphere that carries a charge.
struct Atom {
  double x = 0.0;  ///< centre (A)
  double y = 0.0;
  double z = 0.0;
  double radius = 0.0;  ///< A, >= 0; hydrogens of radius 0 are normal and count in the field
  double charge = 0.0;  ///< elementary charges; not used by the surface
};

/// The atoms with `probe_radius` (A, >= 0) added to every radius: spheres that a probe's centre cannot enter.
inline std::vector<Atom> add_probe(std::vector<Atom> atoms, double probe_radius) {
  for (Atom& atom : atoms) atom.radius += probe_radius;
  return atoms;
}

}  // namespace gaussmesh

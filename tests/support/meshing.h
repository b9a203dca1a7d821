// Meshing in one line, and the topology of what comes out.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "gaussmesh/mesh_surface.h"

namespace gaussmesh::testing {

/// One component: its genus, and whether it is a cavity.
struct Piece {
  std::int64_t genus = 0;
  bool cavity = false;
  auto operator<=>(const Piece&) const = default;
};

/// The components of a checked mesh, sorted: equal for meshes of the same topology.
inline std::vector<Piece> topology(const MeshCheck& check) {
  std::vector<Piece> pieces;
  for (const MeshComponent& c : check.components) pieces.push_back({c.genus, c.is_cavity()});
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

inline std::vector<Piece> topology(const MeshResult& result) { return topology(result.report.check); }

/// For the mesh as traced: what tests of the trace are about.
inline MeshOptions options(double decay, double isovalue, double spacing, int threads = 1) {
  MeshOptions o;
  o.improve = false;
  o.decay = decay;
  o.isovalue = isovalue;
  o.spacing = spacing;
  o.threads = threads;
  return o;
}

/// For the mesh as it is given out unless told otherwise.
inline MeshOptions improved(double decay, double isovalue, double spacing, int threads = 1) {
  MeshOptions o = options(decay, isovalue, spacing, threads);
  o.improve = true;
  return o;
}

/// Atoms on a circle around the origin, across an axis.
inline std::vector<Atom> atom_ring(int count, double ring_radius, double radius, int axis = 2) {
  std::vector<Atom> atoms;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    double p[3] = {};
    p[(axis + 1) % 3] = ring_radius * std::cos(angle);
    p[(axis + 2) % 3] = ring_radius * std::sin(angle);
    atoms.push_back({p[0], p[1], p[2], radius, 0.0});
  }
  return atoms;
}

/// Atoms spread evenly over a sphere around the origin: a Fibonacci spiral.
inline std::vector<Atom> atom_shell(int count, double shell_radius, double radius) {
  std::vector<Atom> atoms;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count, rho = std::sqrt(1.0 - z * z);
    const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    atoms.push_back(
        {shell_radius * rho * std::cos(angle), shell_radius * rho * std::sin(angle), shell_radius * z, radius, 0.0});
  }
  return atoms;
}

}  // namespace gaussmesh::testing

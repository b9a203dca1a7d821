// Measures of a mesh against its molecule, and what a solver stumbles over in meshes that are otherwise sound.
//
// Area and volume, Eqs. (3) and (4) of [LCL15], are in MeshCheck (check_mesh.h); distances between two meshes in
// compare_meshes.h. [LCL15]: Liu, Chen, Lu, J. Mol. Model. 21:113 (2015).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "gaussmesh/atom.h"
#include "gaussmesh/check_mesh.h"
#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// A mesh measured by the atoms of its molecule.
struct AtomMeasures {
  /// Mean over the vertices v of min_i |v - x_i| / r_i - 1: the relative distance from the van der Waals spheres,
  /// Eq. (12) of [LCL15]. Atoms of radius 0 do not count. Missing if there is no vertex, or no radius above 0.
  std::optional<double> vdw_distance;
  /// A^2 of the mesh at each atom: a third of every triangle goes to the nearest atom of each of its corners,
  /// nearest as find_nearest_atoms() says (vertex_data.h). They add up to the area of the mesh.
  std::vector<double> areas;
};

/// Measures a mesh by the atoms of its molecule.
///
/// @param mesh  every vertex number is there, all coordinates are finite
/// @throws OptionError if there is no atom
///
/// Cost: about 1 us a vertex on one core, less with OpenMP threads. The answer does not depend on the number of
/// threads. Thread-safe.
AtomMeasures measure_by_atoms(const TriangleMesh& mesh, const std::vector<Atom>& atoms);

/// The charges that are not inside the mesh: numbers of those atoms with a charge other than 0 whose centres lie in
/// no solid part, that is, inside of an even number of closed components. In rising order.
///
/// Exact, as check_mesh() is; a centre on the very surface is moved by an infinitesimal step. What is not closed
/// does not count: where a component is not closed, charges in it are told too.
///
/// @param mesh   every vertex number is there, all coordinates are finite
/// @param check  of this mesh
///
/// Cost: a few us a charge on one core, less with OpenMP threads. The answer does not depend on the number of
/// threads. Thread-safe.
std::vector<std::uint32_t> find_charges_outside(const TriangleMesh& mesh, const MeshCheck& check,
                                                const std::vector<Atom>& atoms);

/// Vertices that are nearly in one place.
struct NearVertices {
  std::size_t pairs = 0;        ///< nearer to each other than asked for, joined by an edge or not
  std::size_t short_edges = 0;  ///< edges shorter than that
  std::size_t crowded = 0;      ///< pairs that are also nearer than kCrowded times the mean edge at either vertex
  std::vector<std::array<std::uint32_t, 2>> examples;  ///< the first few pairs in order of their numbers, lower first
};

/// Vertices nearer than this share of their edges have slivers between them, or belong to sheets that nearly touch.
/// Where small triangles are as evenly shaped as large ones no pair is: an edge at an angle of 30 degrees is half as
/// long as the others.
inline constexpr double kCrowded = 0.25;

/// Where counting pairs ends.
inline constexpr std::size_t kMostNearPairs = 10'000'000;

/// Counts the pairs of vertices that are less than `distance` apart, and the edges that are shorter. Pairs so near
/// that are crowded as well make the matrix of a boundary-element method nearly singular.
///
/// @param mesh      every vertex number is there, coordinates are finite
/// @param distance  A, > 0
/// @throws OptionError if distance is not positive
///
/// Cost: O(vertices + pairs), some 0.5 us and 12 bytes a vertex, on one core; stops at kMostNearPairs pairs.
/// Thread-safe.
NearVertices find_near_vertices(const TriangleMesh& mesh, double distance);

}  // namespace gaussmesh

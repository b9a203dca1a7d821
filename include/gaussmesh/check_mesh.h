// The judge: what a triangle mesh is, told from its triangles alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// One closed piece of a mesh: triangles connected through shared edges.
struct MeshComponent {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::int64_t chi = 0;      ///< Euler number V - E + F
  std::int64_t genus = 0;    ///< number of handles, (2 - chi) / 2; of meaning only for a closed manifold
  double area = 0.0;         ///< A^2, Eq. (3) of [LCL15]
  double volume = 0.0;       ///< A^3, signed: negative for a cavity, Eq. (4) of [LCL15]
};

/// Everything that the triangles alone can tell.
struct MeshCheck {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t bad_indices = 0;             ///< triangles that name a vertex that is not there
  std::size_t boundary_edges = 0;          ///< edges in one triangle only
  std::size_t nonmanifold_edges = 0;       ///< edges in more than two triangles
  std::size_t misoriented_edges = 0;       ///< edges whose two triangles turn against each other
  std::size_t nonmanifold_vertices = 0;    ///< vertices whose triangles are not one closed fan
  std::size_t isolated_vertices = 0;       ///< vertices in no triangle
  std::size_t duplicate_vertices = 0;      ///< vertices at the very place of an earlier one
  std::size_t degenerate_triangles = 0;    ///< repeated vertex, or exactly zero area
  std::size_t intersecting_pairs = 0;      ///< pairs of triangles that meet in more than a shared edge or vertex
  std::vector<std::array<std::uint32_t, 2>> intersecting_examples;  ///< the first few of them
  std::vector<MeshComponent> components;   ///< outer and inner surfaces alike, largest area first
  std::size_t inverted_components = 0;     ///< outside of negative volume, or cavity of positive
  std::int64_t chi = 0;
  double area = 0.0;                       ///< A^2
  double volume = 0.0;                     ///< A^3, cavities subtracted
  double min_angle_deg = 0.0;              ///< smallest angle of any triangle
  double max_angle_deg = 0.0;
  double mean_min_angle_deg = 0.0;         ///< mean over the triangles of their smallest angle
  double mean_edge_ratio = 0.0;            ///< mean of shortest / longest edge, Fig. 7 of [LCL15]
  double min_edge = 0.0;                   ///< A
  double mean_edge = 0.0;                  ///< A, mean over the triangles' edges
  double max_edge = 0.0;                   ///< A
  double under_30_deg = 0.0;               ///< fraction of the triangles whose smallest angle is below 30 degrees

  /// Closed, oriented, embedded, turned the right way: what a boundary-element solver needs.
  bool fit_for_solver() const;
};

MeshCheck check_mesh(const TriangleMesh& mesh);

/// Reads an OFF file: comments, blank lines, CRLF and colours after a face are accepted; faces must be triangles.
TriangleMesh read_off(const std::filesystem::path& path);

}  // namespace gaussmesh

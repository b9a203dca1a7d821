// The judge: what a triangle mesh is, told from its triangles alone.
//
// The measures are those of Liu, Chen, Lu, J. Mol. Model. 21:113 (2015), called [LCL15] here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "gaussmesh/atom.h"
#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// One piece of a mesh: triangles connected through shared edges.
struct MeshComponent {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::int64_t chi = 0;    ///< Euler number V - E + F
  std::int64_t genus = 0;  ///< number of handles, (2 - chi) / 2; of meaning only for a closed manifold
  double area = 0.0;       ///< A^2, Eq. (3) of [LCL15]
  double volume = 0.0;     ///< A^3, signed: negative for a cavity, Eq. (4) of [LCL15]
  bool closed = false;     ///< every edge in two triangles that turn the same way; if not, what is below is unset
  std::size_t depth = 0;   ///< number of other closed components that it lies inside of
  bool inverted = false;   ///< volume not positive at even depth, or not negative at odd depth; decided exactly
  std::optional<std::uint32_t> parent;  ///< the innermost component that it lies inside of; none at depth 0

  /// Whether it bounds a hole in what others enclose: what lies inside of it is outside of the molecule.
  bool is_cavity() const { return depth % 2 == 1; }
};

/// Stands for the component of a triangle that could not be judged.
inline constexpr std::uint32_t kNoComponent = std::numeric_limits<std::uint32_t>::max();

using RatioHistogram = std::array<std::size_t, 20>;  ///< bins of 0.05
using AngleHistogram = std::array<std::size_t, 18>;  ///< bins of 10 degrees

/// Everything that the triangles alone can tell.
struct MeshCheck {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t bad_indices = 0;           ///< triangles that name a vertex that is not there
  std::size_t bad_coordinates = 0;       ///< vertices not finite, or of a size that bars exact signs: see below
  std::size_t boundary_edges = 0;        ///< edges in one triangle only
  std::size_t nonmanifold_edges = 0;     ///< edges in more than two triangles
  std::size_t misoriented_edges = 0;     ///< edges whose two triangles turn against each other
  std::size_t nonmanifold_vertices = 0;  ///< vertices whose triangles are not one closed fan
  std::size_t isolated_vertices = 0;     ///< vertices in no triangle
  std::size_t duplicate_vertices = 0;    ///< vertices at the very place of an earlier one
  std::size_t degenerate_triangles = 0;  ///< repeated vertex, or exactly zero area
  std::size_t intersecting_pairs = 0;    ///< pairs of triangles that meet in more than a shared edge or vertex
  std::vector<std::array<std::uint32_t, 2>> intersecting_examples;  ///< the first few of them
  std::vector<MeshComponent> components;    ///< outer and inner surfaces alike, largest area first
  std::vector<std::uint32_t> component_of;  ///< of each triangle: its place in `components`, or kNoComponent
  std::size_t inverted_components = 0;      ///< outside of negative volume, or cavity of positive
  std::int64_t chi = 0;
  double area = 0.0;           ///< A^2
  double volume = 0.0;         ///< A^3, cavities subtracted
  double min_angle_deg = 0.0;  ///< smallest angle of any triangle
  double max_angle_deg = 0.0;
  double mean_min_angle_deg = 0.0;     ///< mean over the triangles of their smallest angle
  double mean_edge_ratio = 0.0;        ///< mean of shortest / longest edge, Fig. 7 of [LCL15]
  double min_edge = 0.0;               ///< A
  double mean_edge = 0.0;              ///< A, mean over the triangles' edges
  double max_edge = 0.0;               ///< A
  double fraction_under_30_deg = 0.0;  ///< of the triangles: those whose smallest angle is below 30 degrees
  RatioHistogram ratio_histogram{};    ///< triangles by shortest / longest edge, Fig. 7 of [LCL15]
  AngleHistogram angle_histogram{};    ///< all angles of all triangles, Fig. 8 of [LCL15]

  /// Closed, oriented, embedded, turned the right way: what a boundary-element solver needs.
  ///
  /// True if every defect counted above is 0, no component is inverted, and there is a triangle.
  bool fit_for_solver() const;
};

/// Judges a mesh by its triangles alone. Trusts nothing: any mesh may be given.
///
/// Every decision is exact: signs of orientation are computed without rounding error where rounding could change
/// them, for coordinates that are 0 or between 2^-200 and 2^200 in size (about 1e-60 to 1e60). Vertices beyond
/// that are counted in `bad_coordinates`. Triangles that name one, or one that is not there, or one twice, are
/// counted and then left out, as if the mesh did not have them. Triangles of zero area take part in everything but
/// `intersecting_pairs`. Areas, volumes and shapes are rounded sums.
///
/// @throws OptionError if there are more than 2^31 triangles or vertices
///
/// Cost: about 0.4 us and 40 bytes a triangle on one core, less with OpenMP threads; more where very many boxes
/// round triangles overlap. The answer does not depend on the number of threads. Thread-safe.
MeshCheck check_mesh(const TriangleMesh& mesh);

/// How far the vertices of a mesh are from the Gaussian surface { phi = isovalue } of a molecule.
struct VertexDistance {
  double max = 0.0;   ///< A; infinite if from some vertex no way to the surface was found
  double mean = 0.0;  ///< A
};

/// Measures how far the vertices of a mesh are from { phi = isovalue }, with
/// phi(x) = sum_i exp(-decay (|x - x_i|^2 - r_i^2)).
///
/// The distance is that to the point which Newton's method along the gradient of log phi leads to, good to 1e-8 A
/// or 1e-12 of the coordinates: for a vertex that is all but on the surface |log(phi / isovalue)| / |grad log phi|,
/// taken for the distance only where a bound by second derivatives and by the atoms left out shows that it is that
/// good. Nothing overflows whatever the radii.
///
/// @param mesh      all coordinates are finite
/// @param decay     d, 1/A^2, > 0
/// @param isovalue  c, > 0
/// @throws OptionError if decay or isovalue is not positive, or there is no atom
///
/// Cost: for a vertex on the surface one evaluation over the atoms nearby, SIMD over the vertices: some 0.1 us and
/// 16 bytes a vertex, on one core with AVX-512; less with OpenMP threads. Several times that for vertices
/// elsewhere. The answer does not depend on the number of threads. Thread-safe.
VertexDistance vertex_distance_to_surface(const TriangleMesh& mesh, const std::vector<Atom>& atoms, double decay,
                                          double isovalue);

/// How far a mesh is from the Gaussian surface { phi = isovalue } of a molecule.
struct SurfaceDistance {
  double max_vertex_distance = 0.0;     ///< A; infinite if from some vertex no way to the surface was found
  double mean_vertex_distance = 0.0;    ///< A
  double max_centroid_distance = 0.0;   ///< A, of the triangles' centroids
  double mean_centroid_distance = 0.0;  ///< A
  /// Triangles whose normal makes an obtuse angle with -grad phi at the centroid.
  std::size_t faces_against_gradient = 0;
};

/// Measures the same of the vertices and of the triangles' centroids, and which way the triangles are turned.
///
/// @param mesh  every vertex number is there, all coordinates are finite; else as vertex_distance_to_surface()
///
/// Cost: as vertex_distance_to_surface(), and three evaluations and 16 bytes for each triangle. Thread-safe.
SurfaceDistance distance_to_surface(const TriangleMesh& mesh, const std::vector<Atom>& atoms, double decay,
                                    double isovalue);

}  // namespace gaussmesh

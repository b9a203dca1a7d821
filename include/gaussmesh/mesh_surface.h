// The main job: from atoms to a certified mesh of their Gaussian surface.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gaussmesh/atom.h"
#include "gaussmesh/check_mesh.h"
#include "gaussmesh/triangle_mesh.h"
#include "gaussmesh/vertex_data.h"

namespace gaussmesh {

/// What is to be meshed: { x : phi(x) = c }, phi(x) = sum_i exp(-d (|x - x_i|^2 - r_i^2)).
struct MeshOptions {
  double decay = 0.6;             ///< d, 1/A^2, 0.001 to 1000
  double isovalue = 1.7;          ///< c, 1e-9 to 1e9
  double spacing = 0.5;           ///< wanted mean edge (A), 0.01 to 200; where the mesh stays as traced, that of the
                                  ///< cells, to 1000
  bool improve = true;            ///< make the triangles nearly equilateral; otherwise they stay as traced
  double tolerance = 0.0;         ///< largest MeshReport::surface_distance (A), 1e-6 to 1000; 0: no limit
  bool measure_distance = false;  ///< fill MeshReport::surface_distance also where there is no tolerance
  int threads = 0;                ///< to 4096; 0: as many as there are processors
  double memory_bytes = 0.0;      ///< what there is for the mesh: one that surely takes more is not begun; 0: not known
  bool allow_uncertified = false;  ///< where c is too near a critical value, mesh a level beside it
  /// Called as each stage ends, on the caller's thread, with its name: `boxes and roots`, `folds`, `curves`, `patches`,
  /// `improve`, `verify`, some of them several times. What it throws ends the work and comes out of mesh_surface().
  std::function<void(const std::string& stage)> on_stage_end;
  /// Called often within the stage `improve`: on any thread, on several at a time, and not always in rising order.
  /// What it throws comes out too.
  std::function<void(double share_done)> on_improving;
};

/// The spacing (A) that gives about this many vertices per A^2, > 0: equilateral triangles of edge s have
/// 2 / (sqrt(3) s^2).
double spacing_for_density(double vertices_per_A2);

/// A place where phi = c is (nearly) singular.
struct CriticalPlace {
  std::array<double, 3> point{};  ///< the critical point of phi (A)
  double value = 0.0;             ///< phi there: c differs from it by too little
};

/// Boxes of one size that the proof looked at.
struct BoxCount {
  double size = 0.0;  ///< edge (A)
  std::size_t boxes = 0;
};

/// What one stage cost.
struct StageCost {
  std::string name;
  double time_s = 0.0;          ///< wall clock
  double peak_memory_MB = 0.0;  ///< of the whole process, up to the end of the stage
};

/// Cavities that are not in the mesh because the caller took them out of it.
struct CavitiesLeftOut {
  std::size_t components = 0;  ///< the cavities, and what lies in them
  double volume = 0.0;         ///< A^3, that the mesh encloses more than the surface does
};

/// Where the atoms come from, for the report. Empty names: not known.
struct AtomSource {
  std::string file;                   ///< as it was named; "-": standard input
  std::string radii;                  ///< the set that was asked for, for files that have none of their own
  std::vector<std::string> warnings;  ///< of the reader
  std::string radii_file = {};        ///< the file of radii that was named, whose entries come before the set
};

/// How the mesh came about, and what was proven of it.
struct MeshReport {
  std::size_t atoms = 0;
  MeshOptions options;
  double isovalue_used = 0.0;   ///< differs from the option only when uncertified
  std::vector<BoxCount> boxes;  ///< largest first
  double smallest_box = 0.0;    ///< A
  std::size_t cells = 0;        ///< of the asked-for spacing, near the surface
  std::size_t cells_cut_by_folds = 0;
  std::size_t cells_split = 0;             ///< cells of any size that were cut in eight
  bool certified = false;                  ///< the mesh has exactly the topology of the surface, proven by bounds
  std::vector<CriticalPlace> critical;     ///< where a proof would need boxes below the depth limit
  std::optional<double> surface_distance;  ///< A, the larger way of two_sided_distance(): triangles and surface
  double vertex_distance_max = 0.0;        ///< A, largest distance of a vertex from phi = c
  MeshCheck check;                         ///< what the judge found of the triangles
  std::vector<StageCost> stages;
  double probe_radius = 0.0;       ///< A, what the caller had added to all radii beforehand
  AtomSource source;               ///< what the caller says of the atoms
  std::string cavities = "keep";   ///< what the caller did with them: or drop, separate
  double min_cavity_volume = 0.0;  ///< A^3; the caller filled smaller ones
  CavitiesLeftOut left_out;        ///< what the caller did to the mesh afterwards; `check` is then of what remains
};

struct MeshResult {
  TriangleMesh mesh;            ///< coordinates are whole numbers of 1e-9 A
  std::vector<Normal> normals;  ///< of the field at the vertices
  MeshReport report;
};

/// Meshes the Gaussian surface of `atoms`.
///
/// The mesh is closed, embedded and oriented (counter-clockwise seen from the solvent), every vertex is on the surface
/// to within 1e-6 A, and it has the components, cavities and handles of the exact surface: of the level
/// MeshReport::isovalue_used, which is not c only where `allow_uncertified` was needed. Same bits for any number of
/// threads and any order of the atoms. Thread-safe.
///
/// Cost: grows with the area of the surface over the square of the spacing, and with the number of atoms. For a protein
/// about 7 us and 130 bytes a triangle on one core, as traced 2 us and 80 bytes; less time with OpenMP threads.
///
/// @throws OptionError      if an option is out of its range, or there is a tolerance for a mesh as traced
/// @throws InputError       if there are no atoms, or one with a coordinate or radius that cannot be
/// @throws CannotMeshError  if phi < c everywhere, if the tolerance is not reached, if c is so near a critical value
///                          that the topology is not certain; if the cells are too coarse for the surface, or it goes
///                          through one of them, or a brick of them, too often to be counted; if double precision
///                          cannot tell how the surface meets the lattice, wherever that lies; if the mesh is too
///                          large for the memory, or has more than 2^31 vertices or triangles
/// @throws InternalError    if the mesh is not what is promised here: nothing of it is given out
MeshResult mesh_surface(const std::vector<Atom>& atoms, const MeshOptions& options);

/// The report as JSON; lengths in A and units spelt in the keys.
std::string report_json(const MeshReport& report);

/// Its part about the shapes of the triangles, an object, for reports on meshes from elsewhere.
std::string quality_json(const MeshCheck& check);

/// Three lines: what was made, the shapes of the triangles, and what was proved.
std::string report_summary(const MeshReport& report);

}  // namespace gaussmesh

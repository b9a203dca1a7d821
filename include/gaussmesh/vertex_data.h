// What a mesh file can hold beside the triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gaussmesh/atom.h"
#include "gaussmesh/check_mesh.h"
#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// What is known at the vertices of a mesh: each list has one entry for each vertex, or is empty.
struct VertexData {
  std::vector<Normal> normals;
  std::vector<std::uint32_t> atoms;       ///< the nearest atom, counted from 0 in the order of the file
  std::vector<std::uint32_t> components;  ///< place in MeshCheck::components
  std::size_t atom_count = 0;  ///< of the molecule, for headers of MSMS; 0: not known, as many as `atoms` tell of
};

/// The atom nearest to each vertex in the measure of the field: that of the smallest |x - x_i|^2 - r_i^2, which
/// gives the largest share of phi for any decay. Of equal ones the first.
///
/// @param mesh     finite coordinates
/// @param threads  0: one for each processor
/// @throws OptionError if there is no atom
///
/// Cost: the atoms near each vertex, about 0.5 us a vertex. The answer does not depend on the number of threads.
/// Thread-safe.
std::vector<std::uint32_t> find_nearest_atoms(const TriangleMesh& mesh, const std::vector<Atom>& atoms, int threads);

/// The component of each vertex, from those of its triangles in `check`, which is of this mesh; kNoComponent for a
/// vertex in no triangle that was judged. Cost: O(n). Thread-safe.
std::vector<std::uint32_t> find_vertex_components(const TriangleMesh& mesh, const MeshCheck& check);

/// Unit normals from the triangles alone: the sum of those around a vertex, weighted by their areas. Zero where
/// there are none. For meshes that come without normals; those of the field are better. Cost: O(n). Thread-safe.
std::vector<Normal> average_normals(const TriangleMesh& mesh);

}  // namespace gaussmesh

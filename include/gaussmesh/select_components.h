// Parts of a mesh: without its cavities, or each closed surface for itself.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "gaussmesh/check_mesh.h"
#include "gaussmesh/read_mesh.h"
#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// The components that stay, by their place in MeshCheck::components.
using ComponentList = std::vector<std::uint32_t>;

/// Those that remain when cavities of less than `min_volume` (A^3) are left out, and all that lies in one left out.
///
/// A cavity's volume is all that its surface encloses. Infinity leaves out every cavity; what stays are the outsides
/// that lie in nothing.
ComponentList leave_out_cavities(const MeshCheck& check, double min_volume);

/// All components: outsides first, then cavities, larger areas first.
ComponentList outsides_first(const MeshCheck& check);

/// The same findings with the components in another order, one of all of them.
MeshCheck reorder_components(MeshCheck check, const ComponentList& order);

/// The triangles of `components` with their vertices and what is known of them, in their order; numbers of components
/// in the data count through `components`.
///
/// @param check  of `mesh`
///
/// Cost: O(n) in the whole mesh, however small the components are; for each by itself there is split_components().
/// Thread-safe.
MeshFile extract_components(const TriangleMesh& mesh, const VertexData& data, const MeshCheck& check,
                            const ComponentList& components);

/// Calls `take` for each component in the order of MeshCheck::components, with the mesh that extract_components() makes
/// of it alone. There is one such mesh at a time.
///
/// @param check  of `mesh`
///
/// Cost: O(n log n) for all of them together, and 4 bytes for each triangle and vertex.
/// Thread-safe, as far as `take` is.
void split_components(const TriangleMesh& mesh, const VertexData& data, const MeshCheck& check,
                      const std::function<void(std::uint32_t component, const MeshFile& part)>& take);

}  // namespace gaussmesh

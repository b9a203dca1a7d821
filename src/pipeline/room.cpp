#include "pipeline/room.h"

#include "core/number_text.h"
#include "gaussmesh/error.h"
#include "gaussmesh/triangle_mesh.h"
#include "improve/cell_size.h"

namespace gaussmesh {
namespace {

/// Less than large meshes of proteins take at the peak.
constexpr double kBytesPerTriangle = 100.0, kBytesPerTriangleAsTraced = 60.0;

constexpr auto kMostTriangles = static_cast<double>(kMostParts);

double bytes_for(double triangles, const MeshOptions& options) {
  return triangles * (options.improve ? kBytesPerTriangle : kBytesPerTriangleAsTraced);
}

bool is_room(double triangles, const MeshOptions& options) {
  return triangles <= kMostTriangles &&
         (options.memory_bytes == 0.0 || bytes_for(triangles, options) <= options.memory_bytes);
}

}  // namespace

void require_room(double triangles, const MeshOptions& options) {
  if (is_room(triangles, options)) return;
  const char* larger = options.tolerance > 0.0 ? "spacing or tolerance" : "spacing";
  if (triangles > kMostTriangles) {
    throw CannotMeshError("some " + number_text(triangles, 2) + " triangles are to come, and at most " +
                          number_text(kMostTriangles, 2) + " can be numbered; choose a larger " + larger);
  }
  throw CannotMeshError("some " + number_text(triangles, 2) + " triangles are to come, which take " +
                        number_text(1e-9 * bytes_for(triangles, options), 2) + " GB of memory, and there are " +
                        number_text(1e-9 * options.memory_bytes, 2) + " GB; choose a larger " + larger +
                        ", or set --max-memory");
}

void require_room_as_traced(const GaussianField& field, const MeshOptions& options) {
  if (is_room(triangles_on(area_of_spheres(field), options.spacing), options)) return;
  SizeTargets targets;
  targets.spacing = options.spacing;
  require_room(triangles_on(sample_sizes(field, targets).area, options.spacing), options);
}

}  // namespace gaussmesh

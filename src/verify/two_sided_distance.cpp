// Samples on the triangles, their feet on the surface, and the feet's distances from the mesh.

#include "gaussmesh/two_sided_distance.h"

#include <algorithm>
#include <cmath>

#include "verify/nearest_triangle.h"
#include "verify/parallel.h"
#include "verify/surface_feet.h"
#include "verify/triangle_tree.h"
#include "verify/vector3.h"

namespace gaussmesh {

using namespace verify;

namespace {

constexpr double kPrecision = 1e-5;  // A, of the feet

/// The mesh and the surface.
struct Both {
  const TriangleMesh& mesh;
  const TriangleTree& triangles;
  const AtomTree& atoms;
  double decay = 0.0;
  double isovalue = 0.0;
};

/// Samples of some triangles, and the triangle of each.
struct Samples {
  std::vector<Point> points;
  std::vector<std::uint32_t> triangles;

  void add(const Point& point, std::uint32_t triangle) {
    points.push_back(point);
    triangles.push_back(triangle);
  }
};

Samples sample(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  Samples samples;
  for (const std::uint32_t t : triangles) {
    Point centroid{};
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = mesh.triangles[t][corner];
      const std::uint32_t to = mesh.triangles[t][(corner + 1) % 3];
      const Point& a = mesh.vertices[from];
      const Point& b = mesh.vertices[to];
      for (int k = 0; k < 3; ++k) centroid[k] += a[k] / 3;
      if (from < to) samples.add({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}, t);
    }
    samples.add(centroid, t);
  }
  return samples;
}

/// A foot is at most as far from the mesh as from the sample that it is the foot of: only those are looked at
/// closer that may be farther than all before them.
void add_way_back(const Both& both, const Foot& foot, std::uint32_t triangle, TwoSidedDistance& found) {
  if (!(foot.distance > found.surface_to_mesh) || std::isinf(foot.distance)) return;
  const auto& [a, b, c] = both.mesh.triangles[triangle];
  const double most_sq =
      distance_sq_to_triangle(foot.place, both.mesh.vertices[a], both.mesh.vertices[b], both.mesh.vertices[c]);
  if (most_sq <= found.surface_to_mesh * found.surface_to_mesh) return;
  const double distance = std::sqrt(find_nearest_triangle(foot.place, both.mesh, both.triangles, triangle).distance_sq);
  if (distance <= found.surface_to_mesh) return;
  found.surface_to_mesh = distance;
  found.farthest_of_surface = foot.place;
}

/// @return the distances of the samples of these triangles; the mean is a sum
TwoSidedDistance measure(const Both& both, std::span<const std::uint32_t> triangles) {
  constexpr double kReach = 0.25;  // widths of a Gaussian: what the middle of a triangle may be off the surface
  const Samples samples = sample(both.mesh, triangles);
  std::vector<Foot> feet(samples.points.size());
  FootFinder(both.atoms, both.decay, both.isovalue, kReach / std::sqrt(both.decay), kPrecision)
      .find(samples.points, feet);
  TwoSidedDistance found;
  found.samples = feet.size();
  for (std::size_t i = 0; i < feet.size(); ++i) {
    found.mean_mesh_to_surface += feet[i].distance;
    if (feet[i].distance > found.mesh_to_surface) {
      found.mesh_to_surface = feet[i].distance;
      found.farthest_of_mesh = samples.points[i];
    }
    add_way_back(both, feet[i], samples.triangles[i], found);
  }
  return found;
}

void add(TwoSidedDistance& to, const TwoSidedDistance& from) {
  to.samples += from.samples;
  to.mean_mesh_to_surface += from.mean_mesh_to_surface;
  if (from.mesh_to_surface > to.mesh_to_surface) {
    to.mesh_to_surface = from.mesh_to_surface;
    to.farthest_of_mesh = from.farthest_of_mesh;
  }
  if (from.surface_to_mesh > to.surface_to_mesh) {
    to.surface_to_mesh = from.surface_to_mesh;
    to.farthest_of_surface = from.farthest_of_surface;
  }
}

}  // namespace

TwoSidedDistance two_sided_distance(const TriangleMesh& mesh, const std::vector<Atom>& atoms, double decay,
                                    double isovalue) {
  constexpr std::size_t kBlocksInRun = 8 * TriangleTree::kPatchBlocks;
  const AtomTree atom_tree = tree_for_surface(atoms, decay, isovalue);
  const TriangleTree tree(mesh);
  const Both both{mesh, tree, atom_tree, decay, isovalue};
  std::vector<TwoSidedDistance> parts(chunk_count(tree.block_count(), kBlocksInRun));
  parallel_for_chunks(tree.block_count(), kBlocksInRun, [&](std::size_t part, std::size_t begin, std::size_t end) {
    parts[part] = measure(both, tree.blocks(begin, end));
  });
  TwoSidedDistance all;
  for (const TwoSidedDistance& part : parts) add(all, part);
  if (all.samples > 0) all.mean_mesh_to_surface /= static_cast<double>(all.samples);
  return all;
}

}  // namespace gaussmesh

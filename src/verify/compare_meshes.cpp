// The distances of the samples of one mesh from another.

#include "gaussmesh/compare_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "gaussmesh/error.h"
#include "verify/exact_orientation.h"
#include "verify/nearest_triangle.h"
#include "verify/number_text.h"
#include "verify/parallel.h"
#include "verify/triangle_tree.h"
#include "verify/vector3.h"

namespace gaussmesh {

using namespace verify;

namespace {

void require_usable(const TriangleMesh& mesh, const char* which) {
  const std::string name = std::string(which) + " mesh: ";
  if (mesh.triangles.empty()) throw InputError(name + "expected triangles, got none");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t vertex : mesh.triangles[t]) {
      if (vertex >= mesh.vertices.size())
        throw InputError(name + "expected vertices for all triangles, got none with the number " +
                         std::to_string(vertex) + " that triangle " + std::to_string(t) + " names");
      for (const double x : mesh.vertices[vertex])
        if (!(std::abs(x) <= kLargestExact))
          throw InputError(name + "expected coordinates within 1e60 A, got '" + text_of(x) + "' for vertex " +
                           std::to_string(vertex));
    }
}

/// Sums over the samples of some triangles.
struct SampleSums {
  OneSidedDistance distance;  // its mean and rms are sums, weighted by area
  double area = 0.0;

  void add(const Point& p, double from_it, double radius, double weight) {
    ++distance.samples;
    distance.max_bound = std::max(distance.max_bound, from_it + radius);
    distance.mean += weight * from_it;
    distance.rms += weight * from_it * from_it;
    area += weight;
    add_largest(p, from_it);
  }

  void add_largest(const Point& p, double from_it) {
    if (from_it < distance.max) return;
    distance.max = from_it;
    distance.farthest = p;
  }
};

/// Samples triangles of one mesh, and finds each sample's distance from the other.
class Sampler {
 public:
  Sampler(const TriangleMesh& from, const TriangleMesh& to, const TriangleTree& to_tree, double density)
      : from_(from), to_(to), to_tree_(to_tree), density_(density) {}

  void sample(const Triangle& triangle, SampleSums& sums) {
    const Point a = from_.vertices[triangle[0]];
    const Point ab = difference(from_.vertices[triangle[1]], a);
    const Point ac = difference(from_.vertices[triangle[2]], a);
    const double area = length(cross(ab, ac)) / 2;
    const auto cuts = cuts_for(area);
    const double radius = radius_of(ab, ac) / cuts;
    const double weight = area / (static_cast<double>(cuts) * cuts);
    const auto place = [&](double u, double v) {
      Point p{};
      for (int k = 0; k < 3; ++k) p[k] = a[k] + (u * ab[k] + v * ac[k]) / cuts;
      return p;
    };
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; i + j < cuts; ++j) {
        const Point upright = place(i + 1.0 / 3, j + 1.0 / 3);
        sums.add(upright, distance_of(upright), radius, weight);
        if (i + j + 1 == cuts) continue;
        const Point inverted = place(i + 2.0 / 3, j + 2.0 / 3);
        sums.add(inverted, distance_of(inverted), radius, weight);
      }
  }

  void sample_vertex(std::uint32_t vertex, SampleSums& sums) {
    const Point& p = from_.vertices[vertex];
    sums.add_largest(p, distance_of(p));
  }

 private:
  int cuts_for(double area) const { return static_cast<int>(std::max(1.0, std::ceil(std::sqrt(area * density_)))); }

  /// How far the corners are from the centroid, at most.
  static double radius_of(const Point& ab, const Point& ac) {
    double largest = 0.0;
    for (const auto& [u, v] : {std::array{1.0, 1.0}, {-2.0, 1.0}, {1.0, -2.0}}) {
      Point arm{};
      for (int k = 0; k < 3; ++k) arm[k] = (u * ab[k] + v * ac[k]) / 3;
      largest = std::max(largest, length(arm));
    }
    return largest;
  }

  double distance_of(const Point& p) {
    const NearestTriangle nearest = find_nearest_triangle(p, to_, to_tree_, guess_);
    guess_ = nearest.triangle;
    return std::sqrt(nearest.distance_sq);
  }

  const TriangleMesh& from_;
  const TriangleMesh& to_;
  const TriangleTree& to_tree_;
  double density_;
  std::uint32_t guess_ = 0;  // the triangle that was nearest to the last sample
};

OneSidedDistance add_up(const std::vector<SampleSums>& parts) {
  SampleSums all;
  for (const SampleSums& part : parts) {
    all.distance.samples += part.distance.samples;
    all.distance.max_bound = std::max(all.distance.max_bound, part.distance.max_bound);
    all.distance.mean += part.distance.mean;
    all.distance.rms += part.distance.rms;
    all.area += part.area;
    all.add_largest(part.distance.farthest, part.distance.max);
  }
  if (all.area > 0.0) {
    all.distance.mean /= all.area;
    all.distance.rms = std::sqrt(all.distance.rms / all.area);
  }
  return all.distance;
}

/// The first triangle that names each vertex.
std::vector<std::uint32_t> find_first_triangles(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> first(mesh.vertices.size());
  for (std::size_t t = mesh.triangles.size(); t-- > 0;)
    for (const std::uint32_t vertex : mesh.triangles[t]) first[vertex] = static_cast<std::uint32_t>(t);
  return first;
}

/// Triangles are taken patch by patch, so that the last sample's nearest triangle is a good guess for the next.
OneSidedDistance measure_from(const TriangleMesh& from, const TriangleTree& from_tree, const TriangleMesh& to,
                              const TriangleTree& to_tree, double density) {
  constexpr std::size_t kBlocksInPart = TriangleTree::kPatchBlocks;
  const std::vector<std::uint32_t> first_triangle = find_first_triangles(from);
  std::vector<SampleSums> parts(chunk_count(from_tree.block_count(), kBlocksInPart));
  parallel_for_chunks(from_tree.block_count(), kBlocksInPart,
                      [&](std::size_t part, std::size_t begin, std::size_t end) {
                        Sampler sampler(from, to, to_tree, density);
                        for (const std::uint32_t t : from_tree.blocks(begin, end)) {
                          sampler.sample(from.triangles[t], parts[part]);
                          for (const std::uint32_t vertex : from.triangles[t])
                            if (first_triangle[vertex] == t) sampler.sample_vertex(vertex, parts[part]);
                        }
                      });
  return add_up(parts);
}

void require_density(const TriangleMesh& mesh, double density) {
  constexpr double kMostSamples = 0x1p20;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point& corner = mesh.vertices[a];
    const double area = length(cross(difference(mesh.vertices[b], corner), difference(mesh.vertices[c], corner))) / 2;
    if (!(area * density <= kMostSamples))
      throw OptionError("samples per A^2: expected at most 2^20 samples in a triangle, got '" + text_of(density) +
                        "' and a triangle of " + text_of(area) + " A^2");
  }
}

}  // namespace

double MeshComparison::hausdorff() const { return std::max(first_to_second.max, second_to_first.max); }

double MeshComparison::hausdorff_bound() const {
  return std::max(first_to_second.max_bound, second_to_first.max_bound);
}

MeshComparison compare_meshes(const TriangleMesh& first, const TriangleMesh& second, const CompareOptions& options) {
  const double density = options.samples_per_A2;
  if (!(density > 0.0) || std::isinf(density))
    throw OptionError("samples per A^2: expected a number > 0, got '" + text_of(density) + "'");
  require_usable(first, "first");
  require_usable(second, "second");
  require_density(first, density);
  require_density(second, density);
  const TriangleTree first_tree(first);
  const TriangleTree second_tree(second);
  return {measure_from(first, first_tree, second, second_tree, density),
          measure_from(second, second_tree, first, first_tree, density)};
}

}  // namespace gaussmesh

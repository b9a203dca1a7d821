#include "improve/close_sheets.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "core/simd.h"
#include "improve/float_box.h"

namespace gaussmesh {
namespace {

/// Vertices whose normals differ by more than this (cosine; 75 degrees) and which are near are of two sheets.
constexpr float kOtherSheet = 0.25f;

/// What counts as near, in wanted sizes. Triangles of that size turn by about a radian at most, and lie within a
/// fifth of it from the surface: sheets farther apart than two fifths cannot meet, and where they are nearer, one
/// of them has a vertex within this of some vertex of the other. Larger means more exact tests, each of them for
/// nothing.
constexpr float kReachInSizes = 1.0f;

/// Places relative to the block (A), normals and reaches (A) of vertices, and which have a close sheet.
struct VertexArrays {
  std::vector<float> x, y, z, nx, ny, nz, reach;
  std::vector<std::int32_t> is_close;
};

/// So many vertices follow each other in a leaf of the tree.
constexpr std::size_t kLeafSize = 16;

/// Marks the vertices of two leaves of which one is of another sheet than one of the other leaf and within reach of it.
/// @param some, others  first vertices of the leaves
GAUSSMESH_SIMD_CLONES
void mark_close(VertexArrays& a, std::size_t some, std::size_t others) {
  const float *xs = &a.x[others], *ys = &a.y[others], *zs = &a.z[others], *reaches = &a.reach[others];
  const float *nxs = &a.nx[others], *nys = &a.ny[others], *nzs = &a.nz[others];
  std::int32_t close[kLeafSize] = {};
  for (std::size_t v = some; v < some + kLeafSize; ++v) {
    const float x = a.x[v], y = a.y[v], z = a.z[v], nx = a.nx[v], ny = a.ny[v], nz = a.nz[v], reach = a.reach[v];
    std::int32_t found = 0;
#pragma omp simd reduction(| : found)
    for (std::size_t i = 0; i < kLeafSize; ++i) {
      const float dx = xs[i] - x, dy = ys[i] - y, dz = zs[i] - z;
      const float most = reaches[i] > reach ? reaches[i] : reach;
      const std::int32_t is_close = std::int32_t{nx * nxs[i] + ny * nys[i] + nz * nzs[i] < kOtherSheet} &
                                    std::int32_t{dx * dx + dy * dy + dz * dz < most * most};
      close[i] |= is_close;
      found |= is_close;
    }
    a.is_close[v] |= found;
  }
  for (std::size_t i = 0; i < kLeafSize; ++i) a.is_close[others + i] |= close[i];
}

/// Least scalar product of a vector in each of two boxes.
float least_cosine(const FloatBox& a, const FloatBox& b) {
  float sum = 0.0f;
  for (int k = 0; k < 3; ++k) {
    sum += std::min({a.lo[k] * b.lo[k], a.lo[k] * b.hi[k], a.hi[k] * b.lo[k], a.hi[k] * b.hi[k]});
  }
  return sum;
}

float least_distance_sq(const FloatBox& a, const FloatBox& b) {
  float sum = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const float gap = std::max({a.lo[k] - b.hi[k], b.lo[k] - a.hi[k], 0.0f});
    sum += gap * gap;
  }
  return sum;
}

/// The vertices of a block in the order of a space-filling curve, and a binary tree over runs of them.
class VertexTree {
 public:
  explicit VertexTree(const BlockMesh& mesh) : order_(along_curve(mesh)) {
    const std::size_t count = order_.size();
    leaves_ = std::bit_ceil((count + kLeafSize - 1) / kLeafSize);
    for (auto* array : {&of_.x, &of_.y, &of_.z, &of_.nx, &of_.ny, &of_.nz, &of_.reach}) {
      array->assign(leaves_ * kLeafSize, std::numeric_limits<float>::quiet_NaN());  // never close to anything
    }
    of_.is_close.assign(leaves_ * kLeafSize, 0);
    nodes_.resize(2 * leaves_);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t v = order_[i];
      const Normal& n = mesh.normal[v];
      of_.x[i] = static_cast<float>(mesh.at[v][0] - mesh.box.lo[0]);
      of_.y[i] = static_cast<float>(mesh.at[v][1] - mesh.box.lo[1]);
      of_.z[i] = static_cast<float>(mesh.at[v][2] - mesh.box.lo[2]);
      of_.nx[i] = n[0];
      of_.ny[i] = n[1];
      of_.nz[i] = n[2];
      of_.reach[i] = kReachInSizes * mesh.size[v];
      Node one;
      one.places.lo = one.places.hi = {of_.x[i], of_.y[i], of_.z[i]};
      one.normals.lo = one.normals.hi = n;
      one.reach = of_.reach[i];
      nodes_[leaves_ + i / kLeafSize].add(one);
    }
    for (std::size_t i = leaves_ - 1; i > 0; --i) {
      nodes_[i].add(nodes_[2 * i]);
      nodes_[i].add(nodes_[2 * i + 1]);
    }
  }

  /// By vertex: whether it has one of another sheet within reach, or is within reach of one.
  std::vector<std::uint8_t> find_close_sheets() {
    visit(1, 1);
    std::vector<std::uint8_t> result(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) result[order_[i]] = static_cast<std::uint8_t>(of_.is_close[i]);
    return result;
  }

 private:
  struct Node {
    FloatBox places, normals;
    float reach = -1.0f;  ///< largest; negative: no vertex

    void add(const Node& other) {
      places.add(other.places);
      normals.add(other.normals);
      reach = std::max(reach, other.reach);
    }
    bool may_be_close(const Node& other) const {
      const float most = std::max(reach, other.reach);
      return least_distance_sq(places, other.places) < most * most &&
             least_cosine(normals, other.normals) < kOtherSheet;
    }
  };

  /// The vertices in the order of the Morton codes of their places.
  static std::vector<std::uint32_t> along_curve(const BlockMesh& mesh) {
    constexpr int kBits = 10;  // of a code along an axis
    double width = 0.0;
    for (int k = 0; k < 3; ++k) width = std::max(width, mesh.box.hi[k] - mesh.box.lo[k]);
    std::vector<std::uint64_t> keys;
    keys.reserve(mesh.at.size());
    for (std::uint32_t v = 0; v < mesh.at.size(); ++v) {
      std::uint64_t code = 0;
      for (int k = 0; k < 3; ++k) {
        const int at = slab_of((mesh.at[v][k] - mesh.box.lo[k]) / width * (1 << kBits), 1 << kBits);
        code |= spread_bits(static_cast<std::uint32_t>(at)) << k;
      }
      keys.push_back(code << 32 | v);
    }
    std::sort(keys.begin(), keys.end());
    return {keys.begin(), keys.end()};
  }

  /// Ten bits with room for two between any and the next.
  static std::uint64_t spread_bits(std::uint32_t bits) {
    bits = (bits | bits << 16) & 0x030000FFu;
    bits = (bits | bits << 8) & 0x0300F00Fu;
    bits = (bits | bits << 4) & 0x030C30C3u;
    bits = (bits | bits << 2) & 0x09249249u;
    return bits;
  }

  /// Marks what is close in two nodes of one level. @param b  not less than a: each pair once
  void visit(std::size_t a, std::size_t b) {
    if (!nodes_[a].may_be_close(nodes_[b])) return;
    if (a >= leaves_) return mark_close(of_, (a - leaves_) * kLeafSize, (b - leaves_) * kLeafSize);
    visit(2 * a, 2 * b);
    visit(2 * a, 2 * b + 1);
    if (a != b) visit(2 * a + 1, 2 * b);
    visit(2 * a + 1, 2 * b + 1);
  }

  std::vector<std::uint32_t> order_;  ///< vertices by their place along the curve
  VertexArrays of_;                   ///< by place along the curve
  std::size_t leaves_;                ///< a power of two
  std::vector<Node> nodes_;           ///< node i is parent of 2 i and 2 i + 1; leaves from leaves_ on
};

}  // namespace

std::vector<std::uint8_t> find_close_sheets(const BlockMesh& mesh) {
  if (mesh.at.empty()) return {};
  return VertexTree(mesh).find_close_sheets();
}

}  // namespace gaussmesh

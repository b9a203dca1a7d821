#include "improve/mesh_blocks.h"

#include <numeric>
#include <unordered_map>

#include "core/parallel.h"
#include "core/sort_and_unite.h"

namespace gaussmesh {
namespace {

using Cube = std::array<std::int64_t, 3>;

struct CubeHash {
  std::size_t operator()(const Cube& cube) const {
    std::uint64_t h = 0;
    for (const std::int64_t i : cube) h = (h ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15ull + (h >> 29);
    return h ^ (h >> 32);
  }
};

/// Planes of one axis; cube i holds the coordinates in [plane(i), plane(i + 1)).
struct Planes {
  double edge, shift;

  double plane(std::int64_t i) const { return shift + static_cast<double>(i) * edge; }
  std::int64_t cube_of(double x) const {
    auto i = static_cast<std::int64_t>(std::floor((x - shift) / edge));
    while (x < plane(i)) --i;
    while (x >= plane(i + 1)) ++i;
    return i;
  }
};

/// Lists by block, from pairs of block and member in the order of the members.
void fill_lists(const std::vector<std::array<std::uint32_t, 2>>& pairs, std::size_t blocks,
                std::vector<std::uint32_t>& first, std::vector<std::uint32_t>& members) {
  first.assign(blocks + 1, 0);
  for (const auto& p : pairs) ++first[p[0] + 1];
  for (std::size_t b = 0; b < blocks; ++b) first[b + 1] += first[b];
  members.resize(pairs.size());
  std::vector<std::uint32_t> fill(first.begin(), first.end() - 1);
  for (const auto& p : pairs) members[fill[p[0]]++] = p[1];
}

}  // namespace

MeshBlocks::MeshBlocks(WholeMesh whole, double edge, const Vec3& shift)
    : mesh_(std::move(whole)), block_of_(mesh_.at.size()), local_(mesh_.at.size()) {
  const WholeMesh& mesh = mesh_;
  const std::array<Planes, 3> planes{Planes{edge, shift[0]}, {edge, shift[1]}, {edge, shift[2]}};
  std::unordered_map<Cube, std::uint32_t, CubeHash> blocks;
  std::vector<std::uint32_t> counts;
  Cube last{};
  std::uint32_t last_block = HalfEdgeMesh::kNone;
  for (std::uint32_t v = 0; v < mesh.at.size(); ++v) {
    const Vec3& p = mesh.at[v];
    const Cube cube{planes[0].cube_of(p[0]), planes[1].cube_of(p[1]), planes[2].cube_of(p[2])};
    if (last_block == HalfEdgeMesh::kNone || cube != last) {
      const auto [it, is_new] = blocks.try_emplace(cube, static_cast<std::uint32_t>(boxes_.size()));
      if (is_new) {
        Box box;
        for (int k = 0; k < 3; ++k) {
          box.lo[k] = planes[k].plane(cube[k]);
          box.hi[k] = planes[k].plane(cube[k] + 1);
        }
        boxes_.push_back(box);
        counts.push_back(0);
      }
      last = cube;
      last_block = it->second;
    }
    block_of_[v] = last_block;
    local_[v] = counts[last_block]++;
  }
  first_vertex_.assign(boxes_.size() + 1, 0);
  for (std::size_t b = 0; b < boxes_.size(); ++b) first_vertex_[b + 1] = first_vertex_[b] + counts[b];
  vertices_.resize(mesh.at.size());
  for (std::uint32_t v = 0; v < mesh.at.size(); ++v) vertices_[first_vertex_[block_of_[v]] + local_[v]] = v;

  first_triangle_.assign(boxes_.size() + 1, 0);
  const auto is_between = [&](const Triangle& t) {
    return block_of_[t[0]] != block_of_[t[1]] || block_of_[t[0]] != block_of_[t[2]];
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_between(mesh.triangles[t])) {
      between_.push_back(t);
    } else {
      ++first_triangle_[block_of_[mesh.triangles[t][0]] + 1];
    }
  }
  for (std::size_t b = 0; b < boxes_.size(); ++b) first_triangle_[b + 1] += first_triangle_[b];
  triangles_.resize(first_triangle_.back());
  std::vector<std::uint32_t> fill(first_triangle_.begin(), first_triangle_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_between(mesh.triangles[t])) triangles_[fill[block_of_[mesh.triangles[t][0]]]++] = t;
  }

  std::vector<std::array<std::uint32_t, 2>> reaching;
  for (const std::uint32_t t : between_) {
    Cube lo, hi;
    const Triangle& v = mesh.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const auto [least, most] = std::minmax({mesh.at[v[0]][k], mesh.at[v[1]][k], mesh.at[v[2]][k]});
      lo[k] = planes[k].cube_of(least);
      hi[k] = planes[k].cube_of(most);
    }
    for (Cube c = lo; c[0] <= hi[0]; ++c[0]) {
      for (c[1] = lo[1]; c[1] <= hi[1]; ++c[1]) {
        for (c[2] = lo[2]; c[2] <= hi[2]; ++c[2]) {
          const auto it = blocks.find(c);
          if (it != blocks.end()) reaching.push_back({it->second, t});
        }
      }
    }
  }
  fill_lists(reaching, boxes_.size(), first_fixed_, fixed_);
  stored_.resize(boxes_.size());
}

BlockMesh MeshBlocks::extract(std::size_t block) const {
  const std::uint32_t* own = vertices_.data() + first_vertex_[block];
  const std::size_t own_count = first_vertex_[block + 1] - first_vertex_[block];
  std::vector<std::uint32_t> outside;
  for (std::uint32_t i = first_fixed_[block]; i < first_fixed_[block + 1]; ++i) {
    for (const std::uint32_t v : mesh_.triangles[fixed_[i]]) {
      if (block_of_[v] != block) outside.push_back(v);
    }
  }
  sort_and_unite(outside);

  std::vector<Triangle> triangles;
  triangles.reserve(first_triangle_[block + 1] - first_triangle_[block]);
  for (std::uint32_t i = first_triangle_[block]; i < first_triangle_[block + 1]; ++i) {
    const Triangle& t = mesh_.triangles[triangles_[i]];
    triangles.push_back({local_[t[0]], local_[t[1]], local_[t[2]]});
  }
  const std::size_t count = own_count + outside.size();
  BlockMesh result{{}, HalfEdgeMesh(std::move(triangles), count), {}, {}, {}, boxes_[block]};
  result.reserve(count + count / 4);
  for (std::size_t i = 0; i < own_count; ++i) result.append(mesh_, own[i]);
  for (const std::uint32_t v : outside) result.append(mesh_, v);
  result.is_active.assign(count, 1);
  result.is_guarded.assign(count, 0);
  for (std::uint32_t i = first_fixed_[block]; i < first_fixed_[block + 1]; ++i) {
    Triangle t = mesh_.triangles[fixed_[i]];
    for (std::uint32_t& v : t) {
      if (block_of_[v] == block) {
        v = local_[v];
      } else {
        const auto it = std::lower_bound(outside.begin(), outside.end(), v);
        v = static_cast<std::uint32_t>(own_count + static_cast<std::size_t>(it - outside.begin()));
      }
    }
    result.fixed.push_back(t);
  }
  return result;
}

bool MeshBlocks::is_settled(std::size_t block) const {
  return std::all_of(vertices_.begin() + first_vertex_[block], vertices_.begin() + first_vertex_[block + 1],
                     [&](std::uint32_t v) { return mesh_.is_settled[v] != 0; });
}

void MeshBlocks::keep(std::size_t block) {
  Stored& stored = stored_[block];
  const std::size_t count = first_vertex_[block + 1] - first_vertex_[block];
  stored.number.resize(count);
  std::iota(stored.number.begin(), stored.number.end(), 0u);
  stored.part.reserve(count);
  for (std::uint32_t i = first_vertex_[block]; i < first_vertex_[block + 1]; ++i) {
    stored.part.append(mesh_, vertices_[i]);
  }
  stored.part.triangles.reserve(first_triangle_[block + 1] - first_triangle_[block]);
  for (std::uint32_t i = first_triangle_[block]; i < first_triangle_[block + 1]; ++i) {
    const Triangle& t = mesh_.triangles[triangles_[i]];
    stored.part.triangles.push_back({local_[t[0]], local_[t[1]], local_[t[2]]});
  }
}

void MeshBlocks::store(std::size_t block, BlockMesh&& worked) {
  const std::uint32_t own = first_vertex_[block + 1] - first_vertex_[block];
  const HalfEdgeMesh& c = worked.connectivity;
  // Vertices that no triangle of the block has may have one between the blocks; only those that had one are gone.
  std::vector<std::uint8_t> is_used(own, 0);
  for (std::uint32_t i = first_triangle_[block]; i < first_triangle_[block + 1]; ++i) {
    for (const std::uint32_t v : mesh_.triangles[triangles_[i]]) is_used[local_[v]] = 1;
  }
  // Many parts are kept at a time, so none has more room than it needs.
  std::vector<std::uint32_t> number(worked.at.size(), HalfEdgeMesh::kNone);
  std::uint32_t vertices = 0;
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (c.has_vertex(v) || (v < own && !is_used[v])) number[v] = vertices++;
  }
  WholeMesh part;
  part.reserve(vertices);
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == HalfEdgeMesh::kNone) continue;
    part.append(worked, v);
  }
  std::size_t triangles = 0;
  for (std::uint32_t t = 0; t < c.triangles(); ++t) triangles += c.has_triangle(t);
  part.triangles.reserve(triangles);
  for (std::uint32_t t = 0; t < c.triangles(); ++t) {
    if (!c.has_triangle(t)) continue;
    const Triangle v = c.triangle(t);
    part.triangles.push_back({number[v[0]], number[v[1]], number[v[2]]});
  }
  stored_[block].number.assign(number.begin(), number.begin() + own);
  stored_[block].part = std::move(part);
}

WholeMesh MeshBlocks::join(int threads) && {
  std::vector<std::uint32_t> first_vertex(size() + 1, 0), first_triangle(size() + 1, 0);
  for (std::size_t b = 0; b < size(); ++b) {
    first_vertex[b + 1] = first_vertex[b] + static_cast<std::uint32_t>(stored_[b].part.at.size());
    first_triangle[b + 1] = first_triangle[b] + static_cast<std::uint32_t>(stored_[b].part.triangles.size());
  }
  std::vector<Triangle> between;
  between.reserve(between_.size());
  for (const std::uint32_t t : between_) {
    Triangle joined = mesh_.triangles[t];
    for (std::uint32_t& v : joined) v = first_vertex[block_of_[v]] + stored_[block_of_[v]].number[local_[v]];
    between.push_back(joined);
  }
  mesh_ = {};
  for (auto* list : {&block_of_, &local_, &vertices_, &triangles_, &fixed_}) *list = std::vector<std::uint32_t>();

  WholeMesh result;
  result.resize(first_vertex.back());
  result.triangles.resize(first_triangle.back() + between.size());
  parallel_for(size(), threads, [&](std::size_t b) {
    WholeMesh& part = stored_[b].part;
    result.replace(first_vertex[b], part);
    std::uint32_t at = first_triangle[b];
    for (const Triangle& t : part.triangles) {
      result.triangles[at++] = {t[0] + first_vertex[b], t[1] + first_vertex[b], t[2] + first_vertex[b]};
    }
    part = {};
  });
  std::copy(between.begin(), between.end(), result.triangles.begin() + first_triangle.back());
  return result;
}

}  // namespace gaussmesh

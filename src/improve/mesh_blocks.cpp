#include "improve/mesh_blocks.h"

#include <numeric>

#include "core/parallel.h"
#include "core/sort_and_unite.h"

namespace gaussmesh {
namespace {

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
    : mesh_(std::move(whole)), block_of_(mesh_.at.size()) {
  BoxGrid grid(edge, shift);
  BoxGrid::Cube last{};
  for (std::uint32_t v = 0; v < mesh_.at.size(); ++v) {
    const BoxGrid::Cube cube = grid.cube_of(mesh_.at[v]);
    if (v > 0 && cube == last) {
      block_of_[v] = block_of_[v - 1];
      continue;
    }
    last = cube;
    std::vector<std::uint32_t>& blocks = grid.numbers_in(cube);
    if (blocks.empty()) {
      blocks.push_back(static_cast<std::uint32_t>(boxes_.size()));
      boxes_.push_back(grid.box_of(cube));
    }
    block_of_[v] = blocks[0];
  }
  list_members();
  list_reaching(grid);
}

MeshBlocks::MeshBlocks(WholeMesh whole, std::vector<Box> boxes, double most)
    : mesh_(std::move(whole)), boxes_(std::move(boxes)), block_of_(mesh_.at.size()) {
  BoxGrid grid(most);
  for (std::uint32_t b = 0; b < boxes_.size(); ++b) grid.add(boxes_[b], b);
  for (std::uint32_t v = 0; v < mesh_.at.size(); ++v) {
    block_of_[v] = static_cast<std::uint32_t>(boxes_.size());
    grid.visit({mesh_.at[v], mesh_.at[v]}, [&](std::uint32_t b) {
      if (is_in(boxes_[b], mesh_.at[v])) block_of_[v] = b;
    });
  }
  list_members();
  list_reaching(grid);
}

void MeshBlocks::list_members() {
  const std::size_t slots = boxes_.size() + 1;
  first_vertex_.assign(slots + 1, 0);
  for (const std::uint32_t b : block_of_) ++first_vertex_[b + 1];
  for (std::size_t b = 0; b < slots; ++b) first_vertex_[b + 1] += first_vertex_[b];
  local_.resize(block_of_.size());
  vertices_.resize(block_of_.size());
  std::vector<std::uint32_t> fill(first_vertex_.begin(), first_vertex_.end() - 1);
  for (std::uint32_t v = 0; v < block_of_.size(); ++v) {
    const std::uint32_t b = block_of_[v], at = fill[b]++;
    local_[v] = at - first_vertex_[b];
    vertices_[at] = v;
  }
  const auto is_between = [&](const Triangle& t) {
    return block_of_[t[0]] != block_of_[t[1]] || block_of_[t[0]] != block_of_[t[2]];
  };
  first_triangle_.assign(slots + 1, 0);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    if (is_between(mesh_.triangles[t])) {
      between_.push_back(t);
    } else {
      ++first_triangle_[block_of_[mesh_.triangles[t][0]] + 1];
    }
  }
  for (std::size_t b = 0; b < slots; ++b) first_triangle_[b + 1] += first_triangle_[b];
  triangles_.resize(first_triangle_.back());
  fill.assign(first_triangle_.begin(), first_triangle_.end() - 1);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    if (!is_between(mesh_.triangles[t])) triangles_[fill[block_of_[mesh_.triangles[t][0]]]++] = t;
  }
  stored_.resize(boxes_.size());
}

/// Lists the triangles of no block that reach into its box.
void MeshBlocks::list_reaching(BoxGrid& grid) {
  std::vector<std::array<std::uint32_t, 2>> reaching;
  const auto list = [&](std::uint32_t t) {
    Box box;
    const Triangle& v = mesh_.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const auto [least, most] = std::minmax({mesh_.at[v[0]][k], mesh_.at[v[1]][k], mesh_.at[v[2]][k]});
      box.lo[k] = least;
      box.hi[k] = most;
    }
    const std::size_t first = reaching.size();
    grid.visit(box, [&](std::uint32_t b) {
      const auto is_listed = [&](const auto& pair) { return pair[0] == b; };
      const auto begin = reaching.begin() + static_cast<std::ptrdiff_t>(first);
      if (boxes_meet(box, boxes_[b]) && std::none_of(begin, reaching.end(), is_listed)) reaching.push_back({b, t});
    });
  };
  for (const std::uint32_t t : between_) list(t);
  const std::size_t rest = boxes_.size();
  for (std::uint32_t i = first_triangle_[rest]; i < first_triangle_[rest + 1]; ++i) list(triangles_[i]);
  fill_lists(reaching, boxes_.size(), first_fixed_, fixed_);
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
  const std::size_t rest = boxes_.size();
  const std::uint32_t rest_vertices = first_vertex_[rest + 1] - first_vertex_[rest];
  std::vector<std::uint32_t> first_vertex(1, rest_vertices);
  for (const Stored& block : stored_) {
    first_vertex.push_back(first_vertex.back() + static_cast<std::uint32_t>(block.part.at.size()));
  }
  // The rest and the triangles between stay in the arrays that they are in, so that the room is not needed twice.
  std::uint32_t kept = 0;
  for (const Triangle& t : mesh_.triangles) {
    if (block_of_[t[0]] != rest && block_of_[t[0]] == block_of_[t[1]] && block_of_[t[0]] == block_of_[t[2]]) continue;
    Triangle renumbered = t;
    for (std::uint32_t& v : renumbered) {
      const std::uint32_t block = block_of_[v];
      v = block == rest ? local_[v] : first_vertex[block] + stored_[block].number[local_[v]];
    }
    mesh_.triangles[kept++] = renumbered;
  }
  std::vector<std::uint32_t> first_triangle(1, kept);
  for (const Stored& block : stored_) {
    first_triangle.push_back(first_triangle.back() + static_cast<std::uint32_t>(block.part.triangles.size()));
  }
  for (std::uint32_t i = 0; i < rest_vertices; ++i) mesh_.move(vertices_[first_vertex_[rest] + i], i);
  for (auto* list : {&block_of_, &local_, &vertices_, &triangles_, &fixed_}) *list = std::vector<std::uint32_t>();
  mesh_.resize_beyond(rest_vertices, first_vertex.back());
  resize_beyond(mesh_.triangles, kept, first_triangle.back());
  parallel_for(stored_.size(), threads, [&](std::size_t b) {
    WholeMesh& part = stored_[b].part;
    mesh_.replace(first_vertex[b], part);
    std::uint32_t at = first_triangle[b];
    for (const Triangle& t : part.triangles) {
      mesh_.triangles[at++] = {t[0] + first_vertex[b], t[1] + first_vertex[b], t[2] + first_vertex[b]};
    }
    part = {};
  });
  return std::move(mesh_);
}

}  // namespace gaussmesh

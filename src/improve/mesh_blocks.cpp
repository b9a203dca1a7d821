#include "improve/mesh_blocks.h"

#include <numeric>
#include <utility>

#include "core/parallel.h"
#include "core/sort_and_unite.h"

namespace gaussmesh {
namespace {

/// Members that a thread looks at in one go.
constexpr std::size_t kMembersAtOnce = 65536;

/// No block's.
constexpr std::uint32_t kNowhere = HalfEdgeMesh::kNone;

/// Lists the numbers 0 .. count - 1 by block, in rising order. @param block_of  kNowhere: in no list
template <typename BlockOf>
void list_by_block(std::size_t count, std::size_t blocks, int threads, const BlockOf& block_of,
                   std::vector<std::uint32_t>& first, std::vector<std::uint32_t>& members) {
  // How many each part has for each block, and then where they begin in the lists.
  std::vector<std::vector<std::uint32_t>> at(count / kMembersAtOnce + 1);
  parallel_for_chunks(count, kMembersAtOnce, threads, [&](std::size_t chunk, std::size_t from, std::size_t to) {
    at[chunk].assign(blocks, 0);
    for (std::size_t i = from; i < to; ++i) {
      const std::uint32_t block = block_of(i);
      if (block != kNowhere) ++at[chunk][block];
    }
  });
  first.assign(blocks + 1, 0);
  for (std::size_t b = 0; b < blocks; ++b) {
    first[b + 1] = first[b];
    for (auto& part : at) {
      if (!part.empty()) first[b + 1] += std::exchange(part[b], first[b + 1]);
    }
  }
  members.resize(first[blocks]);
  parallel_for_chunks(count, kMembersAtOnce, threads, [&](std::size_t chunk, std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const std::uint32_t block = block_of(i);
      if (block != kNowhere) members[at[chunk][block]++] = static_cast<std::uint32_t>(i);
    }
  });
}

Box box_of(const WholeMesh& mesh, const Triangle& v) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    const auto [least, most] = std::minmax({mesh.at[v[0]][k], mesh.at[v[1]][k], mesh.at[v[2]][k]});
    box.lo[k] = least;
    box.hi[k] = most;
  }
  return box;
}

/// The largest extent of any triangle along any axis.
double longest_extent(const WholeMesh& mesh, int threads) {
  const auto longest = parallel_gather<double>(mesh.triangles.size(), kMembersAtOnce, threads,
                                               [&](std::size_t first, std::size_t last, std::vector<double>& list) {
                                                 double most = 0.0;
                                                 for (std::size_t t = first; t < last; ++t) {
                                                   const Box box = box_of(mesh, mesh.triangles[t]);
                                                   for (int k = 0; k < 3; ++k)
                                                     most = std::max(most, box.hi[k] - box.lo[k]);
                                                 }
                                                 list.push_back(most);
                                               });
  return longest.empty() ? 0.0 : *std::max_element(longest.begin(), longest.end());
}

}  // namespace

MeshBlocks::MeshBlocks(WholeMesh whole, double edge, const Vec3& shift, int threads)
    : mesh_(std::move(whole)), block_of_(mesh_.at.size()) {
  BoxGrid grid(edge, shift);
  struct Run {
    BoxGrid::Cube cube;
    std::uint32_t first;  ///< of vertices that follow each other in a cube
  };
  const auto runs = parallel_gather<Run>(mesh_.at.size(), kMembersAtOnce, threads,
                                         [&](std::size_t first, std::size_t last, std::vector<Run>& list) {
                                           for (std::size_t v = first; v < last; ++v) {
                                             const BoxGrid::Cube cube = grid.cube_of(mesh_.at[v]);
                                             if (list.empty() || list.back().cube != cube)
                                               list.push_back({cube, static_cast<std::uint32_t>(v)});
                                           }
                                         });
  for (std::size_t r = 0; r < runs.size(); ++r) {
    std::vector<std::uint32_t>& blocks = grid.numbers_in(runs[r].cube);
    if (blocks.empty()) {
      blocks.push_back(static_cast<std::uint32_t>(boxes_.size()));
      boxes_.push_back(grid.box_of(runs[r].cube));
    }
    const auto end = r + 1 < runs.size() ? block_of_.begin() + runs[r + 1].first : block_of_.end();
    std::fill(block_of_.begin() + runs[r].first, end, blocks[0]);
  }
  list_members(threads);
  list_reaching(grid, between_, threads);
}

MeshBlocks::MeshBlocks(WholeMesh whole, std::vector<Box> boxes, int threads)
    : mesh_(std::move(whole)), boxes_(std::move(boxes)), block_of_(mesh_.at.size()) {
  // A triangle that reaches into a box has its corners within its own extent of it.
  const double extent = longest_extent(mesh_, threads);
  double widest = extent;
  for (const Box& box : boxes_) widest = std::max(widest, box.hi[0] - box.lo[0]);
  BoxGrid near(widest);
  for (std::uint32_t b = 0; b < boxes_.size(); ++b) near.add(widened(boxes_[b], extent), b);
  std::vector<std::uint8_t> is_near(mesh_.at.size(), 0);
  parallel_for_chunks(mesh_.at.size(), kMembersAtOnce, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    BoxGrid::Reader grid(near);
    for (std::size_t v = first; v < last; ++v) {
      const Vec3& p = mesh_.at[v];
      block_of_[v] = kNowhere;
      grid.visit({p, p}, [&](std::uint32_t b) {
        is_near[v] = 1;
        if (is_in(boxes_[b], p)) block_of_[v] = b;
      });
    }
  });
  list_members(threads);
  const auto others =
      parallel_gather<std::uint32_t>(between_.size(), kMembersAtOnce, threads,
                                     [&](std::size_t first, std::size_t last, std::vector<std::uint32_t>& list) {
                                       for (std::size_t i = first; i < last; ++i) {
                                         if (is_near[mesh_.triangles[between_[i]][0]]) list.push_back(between_[i]);
                                       }
                                     });
  list_reaching(near, others, threads);
}

/// Whether all corners are in one block.
bool MeshBlocks::is_in_block(const Triangle& t) const {
  const std::uint32_t b = block_of_[t[0]];
  return b != kNowhere && b == block_of_[t[1]] && b == block_of_[t[2]];
}

void MeshBlocks::list_members(int threads) {
  list_by_block(
      block_of_.size(), boxes_.size(), threads, [&](std::size_t v) { return block_of_[v]; }, first_vertex_, vertices_);
  local_.resize(block_of_.size());
  parallel_for(boxes_.size(), threads, [&](std::size_t b) {
    for (std::uint32_t i = first_vertex_[b]; i < first_vertex_[b + 1]; ++i) local_[vertices_[i]] = i - first_vertex_[b];
  });
  list_by_block(
      mesh_.triangles.size(), boxes_.size(), threads,
      [&](std::size_t t) {
        const Triangle& triangle = mesh_.triangles[t];
        return is_in_block(triangle) ? block_of_[triangle[0]] : kNowhere;
      },
      first_triangle_, triangles_);
  between_ = parallel_gather<std::uint32_t>(mesh_.triangles.size(), kMembersAtOnce, threads,
                                            [&](std::size_t first, std::size_t last, std::vector<std::uint32_t>& list) {
                                              for (std::size_t t = first; t < last; ++t) {
                                                if (!is_in_block(mesh_.triangles[t]))
                                                  list.push_back(static_cast<std::uint32_t>(t));
                                              }
                                            });
  stored_.resize(boxes_.size());
}

/// Lists the ones of some triangles that reach into each box.
void MeshBlocks::list_reaching(const BoxGrid& grid, std::span<const std::uint32_t> triangles, int threads) {
  using Pair = std::array<std::uint32_t, 2>;  // box, triangle
  const auto reaching = parallel_gather<Pair>(
      triangles.size(), kMembersAtOnce, threads, [&](std::size_t first, std::size_t last, std::vector<Pair>& list) {
        BoxGrid::Reader reader(grid);
        for (const std::uint32_t t : triangles.subspan(first, last - first)) {
          const Box box = box_of(mesh_, mesh_.triangles[t]);
          const auto own = static_cast<std::ptrdiff_t>(list.size());
          reader.visit(box, [&](std::uint32_t b) {
            const auto is_listed = [&](const Pair& pair) { return pair[0] == b; };
            if (boxes_meet(box, boxes_[b]) && std::none_of(list.begin() + own, list.end(), is_listed)) {
              list.push_back({b, t});
            }
          });
        }
      });
  first_fixed_.assign(boxes_.size() + 1, 0);
  for (const auto& pair : reaching) ++first_fixed_[pair[0] + 1];
  for (std::size_t b = 0; b < boxes_.size(); ++b) first_fixed_[b + 1] += first_fixed_[b];
  fixed_.resize(reaching.size());
  std::vector<std::uint32_t> fill(first_fixed_.begin(), first_fixed_.end() - 1);
  for (const auto& [b, t] : reaching) fixed_[fill[b]++] = t;
}

std::vector<std::uint32_t> MeshBlocks::largest_first() const {
  std::vector<std::uint32_t> blocks(boxes_.size());
  std::iota(blocks.begin(), blocks.end(), 0u);
  std::stable_sort(blocks.begin(), blocks.end(), [&](std::uint32_t a, std::uint32_t b) {
    return first_triangle_[a + 1] - first_triangle_[a] > first_triangle_[b + 1] - first_triangle_[b];
  });
  return blocks;
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
  BlockMesh result{{}, HalfEdgeMesh(triangles, count), {}, {}, {}, boxes_[block]};
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
  // What is in no block stays in the arrays that it is in, so that the room is not needed twice.
  std::uint32_t rest_vertices = 0;
  for (std::uint32_t v = 0; v < block_of_.size(); ++v) {
    if (block_of_[v] != kNowhere) continue;
    mesh_.move(v, rest_vertices);
    local_[v] = rest_vertices++;
  }
  std::vector<std::uint32_t> first_vertex(1, rest_vertices);
  const auto kept = static_cast<std::uint32_t>(between_.size());
  std::vector<std::uint32_t> first_triangle(1, kept);
  for (const Stored& block : stored_) {
    first_vertex.push_back(first_vertex.back() + static_cast<std::uint32_t>(block.part.at.size()));
    first_triangle.push_back(first_triangle.back() + static_cast<std::uint32_t>(block.part.triangles.size()));
  }
  parallel_for_chunks(kept, kMembersAtOnce, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      for (std::uint32_t& v : mesh_.triangles[between_[i]]) {
        const std::uint32_t block = block_of_[v];
        v = block == kNowhere ? local_[v] : first_vertex[block] + stored_[block].number[local_[v]];
      }
    }
  });
  for (std::uint32_t i = 0; i < kept; ++i) mesh_.triangles[i] = mesh_.triangles[between_[i]];
  for (auto* list : {&block_of_, &local_, &vertices_, &triangles_, &fixed_, &between_}) {
    *list = std::vector<std::uint32_t>();
  }
  mesh_.resize_beyond(rest_vertices, first_vertex.back(), threads);
  resize_beyond(mesh_.triangles, kept, first_triangle.back(), threads);
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

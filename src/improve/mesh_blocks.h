// Cutting a mesh into blocks of space that can be worked on side by side, and putting them together again.
#pragma once

#include <span>
#include <vector>

#include "improve/block_mesh.h"
#include "improve/box_grid.h"

namespace gaussmesh {

/// The whole mesh between two sweeps.
struct WholeMesh : MeshVertices {
  std::vector<Triangle> triangles;
};

/// The mesh, cut into convex blocks that have no point in common.
///
/// A triangle belongs to the block in which all its corners lie; others belong to none and stay as they are. Blocks
/// are convex and keep their vertices, so triangles of two blocks can never meet, whatever is done within each: blocks
/// may be worked on in any order, and on several threads, with the same result.
class MeshBlocks {
 public:
  /// Cut by the planes of a cubic grid: blocks are the cubes with vertices, in the order of their first ones.
  /// @param edge   A, of the cubes: many times that of the triangles
  /// @param shift  a point where planes meet
  /// Cost: O(n). Memory: 9 bytes a triangle beside the mesh.
  MeshBlocks(WholeMesh mesh, double edge, const Vec3& shift, int threads);

  /// The blocks are given: what is outside of all stays as it is.
  /// @param boxes  without common points
  MeshBlocks(WholeMesh mesh, std::vector<Box> boxes, int threads);

  std::size_t size() const { return boxes_.size(); }

  /// All blocks, those with most triangles first: in this order threads end their work at nearly the same time.
  std::vector<std::uint32_t> largest_first() const;

  /// One block to work on. Thread-safe.
  BlockMesh extract(std::size_t block) const;

  /// Keeps what became of a block. Thread-safe for different blocks.
  void store(std::size_t block, BlockMesh&& worked);

  /// The mesh of what is in no block and of all stored blocks, one after the other. All blocks have been stored. What
  /// was cut up is given back first: there are never more than two whole meshes.
  WholeMesh join(int threads) &&;

 private:
  struct Stored {
    std::vector<std::uint32_t> number;  ///< of the block's vertices, those of before first, in what is kept
    WholeMesh part;
  };
  bool is_in_block(const Triangle& t) const;
  void list_members(int threads);
  void list_reaching(const BoxGrid& grid, std::span<const std::uint32_t> triangles, int threads);

  WholeMesh mesh_;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> block_of_, local_;            ///< by vertex
  std::vector<std::uint32_t> first_vertex_, vertices_;     ///< by block
  std::vector<std::uint32_t> first_triangle_, triangles_;  ///< by block
  std::vector<std::uint32_t> first_fixed_, fixed_;         ///< by block: triangles that reach into its box
  std::vector<std::uint32_t> between_;                     ///< triangles of no block
  std::vector<Stored> stored_;
};

}  // namespace gaussmesh

// The smaller cells: where a cell of the asked-for spacing has no certificate, it is split in eight, and so on.
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "patch/fold_triangulator.h"
#include "pipeline/cell_store.h"

namespace gaussmesh {

/// A cell that got no certificate at the depth limit: the level is (nearly) singular there.
struct UncertifiedPlace {
  Vec3 place{};
  double size = 0.0;
};

using CellSet = std::unordered_set<CellKey, CellKeyHash>;

/// Cells of any size that keep their size without a certificate, and what is cut along folds in them.
using FoldCellMap = std::unordered_map<CellKey, FoldCell, CellKeyHash>;

/// A smaller cell with its certificate.
struct LeafCell {
  CellKey key;
  int axis = 0;
  int sign = 0;      ///< 0: cut along folds
};

/// Cells below level 0, the roots on their edges and the curves on their faces.
///
/// An edge is known by the longest lattice edge of its line: its roots are found once, on that one, and shared by all
/// cells that see a part of it. A face between cells of different size is that of the smaller ones.
class SplitLattice {
 public:
  /// Splits every cell that has no certificate and is not in `folds`, and the cells of `forced`; marks them, and the
  /// faces that smaller cells take over or that need fold points, in `store`.
  SplitLattice(const GaussianField& field, const Lattice& lattice, CellStore& store, const FoldCellMap& folds,
               const CellSet& forced, int threads);

  const std::vector<LeafCell>& leaves() const { return leaves_; }
  std::size_t split_cells() const { return split_.size(); }
  const std::vector<UncertifiedPlace>& uncertified() const { return uncertified_; }
  bool is_split(const CellKey& key) const { return split_.contains(key); }

  /// Number of the first vertex that is neither a root of level 0 nor of these cells.
  std::uint32_t next_vertex() const { return first_vertex() + static_cast<std::uint32_t>(points_.size()); }

  /// All vertices below next_vertex().
  std::vector<SurfacePoint> lattice_points() const;

  /// Finds the curves on the faces of the leaves. Vertices are numbered from `first_vertex` on.
  void trace_faces(int threads);

  bool is_divided(int axis, const FineIndex& lo, int level) const;
  std::span<const Link> face_links(int axis, const FineIndex& lo, int level) const;

 private:
  std::uint32_t first_vertex() const { return store_.root_vertices(); }

  struct LatticeKey {   ///< of an edge along `axis`, or of a face across it
    FineIndex lo{};
    int axis = 0;
    int level = 0;
    auto operator<=>(const LatticeKey&) const = default;
  };
  struct Branch {
    std::vector<LeafCell> leaves;
    std::vector<CellKey> split;
    std::vector<UncertifiedPlace> uncertified;
  };

  void split(const CellKey& key, const NearAtoms& around, const CellSet& forced, CellProver& prover,
             Branch& branch) const;
  void mark_level_zero(const std::vector<CellKey>& roots);
  unsigned fold_axes(const LatticeKey& face) const;
  void find_edge_roots(int threads);
  LatticeKey whole_edge(int axis, const FineIndex& lo) const;
  std::vector<VertexRoot> roots_on(int axis, const FineIndex& lo, int level) const;
  std::vector<FaceRoot> face_roots(const LatticeKey& face) const;

  const GaussianField& field_;
  const Lattice& lattice_;
  CellStore& store_;
  const FoldCellMap& folds_;
  CellSet split_;
  std::vector<LeafCell> leaves_;
  std::vector<UncertifiedPlace> uncertified_;
  std::vector<LatticeKey> edges_;                ///< sorted
  std::vector<std::vector<VertexRoot>> edge_roots_;
  std::vector<LatticeKey> faces_;                ///< sorted
  std::vector<std::vector<Link>> face_links_;
  std::vector<SurfacePoint> points_;             ///< vertices that smaller cells add
};

}  // namespace gaussmesh

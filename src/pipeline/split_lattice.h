// The smaller cells: where a cell of the asked-for spacing has no certificate, it is split in eight, and so on.
#pragma once

#include <unordered_map>
#include <vector>

#include "boxes/cell_prover.h"
#include "core/key_index.h"
#include "field/local_atoms.h"
#include "patch/fold_triangulator.h"
#include "pipeline/traced_vertices.h"

namespace gaussmesh {

/// A cell that got no certificate at the depth limit: the level is (nearly) singular there.
struct UncertifiedPlace {
  Vec3 place{};
  double size = 0.0;  ///< A
};

/// Cells of any size that keep their size without a certificate, and what is cut along folds in them.
using FoldCellMap = std::unordered_map<CellKey, FoldCell, CellKeyHash>;

/// Marks in the store which fold points the curves on faces of level 0 need.
void mark_folds(const FoldCellMap& folds, CellStore& store);

/// Down to this level cells are not smaller than the parts that proofs look at in cells of level 0, and their edges
/// and faces take as many atoms; in smaller ones, near singular places, atoms left out may decide.
inline constexpr int kLastPlainLevel = 3;

/// The atoms that proofs in a cell of some level take.
inline Reach proof_reach(int level) { return level <= kLastPlainLevel ? Reach::kProof : Reach::kFine; }

/// A smaller cell with its certificate.
struct LeafCell {
  CellKey key;
  Direction direction;           ///< none: cut along folds
  std::uint8_t single_axes = 0;  ///< as in CellCertificate
  bool is_inherited = false;     ///< the certificate is that of the cell that was split
  std::uint8_t empty_faces = 0;  ///< bit 2 k + s: no surface in the face across axis k on the low (s = 0) or high side

  LeafCell(const CellKey& of_key, const Direction& of_direction, unsigned of_single_axes, bool inherited = false)
      : key(of_key),
        direction(of_direction),
        single_axes(static_cast<std::uint8_t>(of_single_axes)),
        is_inherited(inherited) {}
};

/// A cell that was split, and the smaller cells that are left of it.
struct SplitCell {
  CellKey key;
  std::vector<LeafCell> leaves;  ///< without those that were split in their turn, later
};

/// Cells below level 0, the roots on their edges and the curves on their faces.
///
/// An edge is known by the longest lattice edge of its line: its roots are found once, on that one, and shared by
/// all cells that see a part of it. A face between cells of different size is that of the smaller ones. Cells are
/// split in rounds: what was found in one is kept in the next, with the numbers of its vertices.
class SplitLattice {
 public:
  /// No cell is split at first. Vertices are added to `vertices`.
  SplitLattice(const GaussianField& field, const Lattice& lattice, const CellStore& store, const FoldCellMap& folds,
               TracedVertices& vertices);

  /// Splits cells that are of level 0 or leaves, each as often as it needs; cells in `folds` keep their size. Finds
  /// the roots and curves of the new leaves, unless there are uncertified places.
  void split(std::span<const CellKey> cells, int threads);

  /// Marks in the store which cells of level 0 the last call of split() split, and their faces, which smaller cells
  /// have taken over with the curves in them.
  void mark_cells(CellStore& store) const;

  /// Cells of level 0 that the last call of split() split, and unsplit ones whose faces it changed, in rising order.
  std::vector<CellStore::Place> changed_places() const;

  /// Entries of cells() whose leaves, or the curves round them, the last call of split() changed, in rising order;
  /// new ones among them.
  const std::vector<std::uint32_t>& changed_cells() const { return changed_cells_; }

  const std::vector<SplitCell>& cells() const { return cells_; }
  std::size_t split_cells() const { return split_.size(); }
  const std::vector<UncertifiedPlace>& uncertified() const { return uncertified_; }
  bool is_split(const CellKey& key) const { return split_.contains(key); }

  /// The curves on a face whose cells are both unsplit.
  std::span<const Link> face_links(int axis, const FineIndex& lo, int level) const;

 private:
  /// Of an edge along `axis`, or of a face across it. Small: with default settings there are as many as triangles.
  struct LatticeKey {
    std::array<std::int32_t, 3> cell{};   ///< of level 0 that has the lowest corner: see kMostCellNumber
    std::array<std::uint16_t, 3> part{};  ///< the corner in it, in fine planes
    static_assert(kMaxLevel <= 16);
    std::int8_t axis = 0;
    std::int8_t level = 0;

    LatticeKey(const FineIndex& lo, int of_axis, int of_level)
        : axis(static_cast<std::int8_t>(of_axis)), level(static_cast<std::int8_t>(of_level)) {
      for (int k = 0; k < 3; ++k) {
        cell[k] = static_cast<std::int32_t>(lo[k] >> kMaxLevel);
        part[k] = static_cast<std::uint16_t>(lo[k] & (kFinePerCell - 1));
      }
    }
    FineIndex lo() const {
      FineIndex result;
      for (int k = 0; k < 3; ++k) result[k] = std::int64_t{cell[k]} * kFinePerCell + part[k];
      return result;
    }
    bool operator==(const LatticeKey& other) const {
      return cell[0] == other.cell[0] && cell[1] == other.cell[1] && cell[2] == other.cell[2] &&
             part[0] == other.part[0] && part[1] == other.part[1] && part[2] == other.part[2] && axis == other.axis &&
             level == other.level;
    }
  };
  struct LatticeKeyHash {
    std::size_t operator()(const LatticeKey& key) const {
      return lattice_hash<3>(key.lo(), key.level, static_cast<unsigned>(key.axis));
    }
  };
  struct Branch {
    std::vector<LeafCell> leaves;
    std::vector<CellKey> split;
    std::vector<UncertifiedPlace> uncertified;
  };
  struct FaceLinks {
    std::uint32_t first_link = 0;
    std::uint32_t link_count = 0;
    VertexRange vertices;  ///< inside the face
  };
  struct FoldMark {
    bool is_fold_cell = false;  ///< and not one round such a cell
    unsigned axes = 0;          ///< along which its components are cut
  };
  /// What is at hand of a split cell while its edges and faces are looked at.
  struct CellWork {
    explicit CellWork(const GaussianField& field) : atoms(field), prover(field.decay()) {}
    LocalAtoms atoms;
    CellProver prover;
    std::vector<LocalModel> models;         ///< of its leaves
    std::vector<std::uint16_t> free_edges;  ///< of its leaves: bit 4 axis + corner: no surface on the edge
  };
  /// Edges or faces with numbers first .. last - 1, that a leaf of a split cell was the first to ask for.
  struct Task {
    std::uint32_t leaf = 0;
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };

  using LatticeKeys = KeyIndex<LatticeKey, LatticeKeyHash>;
  /// Edges or faces that leaves ask for, each once and in the order in which they are asked for.
  struct Wanted {
    LatticeKeys keys;
    std::vector<std::uint8_t> known;       ///< by number: all that the leaves know of it, in bits
    std::vector<std::vector<Task>> tasks;  ///< by cell
  };

  /// @param found  those that are not wanted any more
  /// @param visit  called with the numbers of cell and leaf, the leaf, and ask(key, known), on several threads
  template <typename Visit>
  static Wanted list_wanted(std::span<const SplitCell> cells, const LatticeKeys& found, int threads,
                            const Visit& visit);
  LeafCell find_cell(const CellKey& key) const;
  static void split_certified(const LeafCell& cell, Branch& branch);
  void split_one(const CellKey& key, LocalAtoms& around, CellProver& prover, Branch& branch) const;
  void take_from_leaves(const CellKey& key);
  void drop_faces(const CellKey& key);
  std::optional<std::uint32_t> find_split_around(const CellKey& key) const;
  void mark_changed_beside(const CellKey& key);
  static std::array<CellKey, 6> cells_beside(const CellKey& key);
  bool is_fold_cell(const CellKey& key) const;
  unsigned fold_axes(const LatticeKey& face) const;
  /// Finds roots and curves of the leaves of cells_ from an entry on.
  void find_curves(std::size_t first_cell, int threads);
  void prepare(SplitCell& cell, CellWork& work) const;
  static bool look_closer(LeafCell& leaf, const LocalModel& model, CellWork& work);
  void find_edge_roots(std::span<const SplitCell> cells, std::span<CellWork> work, int threads);
  void trace_faces(std::span<const SplitCell> cells, std::span<CellWork> work, int threads);
  /// @param known  from the cells on both sides; where that is not enough `model` tells, which is of one of them
  const FaceCurves& trace_face(const LatticeKey& face, FaceCertificate known, const LocalModel& model,
                               std::span<const FaceRoot> roots, FaceTracer& tracer) const;
  void keep_curves(const LatticeKey& face, const FaceCurves& curves);
  LatticeKey whole_edge(int axis, const FineIndex& lo) const;
  void add_roots_on(int axis, const FineIndex& lo, int level, int side, std::vector<FaceRoot>& roots) const;
  /// @param free_edges  of the leaf that the face is of, as in CellWork
  /// @param is_high     whether it is on the high side of that
  void collect_face_roots(const LatticeKey& face, unsigned free_edges, bool is_high,
                          std::vector<FaceRoot>& roots) const;

  const GaussianField& field_;
  const Lattice& lattice_;
  const CellStore& store_;
  TracedVertices& vertices_;
  std::vector<SplitCell> cells_;
  KeyIndex<CellKey, CellKeyHash>
      folds_;                         ///< cells that keep their size, which many faces ask about, and all round them
  std::vector<FoldMark> fold_marks_;  ///< by number in folds_
  KeyIndex<CellKey, CellKeyHash> split_;
  std::vector<std::uint32_t> cell_of_;  ///< by number in split_: the entry of cells_ that its children are in
  std::vector<UncertifiedPlace> uncertified_;
  std::vector<CellKey> newly_split_;  ///< by the last call of split()
  std::vector<std::uint32_t> changed_cells_;
  LatticeKeys edges_;                    ///< those that have roots
  LatticeKeys faces_;                    ///< those that have curves
  std::vector<VertexRange> edge_roots_;  ///< by number of the edge
  std::vector<FaceLinks> face_links_;    ///< by number of the face
  std::vector<Link> links_;
};

}  // namespace gaussmesh

// The cells of the asked-for spacing that the surface crosses, with their roots and curves, by brick.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "boxes/brick_cells.h"
#include "core/key_index.h"
#include "gaussmesh/error.h"
#include "trace/face_tracer.h"

namespace gaussmesh {

/// What is known of a face of a cell.
struct CellFace {
  FaceCertificate certificate : 4 = kFaceUncertified;
  std::uint8_t fold_axes : 3 = 0;  ///< bit k: the curves need the fold points of axis k
  bool is_divided : 1 = false;     ///< it is that of smaller cells
};

/// A cell of level 0. It owns the three edges and the three faces at its lowest corner. There is one for two triangles,
/// so it is kept small.
struct SurfaceCell {
  std::uint16_t local = 0;       ///< i + 8 (j + 8 k) within the brick
  std::uint16_t first_root = 0;  ///< roots on the edges along x, y, z, one after the other, counted in the brick
  std::uint16_t first_link = 0;  ///< links in the faces across x, y, z, one after the other
  Direction direction;           ///< of the certificate; none: uncertified
  bool split = false;            ///< its surface is that of smaller cells
  std::array<CellFace, 3> face{};
  std::array<std::uint8_t, 3> root_count{};
  std::array<std::uint8_t, 3> link_count{};

  /// As in CellCertificate: what is kept of them.
  unsigned single_axes() const { return direction.sign != 0 && !direction.is_slanted() ? 1u << direction.axis : 0u; }
};

static_assert(sizeof(SurfaceCell) == 20);

/// A count that is kept in fewer bits.
/// @throws CannotMeshError if it does not fit, as of bricks and faces that the surface goes through hundreds of times
template <typename Small>
Small small_count(std::size_t count, const char* what) {
  if (count > std::numeric_limits<Small>::max()) {
    throw CannotMeshError(std::string("too many ") + what + "; choose a smaller spacing");
  }
  return static_cast<Small>(count);
}

/// Vertices with numbers that follow each other.
struct VertexRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// A cube of kBrickCells^3 cells.
struct Brick {
  BrickIndex index{};
  std::array<std::uint64_t, 8> occupied{};  ///< bit per cell
  std::array<std::uint16_t, 8> rank{};      ///< cells in the words of `occupied` before
  std::span<SurfaceCell> cells;             ///< by `local`
  std::span<const Link> links;
  std::uint32_t first_vertex = 0;  ///< number of the first root's vertex in the mesh
};

/// All cells of level 0. The roots on their edges are the first vertices of the mesh, by brick and cell. What bricks
/// have many of is in one array for all of them: that is given back to the system at once when it is done with.
class CellStore {
 public:
  /// Finds the cells, their certificates, the certificates of their faces and the roots on their edges.
  CellStore(const GaussianField& field, const Lattice& lattice, int threads);
  CellStore(const CellStore&) = delete;  // bricks point to the arrays
  CellStore& operator=(const CellStore&) = delete;

  /// Takes the curves in the faces, by brick and, as their cells count them, by cell and axis.
  void set_links(std::vector<std::vector<Link>> by_brick, int threads);

  /// Gives all cells and curves back, when nobody asks for them any more. @return the roots, which are vertices
  std::vector<SurfacePoint> release_roots() {
    bricks_ = std::vector<Brick>();
    cells_ = std::vector<SurfaceCell>();
    links_ = std::vector<Link>();
    numbers_ = {};
    rises_ = std::vector<std::int8_t>();
    return std::move(roots_);
  }

  std::vector<Brick>& bricks() { return bricks_; }
  const std::vector<Brick>& bricks() const { return bricks_; }

  struct Place {
    std::uint32_t brick = 0;
    std::uint32_t cell = 0;
    auto operator<=>(const Place&) const = default;
  };
  /// The cell with lowest corner `lo`, if the surface may cross it. `hint`: a brick to look in first.
  std::optional<Place> find(const FineIndex& lo, std::uint32_t hint = 0) const;

  SurfaceCell& cell(const Place& place) { return bricks_[place.brick].cells[place.cell]; }
  const SurfaceCell& cell(const Place& place) const { return bricks_[place.brick].cells[place.cell]; }
  FineIndex lowest_corner(const Place& place) const;

  /// Roots on an edge at the lowest corner of a cell.
  VertexRange edge_roots(const Place& place, int axis) const;
  const SurfacePoint& root(std::uint32_t vertex) const { return roots_[vertex]; }
  int rise(std::uint32_t vertex) const { return rises_[vertex]; }  ///< EdgeRoot::rise
  /// The links in a face.
  std::span<const Link> face_links(const Place& place, int axis) const;

  /// Boxes looked at in the bricks that have cells: cells, then sub-boxes of cells, halving.
  const std::vector<std::size_t>& boxes_by_level() const { return boxes_by_level_; }

  std::uint32_t root_vertices() const { return static_cast<std::uint32_t>(roots_.size()); }

 private:
  std::vector<Brick> bricks_;
  std::vector<SurfaceCell> cells_;           ///< by brick
  std::vector<Link> links_;                  ///< by brick
  KeyIndex<BrickIndex, IndexHash> numbers_;  ///< of bricks_
  std::vector<SurfacePoint> roots_;
  std::vector<std::int8_t> rises_;
  std::vector<std::size_t> boxes_by_level_;
};

}  // namespace gaussmesh

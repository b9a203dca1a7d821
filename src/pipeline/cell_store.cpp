#include "pipeline/cell_store.h"

#include <algorithm>
#include <bit>

#include "core/give_back_memory.h"
#include "core/parallel.h"
#include "gaussmesh/error.h"

namespace gaussmesh {
namespace {

/// A root without what the edge that it is on tells.
struct RootOnEdge {
  Coord at = 0;
  Normal normal{};
  std::int8_t rise = 0;
};

/// A brick, and what is joined with that of others.
struct BuiltBrick {
  Brick brick;
  std::vector<SurfaceCell> cells;
  std::vector<RootOnEdge> roots;  ///< by cell and axis
  std::vector<std::size_t> boxes_by_level;
};

/// Fills one brick. Keeps the buffers of its stages: one for each thread.
class BrickBuilder {
 public:
  BrickBuilder(const GaussianField& field, const Lattice& lattice)
      : lattice_(lattice), walker_(field, lattice), finder_(field, lattice) {}

  BuiltBrick build(const BrickIndex& index) {
    BuiltBrick result;
    Brick& brick = result.brick;
    brick.index = index;
    result.boxes_by_level = walker_.boxes_by_level();
    walker_.walk(index, [&](const BrickWalker::Cell& cell) { add_cell(cell, result); });
    std::sort(result.cells.begin(), result.cells.end(),
              [](const SurfaceCell& a, const SurfaceCell& b) { return a.local < b.local; });
    for (const SurfaceCell& cell : result.cells) brick.occupied[cell.local / 64] |= 1ull << (cell.local % 64);
    for (std::size_t w = 1; w < brick.rank.size(); ++w) {
      brick.rank[w] = static_cast<std::uint16_t>(brick.rank[w - 1] + std::popcount(brick.occupied[w - 1]));
    }
    for (std::size_t i = 0; i < result.boxes_by_level.size(); ++i) {
      result.boxes_by_level[i] = walker_.boxes_by_level()[i] - result.boxes_by_level[i];
    }
    result.cells.shrink_to_fit();
    result.roots.shrink_to_fit();
    return result;
  }

 private:
  void add_cell(const BrickWalker::Cell& found, BuiltBrick& result) {
    const auto [i, j, k] = found.in_brick;
    SurfaceCell cell;
    cell.local = static_cast<std::uint16_t>(i + kBrickCells * (j + kBrickCells * k));
    cell.direction = found.certificate.direction;
    cell.first_root = small_count<std::uint16_t>(result.roots.size(), "roots in a brick");
    const CoordPoint lo = lattice_.point(found.lo);
    for (int axis = 0; axis < 3; ++axis) {
      cell.face[axis].certificate = face_certificate(found, axis);
      const unsigned edge = 1u << axis;
      if (found.tables.is_free(i, j, k, edge)) continue;
      const Coord hi = lattice_.plane(axis, found.lo[axis] + kFinePerCell);
      const bool is_monotone =
          (found.certificate.single_axes & edge) != 0 || found.tables.directions(i, j, k, edge) != 0;
      const Side upper = found.tables.corner(i + (axis == 0), j + (axis == 1), k + (axis == 2));
      const EdgeEnds ends{found.tables.corner(i, j, k), upper, is_monotone, found.tables.zero_on_edge(i, j, k, axis)};
      const auto roots = finder_.find(found.atoms, found.model, axis, lo, hi, ends);
      cell.root_count[axis] = small_count<std::uint8_t>(roots.size(), "roots on an edge");
      for (const EdgeRoot& root : roots) {
        result.roots.push_back({root.point.position[axis], root.point.normal, root.rise});
      }
    }
    result.cells.push_back(cell);
  }

  /// The low face of a cell across `axis`: single-valued along axes of the cell that lie in it.
  FaceCertificate face_certificate(const BrickWalker::Cell& found, int axis) const {
    const auto [i, j, k] = found.in_brick;
    const unsigned extent = 7u & ~(1u << axis);
    if (found.tables.is_free(i, j, k, extent)) return kFaceEmpty;
    if (const FaceCertificate known = certificate_in_face(found.certificate.single_axes, axis)) return known;
    const unsigned single_axes = axes_of(found.tables.directions(i, j, k, extent));
    if (const FaceCertificate by_corners = certificate_in_face(single_axes, axis)) return by_corners;
    Box face = found.model.box();
    face.hi[axis] = face.lo[axis];
    return certify_face(found.model.get(), axis, face);
  }

  const Lattice& lattice_;
  BrickWalker walker_;
  EdgeRootFinder finder_;
};

FineIndex lowest_corner(const BrickIndex& brick, int local) {
  FineIndex lo = brick_origin(brick);
  for (int k = 0; k < 3; ++k, local /= kBrickCells) lo[k] += (local % kBrickCells) * kFinePerCell;
  return lo;
}

/// The bricks that have cells, in order.
std::vector<BuiltBrick> build_bricks(const GaussianField& field, const Lattice& lattice, int threads) {
  const std::vector<BrickIndex> found = find_bricks(field, lattice, threads);
  std::vector<BuiltBrick> all(found.size());
  parallel_for_workers(found.size(), threads, 1, [&] {
    return [&, builder = BrickBuilder(field, lattice)](std::size_t i) mutable { all[i] = builder.build(found[i]); };
  });
  std::erase_if(all, [](const BuiltBrick& built) { return built.cells.empty(); });
  return all;
}

/// Writes the roots of one brick, from its first vertex on.
void put_roots(const BuiltBrick& built, const Lattice& lattice, SurfacePoint* points, std::int8_t* rises) {
  for (const SurfaceCell& cell : built.cells) {
    const CoordPoint corner = lattice.point(lowest_corner(built.brick.index, cell.local));
    std::uint32_t n = cell.first_root;
    for (int axis = 0; axis < 3; ++axis) {
      for (int j = 0; j < cell.root_count[axis]; ++j, ++n) {
        const RootOnEdge& root = built.roots[n];
        points[n].position = corner;
        points[n].position[axis] = root.at;
        points[n].normal = root.normal;
        rises[n] = root.rise;
      }
    }
  }
}

}  // namespace

CellStore::CellStore(const GaussianField& field, const Lattice& lattice, int threads) {
  std::vector<BuiltBrick> all = build_bricks(field, lattice, threads);
  std::size_t vertices = 0;
  std::vector<std::size_t> first_cell{0};
  for (BuiltBrick& built : all) {
    built.brick.first_vertex = vertex_number(vertices);
    vertices += built.roots.size();
    first_cell.push_back(first_cell.back() + built.cells.size());
  }
  resize_in_parallel(cells_, first_cell.back(), threads);
  roots_.reserve(vertices + vertices / 16);  // the other vertices come behind, without a second array
  resize_in_parallel(roots_, vertices, threads);
  resize_in_parallel(rises_, vertices, threads);
  parallel_for(all.size(), threads, [&](std::size_t i) {
    Brick& brick = all[i].brick;
    put_roots(all[i], lattice, roots_.data() + brick.first_vertex, rises_.data() + brick.first_vertex);
    brick.cells = {cells_.data() + first_cell[i], all[i].cells.size()};
    std::copy(all[i].cells.begin(), all[i].cells.end(), brick.cells.begin());
    all[i].roots = std::vector<RootOnEdge>();
    all[i].cells = std::vector<SurfaceCell>();
  });
  bricks_.reserve(all.size());
  for (BuiltBrick& built : all) {
    numbers_.insert(built.brick.index);
    bricks_.push_back(std::move(built.brick));
    boxes_by_level_.resize(std::max(boxes_by_level_.size(), built.boxes_by_level.size()));
    for (std::size_t i = 0; i < built.boxes_by_level.size(); ++i) boxes_by_level_[i] += built.boxes_by_level[i];
  }
  all = std::vector<BuiltBrick>();
  give_back_memory();
}

void CellStore::set_links(std::vector<std::vector<Link>> by_brick, int threads) {
  std::vector<std::size_t> first{0};
  for (const std::vector<Link>& links : by_brick) first.push_back(first.back() + links.size());
  resize_in_parallel(links_, first.back(), threads);
  parallel_for(bricks_.size(), threads, [&](std::size_t i) {
    std::copy(by_brick[i].begin(), by_brick[i].end(), links_.data() + first[i]);
    bricks_[i].links = {links_.data() + first[i], by_brick[i].size()};
    by_brick[i] = std::vector<Link>();
  });
}

std::optional<CellStore::Place> CellStore::find(const FineIndex& lo, std::uint32_t hint) const {
  static_assert(kBrickCells == 8);
  BrickIndex index;
  unsigned local = 0;
  for (int k = 2; k >= 0; --k) {
    index[k] = lo[k] >> (kMaxLevel + 3);
    local = local * kBrickCells + static_cast<unsigned>(lo[k] >> kMaxLevel & (kBrickCells - 1));
  }
  std::uint32_t number = hint;
  if (bricks_.empty()) return std::nullopt;
  const BrickIndex& hinted = bricks_[hint].index;  // compared without a call of memcmp()
  if (hinted[0] != index[0] || hinted[1] != index[1] || hinted[2] != index[2]) {
    const std::optional<std::uint32_t> found = numbers_.find(index);
    if (!found) return std::nullopt;
    number = *found;
  }
  const Brick& brick = bricks_[number];
  const std::uint64_t bit = 1ull << (local % 64);
  if (!(brick.occupied[local / 64] & bit)) return std::nullopt;
  return Place{number,
               brick.rank[local / 64] + static_cast<unsigned>(std::popcount(brick.occupied[local / 64] & (bit - 1)))};
}

FineIndex CellStore::lowest_corner(const Place& place) const {
  return gaussmesh::lowest_corner(bricks_[place.brick].index, cell(place).local);
}

VertexRange CellStore::edge_roots(const Place& place, int axis) const {
  const SurfaceCell& c = cell(place);
  std::uint32_t first = bricks_[place.brick].first_vertex + c.first_root;
  for (int k = 0; k < axis; ++k) first += c.root_count[k];
  return {first, c.root_count[axis]};
}

std::span<const Link> CellStore::face_links(const Place& place, int axis) const {
  const SurfaceCell& c = cell(place);
  std::size_t first = c.first_link;
  for (int k = 0; k < axis; ++k) first += c.link_count[k];
  return {bricks_[place.brick].links.data() + first, c.link_count[axis]};
}

}  // namespace gaussmesh

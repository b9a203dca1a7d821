#include "pipeline/trace_bricks.h"

#include <optional>

#include "core/parallel.h"

namespace gaussmesh {
namespace {

/// What is followed on the faces that one brick owns.
struct BrickCurves {
  std::vector<Link> links;
  std::vector<SurfacePoint> points;  ///< inside faces: the vertices of the links from kLocalVertex on
};

/// Follows the curves on the faces that one brick owns.
class BrickTracer {
 public:
  BrickTracer(const GaussianField& field, const Lattice& lattice, const CellStore& store)
      : lattice_(lattice), store_(store), tracer_(field, lattice), atoms_(field) {
    tracer_.set_plain(true);
  }

  /// Counts the links in a brick's cells, and changes nothing that other bricks are traced from.
  BrickCurves trace(Brick& brick, std::uint32_t brick_number) {
    move_to(brick_number);
    BrickCurves result;
    for (std::uint32_t i = 0; i < brick.cells.size(); ++i) {
      brick.cells[i].first_link = small_count<std::uint16_t>(result.links.size(), "curve pieces in a brick");
      find_next({brick_number, i});
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t before = result.links.size();
        trace_face({brick_number, i}, axis, result);
        const std::size_t count = result.links.size() - before;
        brick.cells[i].link_count[axis] = small_count<std::uint8_t>(count, "curve pieces on a face");
      }
    }
    result.links.shrink_to_fit();
    return result;
  }

 private:
  void trace_face(const CellStore::Place& place, int axis, BrickCurves& result) {
    const SurfaceCell& cell = store_.cell(place);
    if (cell.face[axis].certificate == kFaceEmpty || cell.face[axis].is_divided) return;
    const FaceCertificate certificate = certificate_of(place, axis);
    collect_roots(place, axis);
    const CoordPoint lo = lattice_.point(store_.lowest_corner(place));
    CoordPoint hi = lo;
    hi[first_axis(axis)] += lattice_.step * kFinePerCell;
    hi[second_axis(axis)] += lattice_.step * kFinePerCell;
    const FaceCurves& curves = tracer_.trace(axis, lo, hi, certificate, roots_, cell.face[axis].fold_axes);
    const auto base = static_cast<std::uint32_t>(result.points.size());
    const auto numbered = [&](std::uint32_t v) { return v >= kLocalVertex ? base + v : v; };
    for (const Link& link : curves.links) result.links.push_back({numbered(link.from), numbered(link.to)});
    result.points.insert(result.points.end(), curves.points.begin(), curves.points.end());
  }

  /// A face without a certificate of its own is single-valued along the axis of the cell below it, if that lies in
  /// it.
  FaceCertificate certificate_of(const CellStore::Place& place, int axis) const {
    const SurfaceCell& cell = store_.cell(place);
    const FaceCertificate own = cell.face[axis].certificate;
    if (own != kFaceUncertified && own != kFaceNoClosedCurve) return own;
    const auto below = store_.find(moved(store_.lowest_corner(place), axis, -kFinePerCell), place.brick);
    if (!below) return kFaceEmpty;
    const FaceCertificate along = certificate_in_face(store_.cell(*below).single_axes(), axis);
    return along != kFaceUncertified ? along : own;
  }

  void move_to(std::uint32_t brick) {
    const FineIndex lo = brick_origin(store_.bricks()[brick].index);
    const std::int64_t size = kBrickCells * kFinePerCell;
    atoms_.move_to(lattice_box(lattice_, lo, {lo[0] + size, lo[1] + size, lo[2] + size}));
    tracer_.take_atoms_from(atoms_);
  }

  void find_next(const CellStore::Place& place) {
    const FineIndex lo = store_.lowest_corner(place);
    for (int axis = 0; axis < 3; ++axis) next_[axis] = store_.find(moved(lo, axis, kFinePerCell), place.brick);
  }

  void collect_roots(const CellStore::Place& place, int axis) {
    roots_.clear();
    const int a = first_axis(axis), b = second_axis(axis);
    add_roots(place, a, 0);
    if (next_[a]) add_roots(*next_[a], b, 1);
    if (next_[b]) add_roots(*next_[b], a, 2);
    add_roots(place, b, 3);
  }

  void add_roots(const CellStore::Place& place, int axis, int side) {
    const VertexRange roots = store_.edge_roots(place, axis);
    for (std::uint32_t v = roots.first; v < roots.first + roots.count; ++v) {
      roots_.push_back({v, store_.root(v).position, side, store_.rise(v)});
    }
  }

  const Lattice& lattice_;
  const CellStore& store_;
  FaceTracer tracer_;
  LocalAtoms atoms_;                                     ///< near the brick
  std::array<std::optional<CellStore::Place>, 3> next_;  ///< the cells beyond the one at hand, by axis
  std::vector<FaceRoot> roots_;
};

}  // namespace

void trace_bricks(const GaussianField& field, const Lattice& lattice, CellStore& store, TracedVertices& vertices,
                  int threads) {
  std::vector<Brick>& bricks = store.bricks();
  std::vector<BrickCurves> curves(bricks.size());
  parallel_for_workers(bricks.size(), threads, 1, [&] {
    return [&, tracer = BrickTracer(field, lattice, store)](std::size_t i) mutable {
      curves[i] = tracer.trace(bricks[i], static_cast<std::uint32_t>(i));
    };
  });
  std::vector<std::vector<Link>> links;
  links.reserve(bricks.size());
  for (BrickCurves& found : curves) {
    const std::uint32_t first = vertices.add(found.points).first;
    const auto number = [&](std::uint32_t& v) {
      if (v >= kLocalVertex) v = first + (v - kLocalVertex);
    };
    for (Link& link : found.links) {
      number(link.from);
      number(link.to);
    }
    links.push_back(std::move(found.links));
  }
  store.set_links(std::move(links), threads);
}

}  // namespace gaussmesh

#include "pipeline/trace_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>

#include "core/lattice_degenerate.h"
#include "gaussmesh/error.h"
#include "pipeline/assemble_surface.h"
#include "pipeline/cell_triangulator.h"
#include "pipeline/critical_point.h"
#include "pipeline/find_fold_cells.h"
#include "pipeline/trace_bricks.h"

namespace gaussmesh {
namespace {

/// Rounds of splitting cells whose loops found no embedded triangulation. Each such cell is halved, which changes its
/// neighbours' loops: along the crease between two large spheres that can go on cell by cell for dozens of rounds.
constexpr int kMaxRounds = 1000;

/// Offsets of the lattice, as fractions of a cell: the first that gives no degenerate place is used.
constexpr Vec3 kOffsets[] = {{0.37193, 0.41421, 0.23607}, {0.61803, 0.14159, 0.71828}, {0.05572, 0.87298, 0.58258}};

/// The lattice of cells of about the asked-for size, or larger ones far from the origin: see kMostCellNumber.
Lattice make_lattice(const Box& bounds, double cell, const Vec3& fractions) {
  double farthest = 0.0;
  for (int k = 0; k < 3; ++k) farthest = std::max({farthest, std::abs(bounds.lo[k]), std::abs(bounds.hi[k])});
  const auto steps = [](double size) { return size * kUnitsPerAngstrom / double(kFinePerCell); };
  const auto least_step = static_cast<Coord>(std::ceil(steps(farthest / kMostCellNumber)));
  Lattice lattice;
  lattice.step = std::max({Coord{2}, least_step, Coord{std::llround(steps(cell))}});
  for (int k = 0; k < 3; ++k) lattice.offset[k] = std::llround(fractions[k] * double(lattice.step * kFinePerCell));
  return lattice;
}

void add_box_counts(const CellStore& store, const Lattice& lattice, TraceResult& result) {
  result.boxes_by_level = store.boxes_by_level();
  for (const Brick& brick : store.bricks()) result.cells += brick.cells.size();
  while (!result.boxes_by_level.empty() && result.boxes_by_level.back() == 0) result.boxes_by_level.pop_back();
  const int halvings = static_cast<int>(result.boxes_by_level.size()) - 1;
  result.cell_size = lattice.cell_size();
  result.smallest_box = lattice.cell_size() * std::ldexp(1.0, -std::max(0, halvings));
}

/// The proof looked at cells at least as small as the leaves.
void note_leaves(const SplitLattice& split, const Lattice& lattice, TraceResult& result) {
  for (const std::uint32_t cell : split.changed_cells()) {
    for (const LeafCell& leaf : split.cells()[cell].leaves) {
      result.smallest_box = std::min(result.smallest_box, lattice.cell_size() * std::ldexp(1.0, -leaf.key.level));
    }
  }
}

TraceResult trace_on(const GaussianField& field, const Lattice& lattice, const TraceDemands& demands, int threads,
                     const StageClock& finished) {
  TraceResult result;
  CellStore store(field, lattice, threads);
  add_box_counts(store, lattice, result);
  finished("boxes and roots");
  const FoldSearchResult search = find_fold_cells(field, lattice, store, threads);
  const double finest = lattice.cell_size() * std::ldexp(1.0, -search.finest_level);
  result.smallest_box = std::min(result.smallest_box, finest);
  finished("folds");
  if (!search.uncertified.empty()) {
    result.uncertified = search.uncertified;
    return result;
  }
  mark_folds(search.folds, store);
  TracedVertices vertices(store);
  auto split = std::make_optional<SplitLattice>(field, lattice, store, search.folds, vertices);
  CellTriangulator cells(field, lattice, store, demands);
  std::vector<CellKey> to_split = search.to_split;
  for (int round = 0; round < kMaxRounds; ++round) {
    split->split(to_split, threads);
    note_leaves(*split, lattice, result);
    if (!split->uncertified().empty()) {
      result.uncertified = split->uncertified();
      return result;
    }
    split->mark_cells(store);
    if (round == 0) trace_bricks(field, lattice, store, vertices, threads);
    finished("curves");
    to_split = cells.triangulate(*split, search.folds, vertices, threads);
    if (to_split.empty()) {
      result.cells_split = split->split_cells();
      split.reset();  // nobody asks for its cells and curves any more, and the mesh needs the room
      result.cells_cut_by_folds = cells.fold_cells();
      result.surface = assemble_surface(std::move(cells).release(), store, vertices, threads);
      finished("patches");
      return result;
    }
    finished("patches");
    for (const CellKey& cell : to_split) {
      if (cell.level == kMaxLevel) throw LatticeDegenerate(to_angstrom(lattice.point(cell.lo)));
    }
  }
  throw InternalError("cells were split again and again without an embedded triangulation");
}

/// Whether a place is degenerate on every lattice: next to a critical point with |log(phi / c)| this small the
/// surface comes within some 0.001 A of itself, and its slope falls below a thousandth of what it is elsewhere. Roots
/// and signs that double precision cannot tell are then the rule, and not a chance of the lattice.
bool is_near_critical(const GaussianField& field, const Vec3& place) {
  constexpr double kNearCritical = 1e-6;
  const CriticalPoint critical = find_critical_point(field, place);
  return critical.converged && std::abs(std::log(critical.relative_value)) < kNearCritical;
}

}  // namespace

TraceResult trace_surface(const GaussianField& field, const TraceDemands& demands, int threads,
                          const StageClock& finished) {
  const auto trace_with = [&](const Vec3& offset) {
    return trace_on(field, make_lattice(field.bounding_box(), demands.spacing, offset), demands, threads, finished);
  };
  for (const Vec3& offset : std::span(kOffsets).first(std::size(kOffsets) - 1)) {
    try {
      return trace_with(offset);
    } catch (const LatticeDegenerate&) {  // the next one may do
    }
  }
  try {
    return trace_with(std::end(kOffsets)[-1]);
  } catch (const LatticeDegenerate& degenerate) {
    if (!is_near_critical(field, degenerate.place)) throw;
    TraceResult result;
    result.uncertified.push_back({degenerate.place, 0.0});
    return result;
  }
}

}  // namespace gaussmesh

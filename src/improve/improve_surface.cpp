#include "improve/improve_surface.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "improve/bad_places.h"
#include "improve/edge_operations.h"
#include "improve/mesh_blocks.h"
#include "improve/relax.h"
#include "improve/repair.h"

namespace gaussmesh {
namespace {

/// Edges beyond these factors of the wanted size are split or collapsed. Their geometric mean and the relaxation
/// between make the mean edge what is wanted.
constexpr double kSplitFactor = 1.45;
constexpr double kCollapseFactor = 0.65;

/// Edge of the blocks in cells of the trace: a few thousand triangles each, which fit into a core's cache.
constexpr double kBlockEdge = 32.0;

/// Where the surface is much finer than the cells blocks are smaller, to have as few triangles: no more than so many
/// mean edges, but wide enough for triangles that are as large as the cells.
constexpr double kBlockEdgeInEdges = 96.0;
constexpr double kLeastBlockEdge = 6.0;  ///< cells

/// Where curvature asks for small triangles elsewhere, the others may be larger than the spacing by up to this
/// factor, so that the mean edge is what was asked for.
constexpr double kLargestFactor = 1.25;
constexpr int kSweepsForLargest = 2;  ///< after each of so many it is found anew

/// Where triangles are much too large they are first cut to size.
constexpr int kMostHalvings = 4;

constexpr int kRepairRounds = 3;

/// What one sweep does in each block. The planes between the blocks lie elsewhere in each of four sweeps that
/// follow each other: a place near planes of all three axes in three of them is free in the fourth.
struct Sweep {
  int rounds = 0;       ///< of splits, collapses, flips and relaxation
  double effort = 0.0;  ///< how long it takes, for those who wait: the first has the most to do
  bool repairs = false;
  bool settles = false;  ///< leaves the vertices exactly on the surface
};
constexpr std::array kSweeps = {Sweep{.rounds = 3, .effort = 9.0}, Sweep{.rounds = 3, .effort = 3.0},
                                Sweep{.rounds = 3, .effort = 3.0, .repairs = true},
                                Sweep{.rounds = 2, .effort = 2.0, .repairs = true, .settles = true}};
constexpr int kSweepsWithOtherPlanes = 4;

/// The last one is done again, up to so often, while triangles are less even than this: a mean ratio of the shortest to
/// the longest edge, a little more than the 0.85 that it is to be after mending too. Few meshes need it.
constexpr double kEvenRatio = 0.851;
constexpr double kMostBadForRatio = 0.02;  ///< part of the vertices; where more are bad it would be in vain
constexpr int kMostSweepsForRatio = 6;

/// Follow them: in boxes round what is bad, as often as it takes. What is not mended in small boxes, as a long crease,
/// is tried again in larger ones. Where nothing has changed another box of the same size would be in vain too, and
/// where that is so with three sizes the place is given up.
constexpr double kSizesInHalfABox = 5.0;
constexpr int kSweepsPerDoubling = 3;
constexpr int kMostInVain = 3;
constexpr double kMostHalfEdge = 5.0;  ///< spacings

/// Where more than this part of all vertices stays bad, a few sweeps that leave no fewer than this part of the bad ones
/// are the last: the surface is finer than triangles may be.
constexpr double kGain = 0.9;
constexpr double kStillBad = 0.05;

/// Where a finer trace can follow it takes less, if so many times as many as there were at the best are bad: some
/// places get worse for as long as they are worked on.
constexpr double kLoss = 1.5;
constexpr double kFewBad = 0.005;

constexpr int kRoundsInBoxes = 3;
constexpr int kMostSweepsOfBoxes = 20;

constexpr double kEffortInBoxes = 1.0;  ///< they touch little

WholeMesh start_with(SurfaceMesh traced, double spacing) {
  WholeMesh mesh;
  mesh.triangles = std::move(traced.mesh.triangles);
  mesh.at = std::move(traced.mesh.vertices);
  mesh.normal = std::move(traced.normals);
  mesh.size.assign(mesh.at.size(), static_cast<float>(spacing));
  mesh.curvature.assign(mesh.at.size(), -1.0f);
  mesh.refinement.assign(mesh.at.size(), 1.0f);
  return mesh;
}

/// Mean over the triangles of value(edges), which are squared lengths of the three.
template <typename Value>
double mean_over_triangles(const WholeMesh& mesh, int threads, const Value& value) {
  constexpr std::size_t kTrianglesAtOnce = 65536;
  const auto sums = parallel_gather<double>(mesh.triangles.size(), kTrianglesAtOnce, threads,
                                            [&](std::size_t first, std::size_t last, std::vector<double>& list) {
                                              double sum = 0.0;
                                              for (std::size_t number = first; number < last; ++number) {
                                                const Triangle& t = mesh.triangles[number];
                                                const Vec3 a = mesh.at[t[1]] - mesh.at[t[0]],
                                                           b = mesh.at[t[2]] - mesh.at[t[1]],
                                                           c = mesh.at[t[0]] - mesh.at[t[2]];
                                                sum += value(std::array<double, 3>{dot(a, a), dot(b, b), dot(c, c)});
                                              }
                                              list.push_back(sum);
                                            });
  return std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(mesh.triangles.size());
}

double mean_edge(const WholeMesh& mesh, int threads) {
  return mean_over_triangles(mesh, threads, [](const std::array<double, 3>& edges) {
    return (std::sqrt(edges[0]) + std::sqrt(edges[1]) + std::sqrt(edges[2])) / 3.0;
  });
}

/// Of the shortest to the longest edge.
double mean_edge_ratio(const WholeMesh& mesh, int threads) {
  return mean_over_triangles(mesh, threads, [](const std::array<double, 3>& edges) {
    const auto [shortest, longest] = std::minmax_element(edges.begin(), edges.end());
    return std::sqrt(*shortest / *longest);
  });
}

/// Edge (A) of blocks for a mesh as it was traced.
double block_edge(double cell, double mean_edge) {
  return std::clamp(kBlockEdgeInEdges * mean_edge, kLeastBlockEdge * cell, kBlockEdge * cell);
}

/// Makes only those vertices active that are some rings at most from others.
void activate_round(BlockMesh& mesh, std::vector<std::uint32_t> front) {
  constexpr int kRings = 4;
  const HalfEdgeMesh& c = mesh.connectivity;
  std::fill(mesh.is_active.begin(), mesh.is_active.end(), std::uint8_t{0});
  for (const std::uint32_t v : front) mesh.is_active[v] = 1;
  for (int ring = 0; ring < kRings; ++ring) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t v : front) {
      if (!c.is_inner(v)) continue;
      c.visit_star(v, [&](std::uint32_t h) {
        if (mesh.is_active[c.to(h)]) return;
        mesh.is_active[c.to(h)] = 1;
        next.push_back(c.to(h));
      });
    }
    front = std::move(next);
  }
}

void run_round(BlockMesh& mesh, SheetGuard& guard, BlockField& field, Accuracy accuracy) {
  split_long_edges(mesh, guard, field, kSplitFactor, accuracy);
  collapse_short_edges(mesh, guard, kCollapseFactor);
  flip_edges(mesh, guard);
  even_out_valences(mesh, guard);
  relax_vertices(mesh, guard, field, accuracy);
}

void cut_to_size(BlockMesh& mesh, SheetGuard& guard, BlockField& field, Accuracy accuracy) {
  for (int i = 0; i < kMostHalvings && split_long_edges(mesh, guard, field, 2.0 * kSplitFactor, accuracy) > 0; ++i) {
  }
}

void improve_block(BlockMesh& mesh, const GaussianField& whole_field, const SizeTargets& targets, Guarding guarding,
                   const Sweep& sweep) {
  BlockField field(whole_field, mesh.box);
  find_wanted_sizes(mesh, field, targets);
  SheetGuard guard(mesh, guarding);
  cut_to_size(mesh, guard, field, Accuracy::kRough);
  for (int round = 0; round < sweep.rounds; ++round) run_round(mesh, guard, field, Accuracy::kRough);
  if (sweep.settles) settle_vertices(mesh, field);
  refine(mesh, corners_at_sharp_edges(mesh));
  if (sweep.repairs) repair_triangles(mesh, guard, field, kLeastAngleDeg, kRepairRounds);
}

/// Whether these are the same places with the same wishes.
bool is_same(const std::vector<BadPlace>& a, const std::vector<BadPlace>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const BadPlace& p, const BadPlace& q) { return p.at == q.at && p.size == q.size; });
}

/// Works where a triangle is bad or neighbours turn sharply, and leaves vertices exactly on the surface.
/// @param in_vain  boxes before this one that changed nothing
/// @return places that are still bad
std::vector<BadPlace> mend_block(BlockMesh& mesh, const GaussianField& whole_field, const SizeTargets& targets,
                                 Guarding guarding, int in_vain) {
  BlockField field(whole_field, mesh.box);
  std::vector<BadPlace> at_first;
  for (int round = 0;; ++round) {
    const std::vector<std::uint32_t> sharp = corners_at_sharp_edges(mesh);
    std::vector<std::uint32_t> bad = find_bad_vertices(mesh, sharp);
    if (round == 0) at_first = places_of(mesh, bad);
    if (bad.empty() || round == kRoundsInBoxes) {
      std::vector<BadPlace> left = places_of(mesh, bad);
      if (is_same(left, at_first)) {
        for (BadPlace& place : left) place.in_vain = in_vain + 1;
      }
      return left;
    }
    refine(mesh, sharp);
    activate_round(mesh, std::move(bad));
    find_wanted_sizes(mesh, field, targets);
    SheetGuard guard(mesh, guarding);
    cut_to_size(mesh, guard, field, Accuracy::kExact);
    run_round(mesh, guard, field, Accuracy::kExact);
    repair_triangles(mesh, guard, field, kLeastAngleDeg, kRepairRounds);
  }
}

/// Makes one mesh over: first all of it, then what is still bad.
class SurfaceImprover {
 public:
  SurfaceImprover(SurfaceMesh traced, const GaussianField& field, const SizeTargets& targets, Guarding guarding,
                  int threads, const std::function<void(double share_done)>& on_progress)
      : mesh_(start_with(std::move(traced), targets.spacing)),
        field_(field),
        targets_(targets),
        guarding_(guarding),
        threads_(threads),
        on_progress_(on_progress) {
    for (const Sweep& sweep : kSweeps) all_effort_ += sweep.effort;
    all_effort_ += kMostSweepsForRatio * kSweeps.back().effort;
  }

  void sweep_all() {
    const double edge = block_edge(targets_.cell, mean_edge(mesh_, threads_));
    int number = 0;
    const auto run_sweep = [&](const Sweep& sweep) {
      const double shift = edge * (number++ % kSweepsWithOtherPlanes) / kSweepsWithOtherPlanes;
      run(MeshBlocks(std::move(mesh_), edge, {shift, shift, shift}, threads_), sweep.effort,
          [&](std::size_t, BlockMesh& block) { improve_block(block, field_, targets_, guarding_, sweep); });
    };
    for (const Sweep& sweep : kSweeps) {
      run_sweep(sweep);
      if (number > kSweepsForLargest) continue;
      const double wish = targets_.largest() / mean_edge(mesh_, threads_);
      targets_.largest_factor = std::clamp(wish, 1.0, kLargestFactor);
      if (number == kSweepsForLargest) std::fill(mesh_.curvature.begin(), mesh_.curvature.end(), -1.0f);
    }
    for (int i = 0; i < kMostSweepsForRatio && can_be_more_even(); ++i) run_sweep(kSweeps.back());
  }

  /// @return what is left bad
  LeftBad mend_in_boxes(ManyBad many_bad) {
    std::vector<BadPlace> bad;  // where none is known the whole mesh is looked at
    std::size_t fewest = mesh_.at.size();
    int last_gain = 0;
    const bool can_be_left = many_bad == ManyBad::kLeave;
    for (int i = 0; i < kMostSweepsOfBoxes; ++i) {
      // Where all that is known waits for larger boxes they come at once.
      if (bad.empty() && !waiting_.empty()) i += (kSweepsPerDoubling - i % kSweepsPerDoubling) % kSweepsPerDoubling;
      if (i % kSweepsPerDoubling == 0) {
        bad.insert(bad.end(), waiting_.begin(), waiting_.end());
        waiting_.clear();
      }
      if (bad.empty()) bad = bad_with_hope();
      if (bad.empty() && given_up_.empty()) return {};
      if (bad.empty()) break;
      const std::size_t all = bad.size() + waiting_.size() + given_up_.size();
      const auto count = static_cast<double>(all), before = static_cast<double>(fewest);
      if (count < kGain * before) {
        fewest = all;
        last_gain = i;
      }
      const double share = count / static_cast<double>(mesh_.at.size());
      const bool is_loss = count > kLoss * before, has_no_gain = i - last_gain > kSweepsPerDoubling;
      if (can_be_left && share > kManyBad && all >= kLeastMany) {
        return {find_thin_vertices(mesh_, threads_).size(), places_to_trace(find_bad_vertices(mesh_, threads_))};
      }
      if (has_no_gain && (share > kStillBad || (can_be_left && share > kFewBad && is_loss))) break;
      mend(bad, kSizesInHalfABox * std::exp2(i / kSweepsPerDoubling));
    }
    const std::vector<std::uint32_t> thin = find_thin_vertices(mesh_, threads_);
    return {thin.size(), places_to_trace(thin)};
  }

  SurfaceMesh release() && {
    if (on_progress_) on_progress_(1.0);
    return {{std::move(mesh_.at), std::move(mesh_.triangles)}, std::move(mesh_.normal)};
  }

 private:
  /// Works on all blocks, work(number, block), and joins them again.
  template <typename Work>
  void run(MeshBlocks blocks, double effort, const Work& work) {
    std::atomic<int> blocks_done = 0;
    const std::vector<std::uint32_t> order = blocks.largest_first();
    parallel_for(order.size(), threads_, [&](std::size_t i) {
      const std::size_t b = order[i];
      BlockMesh block = blocks.extract(b);
      work(b, block);
      blocks.store(b, std::move(block));
      if (!on_progress_) return;
      on_progress_((effort_done_ + effort * ++blocks_done / static_cast<double>(blocks.size())) / all_effort_);
    });
    effort_done_ += effort;
    mesh_ = std::move(blocks).join(threads_);
  }

  /// Where more than a few vertices are bad the mean says nothing, and a finer trace may follow.
  bool can_be_more_even() const {
    if (mean_edge_ratio(mesh_, threads_) >= kEvenRatio) return false;
    const auto bad = static_cast<double>(find_bad_vertices(mesh_, threads_).size());
    return bad <= kMostBadForRatio * static_cast<double>(mesh_.at.size());
  }

  /// Bad places of the whole mesh, but for those that were given up and are as they were.
  std::vector<BadPlace> bad_with_hope() {
    std::vector<BadPlace> bad = places_of(mesh_, find_bad_vertices(mesh_, threads_));
    std::sort(given_up_.begin(), given_up_.end());
    std::erase_if(
        bad, [&](const BadPlace& place) { return std::binary_search(given_up_.begin(), given_up_.end(), place.at); });
    return bad;
  }

  /// In boxes round some of the places, which are taken from the list; those that are bad afterwards are added, or if
  /// nothing has changed in their box, wait for a larger one.
  void mend(std::vector<BadPlace>& bad, double sizes_in_half_a_box) {
    const BoxSize size{sizes_in_half_a_box, kMostHalfEdge * targets_.spacing};
    const std::vector<BadPlace> centres = take_apart(bad, size);
    std::vector<Box> boxes;
    for (const BadPlace& centre : centres) boxes.push_back(box_round(centre, size));
    std::vector<std::vector<BadPlace>> left(boxes.size());
    run(MeshBlocks(std::move(mesh_), boxes, threads_), kEffortInBoxes, [&](std::size_t b, BlockMesh& block) {
      left[b] = mend_block(block, field_, targets_, guarding_, centres[b].in_vain);
    });
    for (const auto& places : left) {
      for (const BadPlace& place : places) {
        if (place.in_vain >= kMostInVain) {
          given_up_.push_back(place.at);
        } else {
          (place.in_vain > 0 ? waiting_ : bad).push_back(place);
        }
      }
    }
  }

  std::vector<BadPlace> places_to_trace(const std::vector<std::uint32_t>& bad) const {
    return places_round(bad, mesh_, targets_.cell);
  }

  WholeMesh mesh_;
  std::vector<BadPlace> waiting_;  ///< for larger boxes
  std::vector<Vec3> given_up_;     ///< places (A)
  const GaussianField& field_;
  SizeTargets targets_;
  const Guarding guarding_;
  const int threads_;
  const std::function<void(double share_done)>& on_progress_;
  double all_effort_ = kMostSweepsOfBoxes * kEffortInBoxes;
  double effort_done_ = 0.0;
};

}  // namespace

ImprovedSurface improve_surface(SurfaceMesh traced, const GaussianField& field, const SizeTargets& targets,
                                Guarding guarding, ManyBad many_bad, int threads,
                                const std::function<void(double share_done)>& on_progress) {
  SurfaceImprover improver(std::move(traced), field, targets, guarding, threads, on_progress);
  improver.sweep_all();
  LeftBad left = improver.mend_in_boxes(many_bad);
  return {std::move(improver).release(), std::move(left)};
}

}  // namespace gaussmesh

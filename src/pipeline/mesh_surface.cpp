// From atoms to a judged mesh: attempts at a level, a lattice and sizes, until one keeps all that is promised. One
// trace is in trace_surface.h.
#include "gaussmesh/mesh_surface.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/give_back_memory.h"
#include "core/lattice_degenerate.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "field/gaussian_field.h"
#include "gaussmesh/error.h"
#include "gaussmesh/two_sided_distance.h"
#include "improve/cell_size.h"
#include "pipeline/check_options.h"
#include "pipeline/critical_places.h"
#include "pipeline/euler_numbers.h"
#include "pipeline/finer_traces.h"
#include "pipeline/room.h"
#include "pipeline/trace_surface.h"

namespace gaussmesh {
namespace {

/// Measures the stages one after the other.
class Stopwatch {
 public:
  Stopwatch(std::vector<StageCost>& stages, std::function<void(const std::string&)> on_stage_end)
      : stages_(stages), on_stage_end_(std::move(on_stage_end)) {}

  void finished(const std::string& name) {
    if (on_stage_end_) on_stage_end_(name);
    const auto now = Clock::now();
    const double time_s = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double memory_MB = static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;  // it counts in KiB
    for (StageCost& stage : stages_) {
      if (stage.name != name) continue;
      stage.time_s += time_s;
      stage.peak_memory_MB = memory_MB;
      return;
    }
    stages_.push_back({name, time_s, memory_MB});
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<StageCost>& stages_;
  std::function<void(const std::string&)> on_stage_end_;
  Clock::time_point last_ = Clock::now();
};

void describe_trace(const TraceResult& trace, MeshReport& report) {
  report.boxes.clear();  // of an attempt before
  for (std::size_t i = 0; i < trace.boxes_by_level.size(); ++i) {
    report.boxes.push_back({trace.cell_size * std::ldexp(1.0, -static_cast<int>(i)), trace.boxes_by_level[i]});
  }
  report.smallest_box = trace.smallest_box;
  report.cells = trace.cells;
  report.cells_split = trace.cells_split;
  report.cells_cut_by_folds = trace.cells_cut_by_folds;
}

/// Makes one mesh; each step leaves in the result what is known so far.
class SurfaceMesher {
 public:
  SurfaceMesher(const std::vector<Atom>& atoms, const MeshOptions& options)
      : atoms_(atoms),
        options_(options),
        threads_(thread_count(options.threads)),
        watch_(result_.report.stages, options.on_stage_end),
        field_(atoms, options.decay, options.isovalue),
        demands_{options.spacing, options.improve} {
    watch_.finished("field");
    MeshReport& report = result_.report;
    report.atoms = atoms.size();
    report.options = options;
    report.isovalue_used = options.isovalue;
  }

  MeshResult run() {
    if (options_.improve) {
      mesh_improved();
    } else {
      mesh_as_traced();
    }
    require_promises();
    return std::move(result_);
  }

 private:
  void mesh_as_traced() {
    require_room_as_traced(field_, options_);
    take_mesh(trace());
    result_.report.check = check_mesh(result_.mesh);
    if (options_.measure_distance) measure_distance();
  }

  /// Sizes follow the curvature at vertices; between them it may be larger, and the tolerance takes another attempt:
  /// for as much less as the last one missed by and a tenth, within limits.
  void mesh_improved() {
    constexpr int kMostAttempts = 4;
    constexpr double kLeastChange = 0.9, kMostChange = 0.6;
    SizeTargets targets;
    targets.spacing = options_.spacing;
    targets.tolerance = options_.tolerance;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      const SizeSamples samples = sample_sizes(field_, targets);
      require_room(least_triangle_count(samples), options_);
      demands_.spacing = suitable_cell_size(samples, targets.spacing);
      improve_until_no_angle_is_small(targets);
      if (!is_good()) return;
      if (options_.measure_distance || options_.tolerance > 0.0) measure_distance();
      watch_.finished("verify");
      if (options_.tolerance == 0.0 || *result_.report.surface_distance <= options_.tolerance) return;
      const double excess = *result_.report.surface_distance / options_.tolerance;
      targets.tolerance *= std::clamp(kLeastChange / excess, kMostChange, kLeastChange);
    }
  }

  /// Leaves a mesh with its judgement. One with small angles is traced anew as long as that may help, one that is not
  /// good is improved once more with exact signs for every change.
  void improve_until_no_angle_is_small(const SizeTargets& targets) {
    for (Guarding guarding = Guarding::kCloseSheets;; guarding = Guarding::kEverywhere) {
      LeftBad bad;
      std::vector<std::int64_t> traced;
      do {
        SurfaceMesh surface = trace();
        traced = euler_numbers(surface.mesh);
        bad = improve(std::move(surface), targets, guarding);
      } while (can_be_finer_ && finer_traces_.demand(bad, result_.mesh.vertices.size(), demands_));
      result_.report.check = check_mesh(result_.mesh);
      has_same_topology_ = euler_numbers(result_.report.check.components) == traced;
      watch_.finished("verify");
      if (is_good() || guarding == Guarding::kEverywhere) return;
    }
  }

  /// The traced surface, with the certificate in the report. @throws CannotMeshError
  SurfaceMesh trace() {
    take_mesh({});  // that of an attempt before makes room
    MeshReport& report = result_.report;
    TraceResult trace = trace_at_level();
    if (!trace.uncertified.empty()) {
      report.critical = critical_places(field_, trace.uncertified, options_.isovalue);
      if (report.critical.empty()) throw CannotMeshError(coarse_message(trace.uncertified));
      if (!options_.allow_uncertified) {
        throw CannotMeshError(critical_message(report.critical, options_.isovalue, trace.uncertified.front().size));
      }
      trace = trace_beside();
    }
    report.certified = report.isovalue_used == options_.isovalue;
    give_back_memory();  // cells, roots and curves, most of what there is up to here
    describe_trace(trace, report);
    if (trace.surface.mesh.triangles.empty()) {
      const auto largest = std::max_element(atoms_.begin(), atoms_.end(),
                                            [](const Atom& a, const Atom& b) { return a.radius < b.radius; });
      throw CannotMeshError("nothing to mesh: phi is below c = " + number_text(options_.isovalue, 15) +
                            " everywhere, with radii of " + number_text(largest->radius) +
                            " A at most; choose a smaller c, or larger radii");
    }
    return std::move(trace.surface);
  }

  TraceResult trace_with(const TraceDemands& demands) {
    return trace_surface(field_, demands, threads_, [&](const std::string& stage) { watch_.finished(stage); });
  }

  /// Whether there is a mesh without these demands: they may fail.
  static bool is_extra(const TraceDemands& demands) { return !demands.fine_places.empty(); }

  /// By the first of the demands that leads to a certified surface. @throws CannotMeshError
  TraceResult trace_at_level() {
    std::optional<TraceResult> uncertified;
    std::string degenerate;
    for (const TraceDemands& demands : demands_in_turn()) {
      try {
        TraceResult trace = trace_with(demands);
        if (trace.uncertified.empty()) {
          demands_ = demands;
          return trace;
        }
        uncertified = std::move(trace);
      } catch (const LatticeDegenerate& error) {
        degenerate = error.what();
      } catch (const CannotMeshError&) {
        if (!is_extra(demands)) throw;
      } catch (const std::bad_alloc&) {
        if (!is_extra(demands)) throw;
      } catch (const InternalError&) {  // as where cells are split again and again
        if (!is_extra(demands)) throw;
      }
      if (is_extra(demands)) can_be_finer_ = false;
    }
    if (uncertified) return std::move(*uncertified);
    throw CannotMeshError(degenerate + "; another spacing may help");
  }

  /// At the nearest level beside c that can be certified, c (1 +- 1e-9 4^k), which from now on is the field's.
  /// @throws CannotMeshError
  TraceResult trace_beside() {
    for (double change = 1e-9; change < 1e-2; change *= 4.0) {
      for (const double sign : {-1.0, 1.0}) {
        result_.report.isovalue_used = options_.isovalue * (1.0 + sign * change);
        field_ = GaussianField(atoms_, options_.decay, result_.report.isovalue_used);
        try {
          TraceResult trace = trace_with(demands_);
          if (trace.uncertified.empty() && !trace.surface.mesh.triangles.empty()) return trace;
        } catch (const LatticeDegenerate&) {
          continue;  // no lattice fits this level; the next one may do
        }
      }
    }
    throw CannotMeshError("no level within a hundredth of c = " + number_text(options_.isovalue, 15) +
                          " can be certified");
  }

  /// What is demanded, and then less: the lattice of smaller cells may be degenerate where that of the others is not.
  /// At last, where the cells are large, less large ones: near a critical value of phi the proof may need smaller boxes
  /// than are the smallest parts of large cells. A mesh as traced has the cells that were asked for.
  std::vector<TraceDemands> demands_in_turn() const {
    constexpr double kSmallCells = 0.5, kLeastPart = 0.125;  // A; of the spacing
    std::vector<TraceDemands> demands = {demands_};
    const auto add = [&](const auto& change) {
      demands.push_back(demands.back());
      change(demands.back());
    };
    if (!demands_.fine_places.empty()) add([](TraceDemands& less) { less.fine_places.clear(); });
    if (demands_.spacing < options_.spacing) add([&](TraceDemands& less) { less.spacing = options_.spacing; });
    if (demands_.for_improvement) add([](TraceDemands& less) { less.for_improvement = false; });
    const double small = std::max(kSmallCells, kLeastPart * options_.spacing);
    if (options_.improve && small < demands_.spacing) add([&](TraceDemands& other) { other.spacing = small; });
    return demands;
  }

  /// Improves a traced mesh. @return what is left bad
  LeftBad improve(SurfaceMesh traced, SizeTargets targets, Guarding guarding) {
    const ManyBad many_bad = can_be_finer_ && demands_.fine_places.empty() ? ManyBad::kLeave : ManyBad::kMend;
    targets.cell = demands_.spacing;  // those that were traced with in the end
    ImprovedSurface improved =
        improve_surface(std::move(traced), field_, targets, guarding, many_bad, threads_, options_.on_improving);
    take_mesh(std::move(improved.surface));
    watch_.finished("improve");
    return std::move(improved.left);
  }

  /// @throws CannotMeshError if the judge cannot number its triangles
  void take_mesh(SurfaceMesh surface) {
    if (surface.mesh.triangles.size() > kMostParts) {
      throw CannotMeshError("more than 2^31 triangles; choose a larger spacing");
    }
    result_.mesh = std::move(surface.mesh);
    result_.normals = std::move(surface.normals);
  }

  void measure_distance() {
    const TwoSidedDistance d = two_sided_distance(result_.mesh, atoms_, options_.decay, result_.report.isovalue_used);
    result_.report.surface_distance = std::max(d.mesh_to_surface, d.surface_to_mesh);
  }

  /// Whether the last mesh may be given out, as far as topology and embedding go.
  bool is_good() const { return has_same_topology_ && result_.report.check.fit_for_solver(); }

  /// @throws InternalError, CannotMeshError
  void require_promises() {
    MeshReport& report = result_.report;
    if (!has_same_topology_) {
      throw InternalError("the finished mesh has other Euler numbers than the traced one: please report this molecule");
    }
    if (!is_good()) {
      throw InternalError("the finished mesh is not closed, embedded and oriented: please report this molecule");
    }
    if (options_.tolerance > 0.0 && *report.surface_distance > options_.tolerance) {
      throw CannotMeshError("tolerance: asked for " + number_text(options_.tolerance) + " A, reached " +
                            number_text(*report.surface_distance, 3) + " A; choose a smaller spacing too");
    }
    give_back_memory();  // what the judge took
    report.vertex_distance_max =
        vertex_distance_to_surface(result_.mesh, atoms_, options_.decay, report.isovalue_used).max;
    if (!(report.vertex_distance_max <= kVertexTolerance)) {
      throw InternalError("a vertex is " + number_text(report.vertex_distance_max) +
                          " A away from the surface: please report this molecule");
    }
    watch_.finished("verify");
  }

  const std::vector<Atom>& atoms_;
  const MeshOptions& options_;
  const int threads_;
  MeshResult result_;
  Stopwatch watch_;
  GaussianField field_;  ///< at c, or at a level beside it
  TraceDemands demands_;
  FinerTraces finer_traces_;
  bool can_be_finer_ = true;       ///< no finer trace has failed
  bool has_same_topology_ = true;  ///< as the traced surface
};

}  // namespace

double spacing_for_density(double vertices_per_A2) { return std::sqrt(2.0 / (std::sqrt(3.0) * vertices_per_A2)); }

MeshResult mesh_surface(const std::vector<Atom>& atoms, const MeshOptions& options) {
  check_options(atoms, options);
  const DefaultThreads judge_threads(thread_count(options.threads));  // the judge knows nothing of options
  return SurfaceMesher(atoms, options).run();
}

}  // namespace gaussmesh

#include "gaussmesh/mesh_surface.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "core/give_back_memory.h"
#include "core/lattice_degenerate.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "field/gaussian_field.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_atoms.h"
#include "gaussmesh/two_sided_distance.h"
#include "pipeline/critical_point.h"
#include "pipeline/trace_surface.h"

namespace gaussmesh {
namespace {

/// How far vertices may be from phi = c (A): the promise of mesh_surface().
constexpr double kVertexTolerance = 1e-6;

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

void check_range(const char* name, double value, double lo, double hi, const char* unit) {
  if (value >= lo && value <= hi) return;
  throw OptionError(std::string(name) + ": expected a number from " + number_text(lo) + " to " + number_text(hi) +
                    unit + ", got '" + number_text(value) + "'");
}

void check_options(const std::vector<Atom>& atoms, const MeshOptions& options) {
  check_range("decay", options.decay, 1e-3, 1e3, " (1/A^2)");
  check_range("isovalue", options.isovalue, 1e-9, 1e9, "");
  check_range("spacing", options.spacing, 0.01, 1000.0, " (A)");
  check_range("tolerance", options.tolerance, 0.0, 1000.0, " (A)");
  check_range("threads", options.threads, 0, 4096, "");
  if (!options.improve && options.tolerance > 0.0) {
    throw OptionError("tolerance: expected 0 where the mesh is to stay as traced, got '" +
                      number_text(options.tolerance) + "'");
  }
  if (options.improve && options.spacing > kLargestSpacing) {
    throw OptionError("spacing: expected at most " + number_text(kLargestSpacing) +
                      " A unless the mesh is to stay as traced, got '" + number_text(options.spacing) + "'");
  }
  if (atoms.empty()) throw InputError("no atoms: expected at least one");
  for (const Atom& a : atoms) {
    bool is_good = a.radius >= 0.0 && a.radius <= kLargestRadius;
    for (const double x : {a.x, a.y, a.z}) is_good = is_good && std::abs(x) <= kLargestCoordinate;
    if (!is_good) {
      throw InputError("an atom: expected coordinates within 1e6 A and a radius from 0 to 1e5 A, got (" +
                       number_text(a.x) + ", " + number_text(a.y) + ", " + number_text(a.z) + "), " +
                       number_text(a.radius));
    }
  }
}

void take_mesh(SurfaceMesh surface, MeshResult& result) {
  result.mesh = std::move(surface.mesh);
  result.normals = std::move(surface.normals);
}

void describe_trace(const TraceResult& trace, double cell_size, MeshReport& report) {
  report.boxes.clear();  // of an attempt before
  for (std::size_t i = 0; i < trace.boxes_by_level.size(); ++i) {
    report.boxes.push_back({cell_size * std::ldexp(1.0, -static_cast<int>(i)), trace.boxes_by_level[i]});
  }
  report.smallest_box = trace.smallest_box;
  report.cells = trace.cells;
  report.cells_split = trace.cells_split;
  report.cells_cut_by_folds = trace.cells_cut_by_folds;
}

/// Critical points with values near c at the places where the proof gave up; several places have one point in common.
std::vector<CriticalPlace> critical_places(const GaussianField& field, const TraceResult& trace, double isovalue) {
  constexpr double kSamePoint = 1e-3;     // A
  constexpr double kNearCritical = 1e-3;  // |log(phi / c)|; where it is more, the cells are too coarse for the surface
  std::vector<CriticalPlace> places;
  for (const UncertifiedPlace& place : trace.uncertified) {
    const CriticalPoint critical = find_critical_point(field, place.place);
    if (!critical.converged || !(std::abs(std::log(critical.relative_value)) < kNearCritical)) continue;
    const bool known = std::any_of(places.begin(), places.end(), [&](const CriticalPlace& other) {
      double distance = 0.0;
      for (int k = 0; k < 3; ++k) distance = std::max(distance, std::abs(other.point[k] - critical.point[k]));
      return distance < kSamePoint;
    });
    if (!known) places.push_back({critical.point, critical.relative_value * isovalue});
  }
  return places;
}

std::string place_text(const Vec3& place) {
  const auto coordinate = [&](int k) { return number_text(std::round(place[k] * 1e6) / 1e6 + 0.0, 13); };
  return "(" + coordinate(0) + ", " + coordinate(1) + ", " + coordinate(2) + ")";
}

/// Where the proof gave up, and not because of the level.
std::string coarse_message(const std::vector<UncertifiedPlace>& places) {
  std::string message = "the surface is finer than the smallest parts of cells, of " +
                        number_text(places.front().size, 3) + " A, at " + place_text(places.front().place);
  if (places.size() > 1) message += " and " + std::to_string(places.size() - 1) + " more places";
  return message + ". No proof of topology is possible there; choose a smaller spacing.";
}

std::string critical_message(const std::vector<CriticalPlace>& places, double isovalue) {
  const CriticalPlace& first = places.front();
  std::string message = "c = " + number_text(isovalue, 15) + " is too near a critical value of phi: at " +
                        place_text(first.point) + " the surface is singular at c = " + number_text(first.value, 15) +
                        ", " + number_text(std::abs(isovalue - first.value), 3) + " away";
  if (places.size() > 1) message += ", and at " + std::to_string(places.size() - 1) + " more places";
  return message + ". No proof of topology is possible there; choose another c, or --allow-uncertified.";
}

/// Levels beside c, nearer ones first: c (1 +- 1e-9 4^k). Tried when a mesh without certificate is allowed.
TraceResult trace_beside(const std::vector<Atom>& atoms, const MeshOptions& options, const TraceDemands& demands,
                         int threads, Stopwatch& watch, double& isovalue_used) {
  for (double change = 1e-9; change < 1e-2; change *= 4.0) {
    for (const double sign : {-1.0, 1.0}) {
      isovalue_used = options.isovalue * (1.0 + sign * change);
      const GaussianField field(atoms, options.decay, isovalue_used);
      try {
        TraceResult trace =
            trace_surface(field, demands, threads, [&](const std::string& stage) { watch.finished(stage); });
        if (trace.uncertified.empty()) return trace;
      } catch (const LatticeDegenerate&) {
        continue;  // no lattice fits this level; the next one may do
      }
    }
  }
  throw CannotMeshError("no level within a hundredth of c = " + number_text(options.isovalue) + " can be certified");
}

/// V - F / 2, which is the Euler number of a closed mesh.
std::int64_t euler_number(const TriangleMesh& mesh) {
  return static_cast<std::int64_t>(mesh.vertices.size()) - static_cast<std::int64_t>(mesh.triangles.size() / 2);
}

/// The traced surface, with the certificate in `report`.
/// @throws CannotMeshError
SurfaceMesh certified_trace(const GaussianField& field, const std::vector<Atom>& atoms, const TraceDemands& demands,
                            int threads, Stopwatch& watch, MeshReport& report) {
  const MeshOptions& options = report.options;
  TraceResult trace;
  try {
    trace = trace_surface(field, demands, threads, [&](const std::string& stage) { watch.finished(stage); });
    report.certified = trace.uncertified.empty();
    if (!report.certified) {
      report.critical = critical_places(field, trace, options.isovalue);
      if (report.critical.empty()) throw CannotMeshError(coarse_message(trace.uncertified));
      if (!options.allow_uncertified) throw CannotMeshError(critical_message(report.critical, options.isovalue));
      trace = trace_beside(atoms, options, demands, threads, watch, report.isovalue_used);
    }
  } catch (const LatticeDegenerate& degenerate) {
    throw CannotMeshError(std::string(degenerate.what()) + "; another spacing may help");
  }
  give_back_memory();  // cells, roots and curves, most of what there is up to here
  describe_trace(trace, options.spacing, report);
  if (trace.surface.mesh.triangles.empty()) {
    throw CannotMeshError("nothing to mesh: phi is below c = " + number_text(options.isovalue) +
                          " everywhere; choose a smaller c");
  }
  return std::move(trace.surface);
}

/// Improves a traced mesh; `result` gets it with the judge's verdict.
/// @return the corners of triangles with small angles that are left; nothing if the mesh may not be given out
std::optional<std::vector<Vec3>> improve(SurfaceMesh traced, const GaussianField& field, const SizeTargets& targets,
                                         Guarding guarding, int threads, Stopwatch& watch, MeshResult& result) {
  const auto& on_progress = result.report.options.on_improving;
  const std::int64_t chi = euler_number(traced.mesh);
  ImprovedSurface improved = improve_surface(std::move(traced), field, targets, guarding, threads, on_progress);
  const bool same_topology = euler_number(improved.surface.mesh) == chi;
  take_mesh(std::move(improved.surface), result);
  watch.finished("improve");
  result.report.check = check_mesh(result.mesh);
  watch.finished("verify");
  if (!same_topology || !result.report.check.fit_for_solver()) return std::nullopt;
  return std::move(improved.thin);
}

/// Asks for smaller cells where small angles are left: triangles that bridge what is finer than they are cannot always
/// be mended, but those of a finer trace can. @return whether there is such a trace to be tried
bool ask_for_finer_trace(const std::vector<Vec3>& thin, TraceDemands& demands) {
  constexpr int kLevels[] = {3, 5};  // one after the other
  const int before = demands.fine_places.empty() ? 0 : demands.fine_places.back().level;
  const int* level = std::upper_bound(std::begin(kLevels), std::end(kLevels), before);
  if (thin.empty() || level == std::end(kLevels)) return false;
  for (const Vec3& place : thin) demands.fine_places.push_back({place, *level});
  return true;
}

}  // namespace

double spacing_for_density(double vertices_per_A2) { return std::sqrt(2.0 / (std::sqrt(3.0) * vertices_per_A2)); }

MeshResult mesh_surface(const std::vector<Atom>& atoms, const MeshOptions& options) {
  check_options(atoms, options);
  const int threads = thread_count(options.threads);
  const DefaultThreads judge_threads(threads);  // the judge knows nothing of options
  MeshResult result;
  MeshReport& report = result.report;
  report.atoms = atoms.size();
  report.options = options;
  report.isovalue_used = options.isovalue;
  Stopwatch watch(report.stages, options.on_stage_end);

  const GaussianField field(atoms, options.decay, options.isovalue);
  watch.finished("field");
  TraceDemands demands{options.spacing, options.improve};
  const auto trace = [&] {
    take_mesh({}, result);  // that of an attempt before makes room
    return certified_trace(field, atoms, demands, threads, watch, report);
  };
  const auto measure = [&] {
    const TwoSidedDistance d = two_sided_distance(result.mesh, atoms, options.decay, report.isovalue_used);
    report.surface_distance = std::max(d.mesh_to_surface, d.surface_to_mesh);
  };
  bool is_good = true;
  if (!options.improve) {
    take_mesh(trace(), result);
    report.check = check_mesh(result.mesh);
    is_good = report.check.fit_for_solver();
    if (options.measure_distance) measure();
  } else {
    // Sizes follow the curvature at vertices; between them it may be larger, and the tolerance takes another
    // attempt.
    constexpr int kMostAttempts = 4;
    SizeTargets targets;
    targets.spacing = options.spacing;
    targets.tolerance = options.tolerance;
    for (int attempt = 0; attempt < kMostAttempts;) {
      SurfaceMesh traced = trace();
      const GaussianField used(atoms, options.decay, report.isovalue_used);
      auto thin = improve(std::move(traced), used, targets, Guarding::kCloseSheets, threads, watch, result);
      if (!thin) thin = improve(trace(), used, targets, Guarding::kEverywhere, threads, watch, result);
      is_good = thin.has_value();
      if (!is_good) break;
      if (ask_for_finer_trace(*thin, demands)) continue;
      if (options.measure_distance || options.tolerance > 0.0) measure();
      watch.finished("verify");
      if (options.tolerance == 0.0 || *report.surface_distance <= options.tolerance) break;
      ++attempt;
      targets.tolerance *= 0.6;
    }
  }
  if (!is_good) {
    throw InternalError("the finished mesh is not closed, embedded and oriented: please report this molecule");
  }
  if (options.tolerance > 0.0 && *report.surface_distance > options.tolerance) {
    throw CannotMeshError("tolerance: asked for " + number_text(options.tolerance) + " A, reached " +
                          number_text(*report.surface_distance, 3) + " A; choose a smaller spacing too");
  }
  give_back_memory();  // what the judge took
  report.vertex_distance_max = vertex_distance_to_surface(result.mesh, atoms, options.decay, report.isovalue_used).max;
  if (!(report.vertex_distance_max <= kVertexTolerance)) {
    throw InternalError("a vertex is " + number_text(report.vertex_distance_max) +
                        " A away from the surface: please report this molecule");
  }
  watch.finished("verify");
  return result;
}

}  // namespace gaussmesh

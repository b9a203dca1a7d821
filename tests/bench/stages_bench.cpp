// How long each stage takes, one by one and on one thread: for a look at what a change did.
//
//   stages_bench [MOL [SPACING]] [options of Google Benchmark]     fas2 at 0.5 A where nothing else is said
//
// `items_per_second` counts what the stage is asked for: bytes, points, boxes, cells, or triangles of the mesh that
// it makes or is given. Whole runs of the program are measured by scripts/benchmark.py.

#include <benchmark/benchmark.h>
#include <omp.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "boxes/brick_cells.h"
#include "field/point_value.h"
#include "gaussmesh/check_mesh.h"
#include "gaussmesh/mesh_surface.h"
#include "gaussmesh/read_atoms.h"
#include "gaussmesh/write_mesh.h"
#include "improve/improve_surface.h"
#include "pipeline/trace_surface.h"
#include "support/folder.h"

namespace gaussmesh {
namespace {

constexpr int kThreads = 1;

/// What all benchmarks work on; made once.
struct Workload {
  std::string path;
  std::string text;  ///< of the file
  std::vector<Atom> atoms;
  MeshOptions options;
  GaussianField field;
  Lattice lattice;
  std::vector<BrickIndex> bricks;
  SurfaceMesh traced;
  MeshResult raw, improved;
};

MeshOptions options_for(double spacing) {
  MeshOptions options;
  options.spacing = spacing;
  options.threads = kThreads;
  return options;
}

MeshResult mesh_raw(const std::vector<Atom>& atoms, MeshOptions options) {
  options.improve = false;
  return mesh_surface(atoms, options);
}

/// The surface as it is traced for a mesh that is to be improved.
SurfaceMesh trace(const GaussianField& field, double spacing) {
  TraceDemands demands;
  demands.spacing = spacing;
  demands.for_improvement = true;
  return trace_surface(field, demands, kThreads, [](const std::string&) {}).surface;
}

Lattice lattice_for(double spacing) {
  Lattice lattice;
  lattice.step = std::llround(spacing * kUnitsPerAngstrom / double(kFinePerCell));
  for (int k = 0; k < 3; ++k) lattice.offset[k] = lattice.step * kFinePerCell * (3 + k) / 8 + 1;
  return lattice;
}

Workload make_workload(const std::string& path, double spacing) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  std::vector<Atom> atoms = read_atoms(path).atoms;
  const MeshOptions options = options_for(spacing);
  GaussianField field(atoms, options.decay, options.isovalue);
  const Lattice lattice = lattice_for(spacing);
  std::vector<BrickIndex> bricks = find_bricks(field, lattice);
  SurfaceMesh traced = trace(field, spacing);
  MeshResult raw = mesh_raw(atoms, options), improved = mesh_surface(atoms, options);
  return {path,    std::move(text),   std::move(atoms),  options,        std::move(field),
          lattice, std::move(bricks), std::move(traced), std::move(raw), std::move(improved)};
}

void count_items(benchmark::State& state, std::size_t items) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(items));
}

void read_molecule(benchmark::State& state, const Workload& work) {
  for (auto _ : state) benchmark::DoNotOptimize(read_atoms(work.path));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(work.text.size()));
  count_items(state, work.atoms.size());
}

void build_field(benchmark::State& state, const Workload& work) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(GaussianField(work.atoms, work.options.decay, work.options.isovalue));
  }
  count_items(state, work.atoms.size());
}

/// A thousand vertices of the mesh or a little more, spread over all of it.
std::vector<Vec3> some_vertices(const TriangleMesh& mesh) {
  constexpr std::size_t kCount = 1000;
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / kCount);
  std::vector<Vec3> some;
  for (std::size_t v = 0; v < mesh.vertices.size(); v += step) some.push_back(mesh.vertices[v]);
  return some;
}

/// phi at vertices, with the atoms near each at hand.
void evaluate_points(benchmark::State& state, const Workload& work) {
  std::vector<std::pair<NearAtoms, Vec3>> points;
  for (const Vec3& at : some_vertices(work.raw.mesh)) {
    NearAtoms atoms;
    work.field.collect_near({at, at}, atoms);
    points.emplace_back(std::move(atoms), at);
  }
  for (auto _ : state) {
    for (const auto& [atoms, at] : points) benchmark::DoNotOptimize(evaluate(atoms, work.options.decay, at));
  }
  count_items(state, points.size());
}

/// The model of a cell of the spacing at a vertex, and the bounds that a proof asks it for.
void bound_cells(benchmark::State& state, const Workload& work) {
  std::vector<std::pair<NearAtoms, Box>> boxes;
  for (const Vec3& at : some_vertices(work.raw.mesh)) {
    Box box{at, at};
    for (int k = 0; k < 3; ++k) {
      box.lo[k] -= work.options.spacing / 2;
      box.hi[k] += work.options.spacing / 2;
    }
    NearAtoms atoms;
    work.field.collect_near(box, atoms, kProofTruncation);
    boxes.emplace_back(std::move(atoms), box);
  }
  for (auto _ : state) {
    for (const auto& [atoms, box] : boxes) {
      const LocalModel model(atoms, work.options.decay, box);
      const LocalModel::View view = model.over_all();
      benchmark::DoNotOptimize(view.value());
      for (int axis = 0; axis < 3; ++axis) benchmark::DoNotOptimize(view.slope(axis));
    }
  }
  count_items(state, boxes.size());
}

void search_bricks(benchmark::State& state, const Workload& work) {
  for (auto _ : state) benchmark::DoNotOptimize(find_bricks(work.field, work.lattice));
  count_items(state, work.bricks.size());
}

/// The cells of all bricks, with their certificates.
void walk_bricks(benchmark::State& state, const Workload& work) {
  std::size_t cells = 0;
  for (auto _ : state) {
    cells = 0;
    BrickWalker walker(work.field, work.lattice);
    for (const BrickIndex& brick : work.bricks) walker.walk(brick, [&](const BrickWalker::Cell&) { ++cells; });
  }
  count_items(state, cells);
}

/// Bricks and cells as above, then roots, curves and patches.
void trace_molecule(benchmark::State& state, const Workload& work) {
  for (auto _ : state) benchmark::DoNotOptimize(trace(work.field, work.options.spacing));
  count_items(state, work.traced.mesh.triangles.size());
}

void improve_molecule(benchmark::State& state, const Workload& work) {
  SizeTargets targets;
  targets.spacing = work.options.spacing;
  for (auto _ : state) {
    state.PauseTiming();
    SurfaceMesh traced = work.traced;
    state.ResumeTiming();
    benchmark::DoNotOptimize(
        improve_surface(std::move(traced), work.field, targets, Guarding::kCloseSheets, ManyBad::kMend, kThreads));
  }
  count_items(state, work.improved.mesh.triangles.size());
}

void judge(benchmark::State& state, const MeshResult& made) {
  for (auto _ : state) benchmark::DoNotOptimize(check_mesh(made.mesh));
  count_items(state, made.mesh.triangles.size());
}

void measure_vertices(benchmark::State& state, const Workload& work) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        vertex_distance_to_surface(work.improved.mesh, work.atoms, work.options.decay, work.options.isovalue));
  }
  count_items(state, work.improved.mesh.triangles.size());
}

void write_format(benchmark::State& state, const Workload& work, const std::string& format) {
  const testing::Folder folder;
  WriteOptions options;
  options.format = format;
  for (auto _ : state) write_mesh(work.improved.mesh, {work.improved.normals, {}, {}}, folder / "mesh", options);
  count_items(state, work.improved.mesh.triangles.size());
}

void mesh_molecule(benchmark::State& state, const Workload& work, bool is_raw) {
  std::size_t triangles = 0;
  for (auto _ : state) {
    triangles =
        (is_raw ? mesh_raw(work.atoms, work.options) : mesh_surface(work.atoms, work.options)).mesh.triangles.size();
  }
  count_items(state, triangles);
}

void register_all(const Workload& work) {
  const auto add = [](const std::string& name, auto&& run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
  };
  using State = benchmark::State;
  add("read", [&](State& state) { read_molecule(state, work); });
  add("field/build", [&](State& state) { build_field(state, work); });
  add("field/values", [&](State& state) { evaluate_points(state, work); });
  add("field/bounds", [&](State& state) { bound_cells(state, work); });
  add("boxes/bricks", [&](State& state) { search_bricks(state, work); });
  add("boxes/cells", [&](State& state) { walk_bricks(state, work); });
  add("trace", [&](State& state) { trace_molecule(state, work); });
  add("improve", [&](State& state) { improve_molecule(state, work); });
  add("verify/raw", [&](State& state) { judge(state, work.raw); });
  add("verify/improved", [&](State& state) { judge(state, work.improved); });
  add("verify/distances", [&](State& state) { measure_vertices(state, work); });
  for (const MeshFormat& format : mesh_formats()) {
    const std::string name(format.name);
    add("write/" + name, [&work, name](State& state) { write_format(state, work, name); });
  }
  add("whole/raw", [&](State& state) { mesh_molecule(state, work, true); });
  add("whole/default", [&](State& state) { mesh_molecule(state, work, false); });
}

}  // namespace
}  // namespace gaussmesh

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);        // takes its own options out
  omp_set_num_threads(gaussmesh::kThreads);  // the judge takes as many as OpenMP has
  const std::string molecule = argc > 1 ? argv[1] : GAUSSMESH_DATA "/fas2.pqr";
  const double spacing = argc > 2 ? std::stod(argv[2]) : 0.5;
  const gaussmesh::Workload work = gaussmesh::make_workload(molecule, spacing);
  gaussmesh::register_all(work);
  benchmark::RunSpecifiedBenchmarks();
}

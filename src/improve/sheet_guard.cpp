#include "improve/sheet_guard.h"

#include "core/simd.h"

namespace gaussmesh {
namespace {

/// Normals within a box of directions.
struct NormalBox {
  Normal lo{2, 2, 2}, hi{-2, -2, -2};

  void add(const Normal& n) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], n[k]);
      hi[k] = std::max(hi[k], n[k]);
    }
  }
  /// Least scalar product of a vector in each of two boxes.
  float least_cosine(const NormalBox& other) const {
    float sum = 0.0f;
    for (int k = 0; k < 3; ++k) {
      sum += std::min({lo[k] * other.lo[k], lo[k] * other.hi[k], hi[k] * other.lo[k], hi[k] * other.hi[k]});
    }
    return sum;
  }
};

/// Vertices whose normals differ by more than this (cosine; 75 degrees) and which are near are of two sheets.
constexpr float kOtherSheet = 0.25f;

/// What counts as near, in wanted sizes. Triangles of that size turn by about a radian at most, and lie within a
/// fifth of it from the surface: sheets farther apart than two fifths cannot meet, and where they are nearer, one
/// of them has a vertex within this of some vertex of the other. Larger means more exact tests, each of them for
/// nothing.
constexpr double kReachInSizes = 1.0;

/// Places relative to the block (A), normals and reaches (A) of vertices.
struct VertexArrays {
  std::vector<float> x, y, z, nx, ny, nz, reach;
};

/// Vertices with numbers first .. last - 1.
struct Run {
  std::uint32_t first, last;
};

/// Whether any vertex of the runs is of another sheet than v and within reach of it, or v within its reach.
GAUSSMESH_SIMD_CLONES
bool has_close_sheet(const VertexArrays& a, std::uint32_t v, const Run* runs, std::size_t count) {
  const float *xs = a.x.data(), *ys = a.y.data(), *zs = a.z.data(), *reaches = a.reach.data();
  const float *nxs = a.nx.data(), *nys = a.ny.data(), *nzs = a.nz.data();
  const float x = xs[v], y = ys[v], z = zs[v], nx = nxs[v], ny = nys[v], nz = nzs[v], reach = reaches[v];
  for (std::size_t r = 0; r < count; ++r) {
    int found = 0;
#pragma omp simd reduction(| : found)
    for (std::uint32_t i = runs[r].first; i < runs[r].last; ++i) {
      const float dx = xs[i] - x, dy = ys[i] - y, dz = zs[i] - z;
      const float most = reaches[i] > reach ? reaches[i] : reach;
      found |= int{nx * nxs[i] + ny * nys[i] + nz * nzs[i] < kOtherSheet} &
               int{dx * dx + dy * dy + dz * dz < most * most};
    }
    if (found != 0) return true;
  }
  return false;
}

/// The vertices of a block in a grid of cells as wide as `reach`, which no vertex reaches farther than.
class VertexGrid {
 public:
  VertexGrid(const BlockMesh& mesh, double reach) {
    // Cells no narrower than the reach; what lies outside the box goes to the cells at its sides.
    double width = 0.0;
    for (int k = 0; k < 3; ++k) width = std::max(width, mesh.box.hi[k] - mesh.box.lo[k]);
    const double cell_size = std::max(reach, width / kMostCells);
    cells_ = std::clamp(static_cast<int>(std::ceil(width / cell_size)), 1, kMostCells);
    const auto all_cells = static_cast<std::size_t>(cells_ * cells_ * cells_);
    first_.assign(all_cells + 1, 0);
    std::vector<std::uint32_t> cell_of;
    cell_of.reserve(mesh.at.size());
    for (const Vec3& p : mesh.at) {
      int cell = 0;
      for (int k = 0; k < 3; ++k) cell = cell * cells_ + slab_of((p[k] - mesh.box.lo[k]) / cell_size, cells_);
      cell_of.push_back(static_cast<std::uint32_t>(cell));
    }
    for (const std::uint32_t cell : cell_of) ++first_[cell + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    sorted_.resize(mesh.at.size());
    for (auto* array : {&of_.x, &of_.y, &of_.z, &of_.nx, &of_.ny, &of_.nz, &of_.reach}) array->resize(mesh.at.size());
    boxes_.resize(all_cells);
    std::vector<std::uint32_t> fill(first_.begin(), first_.end() - 1);
    for (std::uint32_t v = 0; v < mesh.at.size(); ++v) {
      const std::uint32_t i = fill[cell_of[v]]++;
      sorted_[i] = v;
      const Normal& n = mesh.normal[v];
      boxes_[cell_of[v]].add(n);
      of_.x[i] = static_cast<float>(mesh.at[v][0] - mesh.box.lo[0]);
      of_.y[i] = static_cast<float>(mesh.at[v][1] - mesh.box.lo[1]);
      of_.z[i] = static_cast<float>(mesh.at[v][2] - mesh.box.lo[2]);
      of_.nx[i] = n[0];
      of_.ny[i] = n[1];
      of_.nz[i] = n[2];
      of_.reach[i] = static_cast<float>(std::min(reach, kReachInSizes * double(mesh.size[v])));
    }
  }

  /// Calls mark(v) for every vertex that has one of another sheet within reach; also for those that stay where they
  /// are, since what moves is tested against their triangles.
  template <typename Mark>
  void find_close_sheets(const Mark& mark) const {
    for (std::uint32_t cell = 0; cell < boxes_.size(); ++cell) {
      if (first_[cell] == first_[cell + 1]) continue;
      const auto number = static_cast<int>(cell);
      const std::array<int, 3> at{number / (cells_ * cells_), number / cells_ % cells_, number % cells_};
      std::array<Run, 9> runs;
      std::size_t count = 0;
      for (int i = std::max(0, at[0] - 1); i <= std::min(cells_ - 1, at[0] + 1); ++i) {
        for (int j = std::max(0, at[1] - 1); j <= std::min(cells_ - 1, at[1] + 1); ++j) {
          Run run{0, 0};
          for (int k = std::max(0, at[2] - 1); k <= std::min(cells_ - 1, at[2] + 1); ++k) {
            const auto other = static_cast<std::uint32_t>((i * cells_ + j) * cells_ + k);
            if (first_[other] == first_[other + 1]) continue;
            if (boxes_[cell].least_cosine(boxes_[other]) >= kOtherSheet) continue;
            if (run.last == 0) run.first = first_[other];
            run.last = first_[other + 1];
          }
          if (run.last != 0) runs[count++] = run;
        }
      }
      for (std::uint32_t i = first_[cell]; i < first_[cell + 1] && count > 0; ++i) {
        if (has_close_sheet(of_, i, runs.data(), count)) mark(sorted_[i]);
      }
    }
  }

 private:
  static constexpr int kMostCells = 24;  ///< along an axis

  int cells_ = 1;                      ///< along an axis
  std::vector<std::uint32_t> first_;   ///< by cell: of its vertices in sorted_
  std::vector<std::uint32_t> sorted_;  ///< vertices by cell
  VertexArrays of_;                    ///< by place in sorted_
  std::vector<NormalBox> boxes_;       ///< by cell
};

void mark_close_sheets(BlockMesh& mesh, double reach) {
  const HalfEdgeMesh& c = mesh.connectivity;
  std::vector<std::uint8_t> marks(mesh.at.size(), 0);
  VertexGrid(mesh, reach).find_close_sheets([&](std::uint32_t v) { marks[v] = 1; });
  mesh.is_guarded = marks;
  const auto spread = [&](const Triangle& t) {
    if (!marks[t[0]] && !marks[t[1]] && !marks[t[2]]) return;
    for (const std::uint32_t v : t) mesh.is_guarded[v] = 1;
  };
  for (std::uint32_t t = 0; t < c.triangles(); ++t) {
    if (c.has_triangle(t)) spread(c.triangle(t));
  }
  for (const Triangle& t : mesh.fixed) spread(t);
}

}  // namespace

SheetGuard::SheetGuard(BlockMesh& mesh, double largest, bool everywhere)
    : lo_(mesh.box.lo), everywhere_(everywhere) {
  double width = 0.0;
  for (int k = 0; k < 3; ++k) width = std::max(width, mesh.box.hi[k] - mesh.box.lo[k]);
  cells_per_angstrom_ = static_cast<float>(kMostCells / width);
  if (everywhere) {
    std::fill(mesh.is_guarded.begin(), mesh.is_guarded.end(), std::uint8_t{1});
  } else {
    mark_close_sheets(mesh, kReachInSizes * largest);
  }
  for (std::uint32_t t = 0; t < mesh.connectivity.triangles(); ++t) {
    if (mesh.connectivity.has_triangle(t)) insert(mesh, t);
  }
  for (std::uint32_t i = 0; i < mesh.fixed.size(); ++i) {
    if (is_guarded(mesh, mesh.fixed[i])) enter(mesh, mesh.fixed[i], kFirstFixed + i);
  }
}

bool SheetGuard::pair_may_meet(const BlockMesh& mesh, const Triangle& s, const Triangle& t) {
  const auto name = [&](const Triangle& u) {
    return NamedTriangle{u, {to_units(mesh.at[u[0]]), to_units(mesh.at[u[1]]), to_units(mesh.at[u[2]])}};
  };
  return triangles_may_meet(name(s), name(t));
}

void SheetGuard::insert(const BlockMesh& mesh, std::uint32_t triangle) {
  const Triangle t = mesh.connectivity.triangle(triangle);
  if (is_guarded(mesh, t)) enter(mesh, t, triangle);
}

void SheetGuard::enter(const BlockMesh& mesh, const Triangle& corners, std::uint32_t triangle) {
  if (head_.empty()) head_.assign(kMostCells * kMostCells * kMostCells, -1);
  const SmallBox box = box_of(mesh, corners);
  const Normal normal = mean_normal(mesh, corners);
  visit_cells(box, [&](std::size_t cell) {
    for (std::int32_t n = head_[cell]; n >= 0; n = nodes_[n].next) {
      if (nodes_[n].triangle != triangle) continue;
      nodes_[n].box = box;
      nodes_[n].normal = normal;
      return false;
    }
    nodes_.push_back({triangle, head_[cell], box, normal});
    head_[cell] = static_cast<std::int32_t>(nodes_.size()) - 1;
    return false;
  });
}

}  // namespace gaussmesh

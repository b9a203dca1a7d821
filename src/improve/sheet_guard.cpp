#include "improve/sheet_guard.h"

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
  void add(const NormalBox& other) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], other.lo[k]);
      hi[k] = std::max(hi[k], other.hi[k]);
    }
  }
  /// Least scalar product of n and a vector in the box.
  float least_cosine(const Normal& n) const {
    float sum = 0.0f;
    for (int k = 0; k < 3; ++k) sum += std::min(n[k] * lo[k], n[k] * hi[k]);
    return sum;
  }
  /// |m - n|^2 = 2 - 2 cos for unit vectors.
  double most_chord_sq() const {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += double(hi[k] - lo[k]) * double(hi[k] - lo[k]);
    return sum;
  }
};

/// Vertices whose normals differ by more than this (cosine; 75 degrees) and which are near are of two sheets.
constexpr double kOtherSheet = 0.25;

/// What counts as near, in wanted sizes. Triangles of that size turn by about a radian at most, and lie within a
/// fifth of it from the surface: sheets farther apart than two fifths cannot meet, and where they are nearer, one
/// of them has a vertex within this of some vertex of the other. Larger means more exact tests, each of them for
/// nothing.
constexpr double kReachInSizes = 1.0;

/// The vertices of a block in a grid of cells as wide as `reach`.
class VertexGrid {
 public:
  VertexGrid(const BlockMesh& mesh, double reach)
      : mesh_(mesh), reach_(reach), first_(kCells * kCells * kCells + 1, 0) {
    // Cells no narrower than the reach; what lies outside the box goes to the cells at its sides.
    double width = 0.0;
    for (int k = 0; k < 3; ++k) width = std::max(width, mesh.box.hi[k] - mesh.box.lo[k]);
    cell_size_ = std::max(reach, width / kCells);
    cells_of_.reserve(mesh.at.size());
    for (const Vec3& p : mesh.at) cells_of_.push_back(cell_of(p));
    for (const std::uint32_t cell : cells_of_) ++first_[cell + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    sorted_.resize(mesh.at.size());
    std::vector<std::uint32_t> fill(first_.begin(), first_.end() - 1);
    for (std::uint32_t v = 0; v < mesh.at.size(); ++v) sorted_[fill[cells_of_[v]]++] = v;
    boxes_.resize(kCells * kCells * kCells);
    for (std::uint32_t v = 0; v < mesh.at.size(); ++v) boxes_[cells_of_[v]].add(mesh.normal[v]);
  }

  /// Calls mark(v) for every vertex that has one of another sheet within reach; also for those that stay where they
  /// are, since what moves is tested against their triangles.
  template <typename Mark>
  void find_close_sheets(const Mark& mark) const {
    constexpr double kChordSq = 2.0 - 2.0 * kOtherSheet;
    for (std::uint32_t cell = 0; cell < boxes_.size(); ++cell) {
      if (first_[cell] == first_[cell + 1]) continue;
      std::array<std::uint32_t, 27> near;
      std::size_t count = 0;
      NormalBox normals;
      const std::array<int, 3> at{static_cast<int>(cell) / (kCells * kCells),
                                  static_cast<int>(cell) / kCells % kCells, static_cast<int>(cell) % kCells};
      for (int i = std::max(0, at[0] - 1); i <= std::min(kCells - 1, at[0] + 1); ++i) {
        for (int j = std::max(0, at[1] - 1); j <= std::min(kCells - 1, at[1] + 1); ++j) {
          for (int k = std::max(0, at[2] - 1); k <= std::min(kCells - 1, at[2] + 1); ++k) {
            const auto other = static_cast<std::uint32_t>((i * kCells + j) * kCells + k);
            if (first_[other] == first_[other + 1]) continue;
            near[count++] = other;
            normals.add(boxes_[other]);
          }
        }
      }
      if (normals.most_chord_sq() < kChordSq) continue;
      for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
        if (has_other_sheet(sorted_[i], near.data(), count)) mark(sorted_[i]);
      }
    }
  }

 private:
  static constexpr int kCells = 24;

  std::uint32_t cell_of(const Vec3& p) const {
    int cell = 0;
    for (int k = 0; k < 3; ++k) cell = cell * kCells + slab_of((p[k] - mesh_.box.lo[k]) / cell_size_, kCells);
    return static_cast<std::uint32_t>(cell);
  }

  bool has_other_sheet(std::uint32_t v, const std::uint32_t* near, std::size_t count) const {
    const Vec3 n = as_vector(mesh_.normal[v]);
    for (std::size_t c = 0; c < count; ++c) {
      if (boxes_[near[c]].least_cosine(mesh_.normal[v]) >= static_cast<float>(kOtherSheet)) continue;
      for (std::uint32_t i = first_[near[c]]; i < first_[near[c] + 1]; ++i) {
        const std::uint32_t w = sorted_[i];
        if (dot(n, mesh_.normal[w]) >= kOtherSheet) continue;
        const Vec3 between = mesh_.at[w] - mesh_.at[v];
        const double reach = std::min(reach_, kReachInSizes * double(std::max(mesh_.size[v], mesh_.size[w])));
        if (dot(between, between) < reach * reach) return true;
      }
    }
    return false;
  }

  const BlockMesh& mesh_;
  double reach_;
  double cell_size_ = 0.0;
  std::vector<std::uint32_t> first_, sorted_, cells_of_;
  std::vector<NormalBox> boxes_;
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
  for (std::uint32_t t = 0; t < c.triangles(); ++t) spread(c.triangle(t));
  for (const Triangle& t : mesh.fixed) spread(t);
}

}  // namespace

SheetGuard::SheetGuard(BlockMesh& mesh, double largest, bool everywhere)
    : lo_(mesh.box.lo), everywhere_(everywhere), head_(kMostCells * kMostCells * kMostCells, -1) {
  double width = 0.0;
  for (int k = 0; k < 3; ++k) width = std::max(width, mesh.box.hi[k] - mesh.box.lo[k]);
  cells_per_angstrom_ = static_cast<float>(kMostCells / width);
  if (everywhere) {
    std::fill(mesh.is_guarded.begin(), mesh.is_guarded.end(), std::uint8_t{1});
  } else {
    mark_close_sheets(mesh, kReachInSizes * largest);
  }
  for (std::uint32_t t = 0; t < mesh.connectivity.triangles(); ++t) insert(mesh, t);
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

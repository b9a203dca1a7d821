#include "improve/bad_places.h"

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "core/sort_and_unite.h"

namespace gaussmesh {
namespace {

/// Triangles that a thread looks at in one go.
constexpr std::size_t kTrianglesAtOnce = 4096;

/// Of two neighbours that turn sharply one is turned at least half as far from the normal at each common corner.
/// With room for the rounding of normals.
const double kHalfASharpTurn = std::sqrt(0.5 * (1.0 + kSharpTurn)) + 1e-3;

/// An edge of one of the triangles that are looked at.
struct SideOf {
  std::uint32_t low, high, triangle;
  auto operator<=>(const SideOf&) const = default;
};

/// Adds the corners of neighbours that turn sharply against each other.
/// @param is_turned  by vertex, whether some triangle is turned far from the normal there
void add_sharp_edges(const WholeMesh& mesh, const std::vector<std::uint8_t>& is_turned, int threads,
                     std::vector<std::uint32_t>& bad) {
  std::vector<SideOf> sides =
      parallel_gather<SideOf>(mesh.triangles.size(), kTrianglesAtOnce, threads,
                              [&](std::size_t first, std::size_t last, std::vector<SideOf>& list) {
                                for (std::size_t number = first; number < last; ++number) {
                                  const Triangle& t = mesh.triangles[number];
                                  if (is_turned[t[0]] + is_turned[t[1]] + is_turned[t[2]] < 2) continue;
                                  for (int i = 0; i < 3; ++i) {
                                    const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
                                    if (is_turned[low] && is_turned[high])
                                      list.push_back({low, high, static_cast<std::uint32_t>(number)});
                                  }
                                }
                              });
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].low != sides[i - 1].low || sides[i].high != sides[i - 1].high) continue;
    const Triangle &s = mesh.triangles[sides[i - 1].triangle], &t = mesh.triangles[sides[i].triangle];
    if (!turn_sharply(area_normal(mesh, s), area_normal(mesh, t))) continue;
    bad.insert(bad.end(), s.begin(), s.end());
    bad.insert(bad.end(), t.begin(), t.end());
  }
}

}  // namespace

std::vector<std::uint32_t> find_bad_vertices(const WholeMesh& mesh, int threads) {
  const TriangleQuality good{kLeastSine, kHalfASharpTurn};
  struct Found {
    std::uint32_t vertex;
    bool is_turned;  ///< a triangle from the normal here; otherwise it has too small an angle
  };
  const auto found = parallel_gather<Found>(mesh.triangles.size(), kTrianglesAtOnce, threads,
                                            [&](std::size_t first, std::size_t last, std::vector<Found>& list) {
                                              for (std::size_t number = first; number < last; ++number) {
                                                const Triangle& t = mesh.triangles[number];
                                                if (is_at_least(mesh, t, good)) continue;
                                                const bool has_small_angle =
                                                    triangle_quality(mesh, t[0], t[1], t[2]).min_sine < kLeastSine;
                                                const Vec3 normal = area_normal(mesh, t);
                                                const double least = kHalfASharpTurn * length(normal);
                                                for (const std::uint32_t v : t) {
                                                  if (has_small_angle) list.push_back({v, false});
                                                  if (dot(normal, mesh.normal[v]) < least) list.push_back({v, true});
                                                }
                                              }
                                            });
  std::vector<std::uint32_t> bad;
  std::vector<std::uint8_t> is_turned(mesh.at.size(), 0);
  for (const Found& f : found) {
    if (f.is_turned) {
      is_turned[f.vertex] = 1;
    } else {
      bad.push_back(f.vertex);
    }
  }
  add_sharp_edges(mesh, is_turned, threads, bad);
  sort_and_unite(bad);
  return bad;
}

std::vector<std::uint32_t> find_bad_vertices(const BlockMesh& mesh, std::vector<std::uint32_t> at_sharp_edges) {
  const HalfEdgeMesh& c = mesh.connectivity;
  std::vector<std::uint32_t> bad = std::move(at_sharp_edges);
  for (std::uint32_t t = 0; t < c.triangles(); ++t) {
    if (!c.has_triangle(t) || triangle_quality(mesh, t).min_sine >= kLeastSine) continue;
    for (const std::uint32_t v : c.triangle(t)) bad.push_back(v);
  }
  sort_and_unite(bad);
  return bad;
}

std::vector<std::uint32_t> find_thin_vertices(const WholeMesh& mesh, int threads) {
  constexpr double kWantedSine = 0.5;  // 30 degrees
  std::vector<std::uint32_t> thin =
      parallel_gather<std::uint32_t>(mesh.triangles.size(), kTrianglesAtOnce, threads,
                                     [&](std::size_t first, std::size_t last, std::vector<std::uint32_t>& list) {
                                       for (std::size_t number = first; number < last; ++number) {
                                         const Triangle& t = mesh.triangles[number];
                                         if (triangle_quality(mesh, t[0], t[1], t[2]).min_sine < kWantedSine) {
                                           list.insert(list.end(), t.begin(), t.end());
                                         }
                                       }
                                     });
  sort_and_unite(thin);
  return thin;
}

std::vector<BadPlace> places_of(const MeshVertices& mesh, const std::vector<std::uint32_t>& vertices) {
  std::vector<BadPlace> places;
  places.reserve(vertices.size());
  for (const std::uint32_t v : vertices) places.push_back({mesh.at[v], double(mesh.size[v])});
  return places;
}

std::vector<BadPlace> places_round(const std::vector<std::uint32_t>& bad, const WholeMesh& mesh, double cell) {
  constexpr double kSmallInCells = 1.0 / 16.0;
  const auto small = static_cast<float>(kSmallInCells * cell);
  DisjointSets connected(mesh.at.size());
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t u = t[i], v = t[(i + 1) % 3];
      if (u < v && mesh.size[u] <= small && mesh.size[v] <= small) connected.unite(u, v);
    }
  }
  std::vector<std::uint8_t> is_bad(mesh.at.size(), 0);  // by the vertex that stands for those connected
  for (const std::uint32_t v : bad) is_bad[connected.find(v)] = 1;
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < mesh.at.size(); ++v) {
    if (is_bad[connected.find(v)]) vertices.push_back(v);
  }
  return places_of(mesh, vertices);
}

Box box_round(const BadPlace& place, const BoxSize& size) {
  return widened({place.at, place.at}, std::min(size.half_in_sizes * place.size, size.most));
}

std::vector<BadPlace> take_apart(std::vector<BadPlace>& places, const BoxSize& size) {
  double largest = 0.0;
  for (const BadPlace& place : places) {
    const Box box = box_round(place, size);
    largest = std::max(largest, box.hi[0] - box.lo[0]);
  }
  BoxGrid grid(largest);
  std::vector<BadPlace> taken;
  std::vector<Box> boxes;
  for (const BadPlace& place : places) {
    const Box box = box_round(place, size);
    bool is_free = true;
    BoxGrid::Reader(grid).visit(box, [&](std::uint32_t other) { is_free = is_free && !boxes_meet(box, boxes[other]); });
    if (!is_free) continue;
    grid.add(box, static_cast<std::uint32_t>(boxes.size()));
    boxes.push_back(box);
    taken.push_back(place);
  }
  BoxGrid::Reader reader(grid);
  std::erase_if(places, [&](const BadPlace& place) {
    bool is_taken = false;
    reader.visit({place.at, place.at}, [&](std::uint32_t box) { is_taken = is_taken || is_in(boxes[box], place.at); });
    return is_taken;
  });
  return taken;
}

}  // namespace gaussmesh

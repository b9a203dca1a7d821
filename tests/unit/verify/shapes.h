// Small closed meshes of known topology for the tests of the judge.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh::shapes {

/// A tetrahedron with a right angle at the origin, volume 1/6, faces turned outwards.
inline TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// The cube [-half, half]^3, each face cut in two.
inline TriangleMesh cube(double half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// An icosahedron, each face cut in four `levels` times, on the sphere of `radius`: 20 * 4^levels triangles.
inline TriangleMesh icosphere(int levels, double radius) {
  const double t = std::numbers::phi;
  TriangleMesh mesh{{{-1, t, 0},
                     {1, t, 0},
                     {-1, -t, 0},
                     {1, -t, 0},
                     {0, -1, t},
                     {0, 1, t},
                     {0, -1, -t},
                     {0, 1, -t},
                     {t, 0, -1},
                     {t, 0, 1},
                     {-t, 0, -1},
                     {-t, 0, 1}},
                    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, is_new] = middles.try_emplace(std::pair(std::min(a, b), std::max(a, b)),
                                                       static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) {
        const Point p = mesh.vertices[a];
        const Point q = mesh.vertices[b];
        mesh.vertices.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
      }
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (Point& p : mesh.vertices) {
    const double scale = radius / std::hypot(p[0], p[1], p[2]);
    for (double& x : p) x *= scale;
  }
  return mesh;
}

/// A torus around the z axis, `along` times `around` quadrilaterals cut in two.
inline TriangleMesh torus(std::uint32_t along, std::uint32_t around, double major_radius, double minor_radius) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < along; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      const double u = 2 * std::numbers::pi * i / along;
      const double v = 2 * std::numbers::pi * j / around;
      const double rho = major_radius + minor_radius * std::cos(v);
      mesh.vertices.push_back({rho * std::cos(u), rho * std::sin(u), minor_radius * std::sin(v)});
      const std::uint32_t i1 = (i + 1) % along, j1 = (j + 1) % around;
      const std::uint32_t a = i * around + j, b = i1 * around + j, c = i1 * around + j1, d = i * around + j1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

/// The same triangles turned inside out.
inline TriangleMesh turned(TriangleMesh mesh) {
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, const Point& by) {
  for (Point& p : mesh.vertices)
    for (int k = 0; k < 3; ++k) p[k] += by[k];
  return mesh;
}

/// Both meshes in one, vertices kept apart.
inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + offset, j + offset, k + offset});
  return a;
}

}  // namespace gaussmesh::shapes

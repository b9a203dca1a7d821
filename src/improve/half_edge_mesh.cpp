#include "improve/half_edge_mesh.h"

#include <algorithm>

namespace gaussmesh {

HalfEdgeMesh::HalfEdgeMesh(std::span<const Triangle> triangles, std::size_t vertex_count)
    : twin_(3 * triangles.size(), kNone), out_(vertex_count, kNone), inner_(vertex_count, 1) {
  corners_.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) corners_.insert(corners_.end(), t.begin(), t.end());
  // Half-edges whose twin has not come yet, in lists by the smaller end.
  std::vector<Index> waiting(vertex_count, kNone), next_waiting(corners_.size());
  for (Index h = 0; h < corners_.size(); ++h) {
    const Index u = from(h), v = to(h);
    out_[u] = h;
    Index* at = &waiting[std::min(u, v)];
    while (*at != kNone && !(from(*at) == v && to(*at) == u)) at = &next_waiting[*at];
    if (*at != kNone) {
      link(h, *at);
      *at = next_waiting[*at];
    } else {
      next_waiting[h] = kNone;
      *at = h;
    }
  }
  for (Index h = 0; h < corners_.size(); ++h) {
    if (twin_[h] == kNone) inner_[from(h)] = inner_[to(h)] = 0;
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (out_[v] == kNone) inner_[v] = 0;
  }
}

int HalfEdgeMesh::valence(Index v) const {
  int count = 0;
  visit_star(v, [&](Index) { ++count; });
  return count;
}

bool HalfEdgeMesh::are_neighbours(Index u, Index v) const {
  bool found = false;
  visit_star(u, [&](Index h) { found = found || to(h) == v; });
  return found;
}

void HalfEdgeMesh::set_triangle(Index t, Index a, Index b, Index c) {
  corners_[3 * t] = a;
  corners_[3 * t + 1] = b;
  corners_[3 * t + 2] = c;
  out_[a] = 3 * t;
  out_[b] = 3 * t + 1;
  out_[c] = 3 * t + 2;
}

void HalfEdgeMesh::link(Index h, Index g) {
  twin_[h] = g;
  if (g != kNone) twin_[g] = h;
}

void HalfEdgeMesh::remove_triangle(Index t) {
  for (Index h = 3 * t; h < 3 * t + 3; ++h) corners_[h] = twin_[h] = kNone;
}

bool HalfEdgeMesh::can_flip(Index h) const {
  const Index c = opposite(h), d = opposite(twin_[h]);
  if (!inner_[from(h)] || !inner_[to(h)] || c == d || !(inner_[c] || inner_[d])) return false;
  if (inner_[c] ? are_neighbours(c, d) : are_neighbours(d, c)) return false;
  return valence(from(h)) > 3 && valence(to(h)) > 3;
}

void HalfEdgeMesh::flip(Index h) {
  const Index g = twin_[h], s = h / 3, t = g / 3;
  const Index a = from(h), b = to(h), c = opposite(h), d = opposite(g);
  const Index ad = twin_[next(g)], db = twin_[previous(g)], bc = twin_[next(h)], ca = twin_[previous(h)];
  set_triangle(s, a, d, c);
  set_triangle(t, d, b, c);
  link(3 * s, ad);
  link(3 * s + 1, 3 * t + 2);
  link(3 * s + 2, ca);
  link(3 * t, db);
  link(3 * t + 1, bc);
}

bool HalfEdgeMesh::can_collapse(Index h) const {
  const Index u = from(h), v = to(h), c = opposite(h), d = opposite(twin_[h]);
  if (!inner_[u] || !inner_[v] || !inner_[c] || !inner_[d]) return false;
  if (c == d || valence(c) <= 3 || valence(d) <= 3) return false;
  std::array<Index, 16> round_v;
  std::size_t count = 0;
  visit_star(v, [&](Index g) {
    if (count < round_v.size()) round_v[count] = to(g);
    ++count;
  });
  const bool all_here = count <= round_v.size();
  int common = 0;
  visit_star(u, [&](Index g) {
    const Index w = to(g);
    if (w == v) return;
    common += all_here ? std::find(round_v.begin(), round_v.begin() + count, w) != round_v.begin() + count
                       : are_neighbours(v, w);
  });
  return common == 2;
}

void HalfEdgeMesh::collapse(Index h) {
  const Index g = twin_[h], u = from(h), v = to(h), c = opposite(h), d = opposite(g);
  const Index vc = twin_[next(h)], cu = twin_[previous(h)], ud = twin_[next(g)], dv = twin_[previous(g)];
  std::array<Index, 64> star;
  std::size_t count = 0;
  std::vector<Index> long_star;
  visit_star(u, [&](Index k) {
    if (count < star.size()) {
      star[count++] = k;
    } else {
      long_star.push_back(k);
    }
  });
  for (std::size_t i = 0; i < count; ++i) corners_[star[i]] = v;
  for (Index k : long_star) corners_[k] = v;
  remove_triangle(h / 3);
  remove_triangle(g / 3);
  link(vc, cu);  // vc runs from c to v, and cu, which ran from u to c, now from v to c
  link(ud, dv);
  out_[u] = kNone;
  out_[v] = cu;
  out_[c] = vc;
  out_[d] = ud;
}

HalfEdgeMesh::Index HalfEdgeMesh::split(Index h) {
  const Index g = twin_[h], s = h / 3, t = g / 3;
  const Index a = from(h), b = to(h), c = opposite(h), d = opposite(g);
  const Index ad = twin_[next(g)], db = twin_[previous(g)], bc = twin_[next(h)], ca = twin_[previous(h)];
  const Index m = vertices(), s2 = triangles(), t2 = s2 + 1;
  corners_.resize(corners_.size() + 6, kNone);
  twin_.resize(twin_.size() + 6, kNone);
  out_.push_back(kNone);
  inner_.push_back(1);
  set_triangle(s, a, m, c);
  set_triangle(s2, m, b, c);
  set_triangle(t, m, a, d);
  set_triangle(t2, b, m, d);
  link(3 * s, 3 * t);
  link(3 * s + 1, 3 * s2 + 2);
  link(3 * s + 2, ca);
  link(3 * s2, 3 * t2);
  link(3 * s2 + 1, bc);
  link(3 * t + 1, ad);
  link(3 * t + 2, 3 * t2 + 1);
  link(3 * t2 + 2, db);
  return m;
}

}  // namespace gaussmesh

#include "field/gaussian_field.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gaussmesh {
namespace {

constexpr std::uint32_t kLeafSize = 16;

double distance_sq(const Box& a, const Box& b) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double g = std::max(0.0, std::max(a.lo[k] - b.hi[k], b.lo[k] - a.hi[k]));
    sum += g * g;
  }
  return sum;
}

}  // namespace

GaussianField::GaussianField(const std::vector<Atom>& atoms, double decay, double isovalue) : decay_(decay) {
  const double log_c = std::log(isovalue);
  std::vector<WeightedCentre> sorted;
  sorted.reserve(atoms.size());
  for (const Atom& a : atoms) sorted.push_back({{a.x, a.y, a.z}, decay * a.radius * a.radius - log_c});
  std::sort(sorted.begin(), sorted.end(), [](const WeightedCentre& a, const WeightedCentre& b) {
    return std::tie(a.centre, a.w) < std::tie(b.centre, b.w);
  });
  build(sorted, 0, static_cast<std::uint32_t>(sorted.size()));
  for (auto* list : {&atoms_.x, &atoms_.y, &atoms_.z, &atoms_.w}) list->reserve(sorted.size());
  for (const WeightedCentre& a : sorted) {
    atoms_.x.push_back(a.centre[0]);
    atoms_.y.push_back(a.centre[1]);
    atoms_.z.push_back(a.centre[2]);
    atoms_.w.push_back(a.w);
  }

  // Farther than `reach` from every centre each of n atoms has phi_i / c < 1 / n.
  const double reach_sq = (nodes_[0].w_max + std::log(static_cast<double>(size()) + 1.0)) / decay;
  const double reach = std::sqrt(std::max(0.0, reach_sq)) * (1.0 + 1e-9) + 1e-6;
  bounds_ = nodes_[0].box;
  for (int k = 0; k < 3; ++k) {
    bounds_.lo[k] -= reach;
    bounds_.hi[k] += reach;
  }
}

std::uint32_t GaussianField::build(std::vector<WeightedCentre>& atoms, std::uint32_t first, std::uint32_t last) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.first = first;
  node.last = last;
  node.box = {atoms[first].centre, atoms[first].centre};
  node.w_max = atoms[first].w;
  for (std::uint32_t i = first; i < last; ++i) {
    node.w_max = std::max(node.w_max, atoms[i].w);
    node.w_size = std::max(node.w_size, std::abs(atoms[i].w));
    for (int k = 0; k < 3; ++k) {
      node.box.lo[k] = std::min(node.box.lo[k], atoms[i].centre[k]);
      node.box.hi[k] = std::max(node.box.hi[k], atoms[i].centre[k]);
    }
  }
  node.w_all = node.w_max + std::log(static_cast<double>(last - first));
  nodes_.push_back(node);
  if (last - first <= kLeafSize) return index;

  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (node.box.hi[k] - node.box.lo[k] > node.box.hi[axis] - node.box.lo[axis]) axis = k;
  }
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(atoms.begin() + first, atoms.begin() + middle, atoms.begin() + last,
                   [axis](const WeightedCentre& a, const WeightedCentre& b) {
                     return std::tie(a.centre[axis], a.centre, a.w) < std::tie(b.centre[axis], b.centre, b.w);
                   });
  build(atoms, first, middle);
  const std::uint32_t right = build(atoms, middle, last);
  nodes_[index].right = right;
  return index;
}

void GaussianField::collect_near(const Box& box, NearAtoms& near, double cut) const {
  near.clear(cut);
  thread_local std::vector<std::uint32_t> kept;
  thread_local std::vector<double> exponents;  // of the atoms in the leaves visited
  std::size_t count = 0, visited = 0;
  double visited_w = 0.0;
  std::uint32_t stack[64];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::uint32_t index = stack[--top];
    const Node& node = nodes_[index];
    const double node_sq = distance_sq(node.box, box);
    if (node.w_all - decay_ * node_sq < -cut) {
      near.add_to_tail(node.last - node.first, node.w_max, node_sq, decay_);
    } else if (node.right != 0) {
      stack[top++] = node.right;
      stack[top++] = index + 1;
    } else {
      const std::uint32_t members = node.last - node.first;
      if (exponents.size() < visited + kLeafSize) exponents.resize(2 * (visited + kLeafSize));
      double* const exponent = exponents.data() + visited;
      largest_exponents(atoms_, node.first, members, box, decay_, exponent);
      if (kept.size() < count + kLeafSize) kept.resize(2 * (count + kLeafSize));
      for (std::uint32_t i = 0; i < members; ++i) {
        kept[count] = node.first + i;
        count += exponent[i] >= -cut;
      }
      visited += members;
      visited_w = std::max(visited_w, node.w_size);
    }
  }
  if (count < visited) near.add_to_tail(exponents.data(), visited, visited_w, decay_);
  near.take(atoms_, kept, count);
}

}  // namespace gaussmesh

#include "field/gaussian_field.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gaussmesh {
namespace {

constexpr std::uint32_t kLeafSize = 8;

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
  sorted_.reserve(atoms.size());
  for (const Atom& a : atoms) sorted_.push_back({{a.x, a.y, a.z}, decay * a.radius * a.radius - log_c});
  std::sort(sorted_.begin(), sorted_.end(), [](const WeightedCentre& a, const WeightedCentre& b) {
    return std::tie(a.centre, a.w) < std::tie(b.centre, b.w);
  });
  build(0, static_cast<std::uint32_t>(sorted_.size()));

  // Farther than `reach` from every centre each of n atoms has phi_i / c < 1 / n.
  const double reach_sq = (nodes_[0].w_max + std::log(static_cast<double>(sorted_.size()) + 1.0)) / decay;
  const double reach = std::sqrt(std::max(0.0, reach_sq)) * (1.0 + 1e-9) + 1e-6;
  bounds_ = nodes_[0].box;
  for (int k = 0; k < 3; ++k) {
    bounds_.lo[k] -= reach;
    bounds_.hi[k] += reach;
  }
}

std::uint32_t GaussianField::build(std::uint32_t first, std::uint32_t last) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.first = first;
  node.last = last;
  node.box = {sorted_[first].centre, sorted_[first].centre};
  node.w_max = sorted_[first].w;
  for (std::uint32_t i = first; i < last; ++i) {
    node.w_max = std::max(node.w_max, sorted_[i].w);
    for (int k = 0; k < 3; ++k) {
      node.box.lo[k] = std::min(node.box.lo[k], sorted_[i].centre[k]);
      node.box.hi[k] = std::max(node.box.hi[k], sorted_[i].centre[k]);
    }
  }
  nodes_.push_back(node);
  if (last - first <= kLeafSize) return index;

  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (node.box.hi[k] - node.box.lo[k] > node.box.hi[axis] - node.box.lo[axis]) axis = k;
  }
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(sorted_.begin() + first, sorted_.begin() + middle, sorted_.begin() + last,
                   [axis](const WeightedCentre& a, const WeightedCentre& b) {
                     return std::tie(a.centre[axis], a.centre, a.w) < std::tie(b.centre[axis], b.centre, b.w);
                   });
  build(first, middle);
  const std::uint32_t right = build(middle, last);
  nodes_[index].right = right;
  return index;
}

void GaussianField::collect_near(const Box& box, NearAtoms& near, double cut) const {
  near.clear();
  near.cut = cut;
  std::size_t left_out = 0;
  double left_out_w = -kEmptyLo;
  std::uint32_t stack[64];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::uint32_t index = stack[--top];
    const Node& node = nodes_[index];
    const double node_sq = distance_sq(node.box, box);
    if (node.w_max - decay_ * node_sq < -cut) {
      near.add_to_tail(node.last - node.first, node.w_max, node_sq, decay_);
    } else if (node.right != 0) {
      stack[top++] = node.right;
      stack[top++] = index + 1;
    } else {
      for (std::uint32_t i = node.first; i < node.last; ++i) {
        const WeightedCentre& a = sorted_[i];
        const double atom_sq = distance_sq({a.centre, a.centre}, box);
        if (a.w - decay_ * atom_sq < -cut) {
          ++left_out;
          left_out_w = std::max(left_out_w, std::abs(a.w));
        } else {
          near.add(a.centre[0], a.centre[1], a.centre[2], a.w);
        }
      }
    }
  }
  // As in NearAtoms::restrict_from(): rounding of the exponents.
  const double slack = left_out > 0 ? 4e-15 * (2.0 * left_out_w + cut) + 1e-12 : 0.0;
  near.add_cut_to_tail(static_cast<double>(left_out), left_out_w, cut - slack, decay_);
}

}  // namespace gaussmesh

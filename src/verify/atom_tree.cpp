#include "verify/atom_tree.h"

#include <array>
#include <cmath>

#include "verify/morton_order.h"

namespace gaussmesh::verify {
namespace {

Point centre_of(const Atom& atom) { return {atom.x, atom.y, atom.z}; }

double squared(double x) { return x * x; }

}  // namespace

AtomTree::AtomTree(const std::vector<Atom>& atoms) {
  std::vector<Group> groups;
  order_ = morton_order(atoms.size(), [&](std::uint32_t number) { return centre_of(atoms[number]); });
  for (const std::uint32_t i : order_) {
    atoms_.push_back(atoms[i]);
    groups.push_back(group_of(atoms[i]));
  }
  do {
    groups = group(groups);
    levels_.push_back(groups);
  } while (groups.size() > 1);
}

AtomTree::Group AtomTree::group_of(const Atom& atom) {
  return {{centre_of(atom), centre_of(atom)}, squared(atom.radius)};
}

std::vector<AtomTree::Group> AtomTree::group(const std::vector<Group>& members) {
  std::vector<Group> groups((members.size() + kFanOut - 1) / kFanOut);
  for (std::size_t i = 0; i < members.size(); ++i) groups[i / kFanOut].include(members[i]);
  return groups;
}

/// Goes first to the groups that promise most, and not to those that promise less than is already found.
AtomTree::Best AtomTree::best_below(std::size_t level, std::size_t index, const BoundingBox& place, Best best) const {
  if (level == 0) {
    const double exponent = largest_exponent(group_at(0, index), place);
    return exponent > best.exponent ? Best{exponent, index} : best;
  }
  std::array<Best, kFanOut> children;
  std::size_t count = 0;
  const std::size_t end = std::min((index + 1) * kFanOut, size_of(level - 1));
  for (std::size_t child = index * kFanOut; child < end; ++child)
    children[count++] = {largest_exponent(group_at(level - 1, child), place), child};
  std::sort(children.begin(), children.begin() + count,
            [](const Best& a, const Best& b) { return a.exponent > b.exponent; });
  for (std::size_t i = 0; i < count && children[i].exponent > best.exponent; ++i)
    best = best_below(level - 1, children[i].atom, place, best);
  return best;
}

std::uint32_t AtomTree::nearest(const Point& point) const {
  return order_[best_below(levels_.size(), 0, {point, point}, {}).atom];
}

/// The lesser of `least` and the smallest |point - x_i|^2 / r_i^2 in the group. It begins with the atom of the
/// largest exponent, which is nearly always the one.
double AtomTree::relative_distance_sq_below(std::size_t level, std::size_t index, const Point& point,
                                            double least) const {
  const Group group = group_at(level, index);
  const double distance_sq = group.radius_sq - largest_exponent(group, {point, point});
  if (!(group.radius_sq > 0.0) || distance_sq >= least * group.radius_sq) return least;
  if (level == 0) return distance_sq / group.radius_sq;
  const std::size_t end = std::min((index + 1) * kFanOut, size_of(level - 1));
  for (std::size_t child = index * kFanOut; child < end; ++child)
    least = relative_distance_sq_below(level - 1, child, point, least);
  return least;
}

double AtomTree::least_relative_distance(const Point& point) const {
  const std::size_t likely = best_below(levels_.size(), 0, {point, point}, {}).atom;
  const double first = relative_distance_sq_below(0, likely, point, std::numeric_limits<double>::infinity());
  return std::sqrt(relative_distance_sq_below(levels_.size(), 0, point, first));
}

/// A lower bound of the largest exponent at any point of `place`: that of the atom which is largest at its middle.
double AtomTree::least_largest_exponent(const BoundingBox& place) const {
  Point middle{};
  for (int k = 0; k < 3; ++k) middle[k] = 0.5 * place.low[k] + 0.5 * place.high[k];
  const Atom& atom = atoms_[best_below(levels_.size(), 0, {middle, middle}, {}).atom];
  const Point centre = centre_of(atom);
  double distance_sq = 0.0;
  for (int k = 0; k < 3; ++k)
    distance_sq += squared(std::max(std::abs(place.low[k] - centre[k]), std::abs(place.high[k] - centre[k])));
  return squared(atom.radius) - distance_sq;
}

}  // namespace gaussmesh::verify

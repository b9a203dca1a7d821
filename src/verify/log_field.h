// log phi and its gradient, evaluated directly: the judge's own view of the Gaussian surface.
#pragma once

#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "verify/atom_tree.h"
#include "verify/bounding_box.h"

namespace gaussmesh::verify {

/// log phi at a point.
struct LogValue {
  double value = 0.0;
  Point gradient{};        ///< of log phi, 1/A
  double curvature = 0.0;  ///< bound of the size of its second derivative there in any direction, 1/A^2
};

/// A bound of the size of the second derivative of log phi at x in any direction, from the means of |x - x_i|^2 and
/// of x - x_i with the atoms' shares of phi for weights. The second derivatives are 4 decay^2 C - 2 decay, C the
/// covariance of the x - x_i; what is largest of it is at most its trace.
double curvature_bound(double decay, double mean_square, const Point& mean);

/// Evaluates log phi, phi(x) = sum_i exp(-decay (|x - x_i|^2 - r_i^2)), point after point near each other.
///
/// The atoms that count round the last point are kept, so that the tree is asked again only once points have moved
/// on. Those left out have less than 1e-13 of phi, all together. Nothing overflows whatever the radii, since the
/// largest exponent is taken out of the sum. One for each thread; the tree must outlive it.
class LogField {
 public:
  LogField(const AtomTree& tree, double decay);

  LogValue at(const Point& x);

 private:
  void gather_round(const Point& x);

  const AtomTree& tree_;
  double decay_;
  double range_;                   // exponents that far below the largest do not count
  BoundingBox place_;              // where `near_` serves
  std::vector<Atom> near_;         // the atoms that count there
  std::vector<double> exponents_;  // theirs, at the point in hand
};

}  // namespace gaussmesh::verify

// The field in one block of space, for many evaluations near the surface.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/vectors.h"
#include "field/gaussian_field.h"
#include "field/point_value.h"

namespace gaussmesh {

/// log(phi / c) at a point with its first and second derivatives.
struct FieldJet {
  double value = 0.0;
  Vec3 gradient{};                  ///< 1/A
  std::array<double, 6> hessian{};  ///< 1/A^2: xx, yy, zz, xy, xz, yz
};

/// A place on the surface.
struct Place {
  Vec3 at{};        ///< A, rounded to whole units
  Normal normal{};  ///< into the solvent
};

/// How near to the surface a vertex must come.
enum class Accuracy {
  kRough,  ///< within some 1e-6 A, which does while vertices still move; see settle_vertices()
  kExact,  ///< within a rounding of its coordinates
};

/// Atoms in single precision, relative to a place near them; filled up to whole SIMD vectors.
struct RoughAtoms {
  Vec3 origin{};                  ///< A
  std::vector<float> x, y, z, w;  ///< centres (A) and log-weights
};

/// The atoms of a block in lists for small cells, each made when it is first asked for. Not thread-safe: one for each
/// block. What is left out of the sums is below e^-24 (4e-11) of the isovalue an atom, or e^-16 (1e-7) where rough
/// places are asked for, which are found in single precision; less where the field hardly changes. No bounds are kept,
/// since the verdict on a finished mesh does not come from here.
class BlockField {
 public:
  BlockField(const GaussianField& field, const Box& box);

  /// The point lies in the box, or near it. Good to some 1e-5, which does for the sizes of triangles.
  FieldJet jet(const Vec3& point);

  /// Newton's method on log phi along its gradient, from a point near the surface.
  /// @return nothing if that leads farther than `farthest` (A) away
  /// Cost: one or two sums over the atoms nearby.
  std::optional<Place> project(const Vec3& point, double farthest, Accuracy accuracy = Accuracy::kExact);

  /// The same on the line through the point, which need not be steep: exact, and nothing where the line does not
  /// lead to the surface on one way.
  std::optional<Place> project_along(const Vec3& direction, const Vec3& point, double farthest);

 private:
  static constexpr int kMostCells = 16;  ///< along an axis
  static constexpr int kGroupCells = 4;  ///< along an axis: their lists come from one list for all of them
  static constexpr int kMostGroups = kMostCells / kGroupCells;

  std::array<int, 3> cell_of(const Vec3& point) const;
  std::size_t number_of(const std::array<int, 3>& cell) const;
  /// Of some cells along each axis, from a first one on.
  Box box_around(const std::array<int, 3>& cell, int cells) const;
  /// Those that count in the group of a cell.
  const NearAtoms& atoms_around(const std::array<int, 3>& cell);
  const NearAtoms& atoms_at(const Vec3& point);
  const RoughAtoms& rough_atoms_at(const Vec3& point);
  PointValue evaluate_roughly(const Vec3& point);
  PointValue evaluate_exactly(const Vec3& point);

  const GaussianField& field_;
  double decay_;
  Box box_;
  double cell_size_;
  std::array<int, 3> cells_{};
  bool is_rough_usable_;  ///< no log-weight is so large that single precision would lose the surface
  NearAtoms atoms_, some_;
  std::vector<NearAtoms> group_lists_;   ///< by group; no atoms: not yet made
  std::vector<NearAtoms> lists_;         ///< by cell, the same; given back when there are too many
  std::size_t lists_made_ = 0;           ///< since then
  std::vector<RoughAtoms> rough_lists_;  ///< the same
  NearAtoms fine_;                       ///< more atoms for the cell of this number, where those left out are felt
  std::optional<std::size_t> fine_number_;
};

/// Principal curvatures of a surface (1/A), in absolute value.
struct Curvatures {
  double larger = 0.0;
  double smaller = 0.0;
};

/// Of the level set through the jet's point.
Curvatures principal_curvatures(const FieldJet& jet);

}  // namespace gaussmesh

// What bounds prove of the surface in ONE rectangle of the lattice.
//
// Following the curves in it is face_tracer.h.
#pragma once

#include <array>
#include <cstdint>

#include "field/local_model.h"

namespace gaussmesh {

/// What bounds say of the section of the surface with a face.
enum FaceCertificate : std::uint8_t {
  kFaceUncertified = 0,
  kFaceAlongFirst = 1,     ///< single-valued along the first axis of the face ...
  kFaceAlongSecond = 2,    ///< ... along the second; both bits may be set
  kFaceEmpty = 4,          ///< no surface in the closed face
  kFaceNoClosedCurve = 8,  ///< every curve of the section ends on the boundary
};

/// Certificate of a face from a model over a box that contains it.
FaceCertificate certify_face(const LocalModel& model, int axis, const Box& face);

/// What follows for the faces of a cell across `axis` from CellCertificate::single_axes.
inline FaceCertificate certificate_in_face(unsigned single_axes, int axis) {
  return static_cast<FaceCertificate>((single_axes >> first_axis(axis) & 1) * kFaceAlongFirst |
                                      (single_axes >> second_axis(axis) & 1) * kFaceAlongSecond);
}

/// The four parts of a face across `axis`.
using Quarters = std::array<Box, 4>;
Quarters quarters_of(const Box& face, int axis);

/// Proves more of a face, looking closer through parts of it.
class FaceProver {
 public:
  explicit FaceProver(double decay) : decay_(decay) {}

  /// Goes on to a face across `axis`.
  /// @param atoms  collected for a box around it; they stay as they are as long as it is asked about
  void move_to(const NearAtoms& atoms, int axis) {
    atoms_ = &atoms;
    axis_ = axis;
  }

  /// Whether phi passes c as the direction says wherever it does in the box of the model, a part of the face.
  bool proves(const LocalModel& model, const Direction& along) { return proves(model, along, kHalvings); }

  /// In the part that ended the last proof that failed.
  const Vec3& refuting_gradient() const { return refuting_gradient_; }

  /// Whether every curve in the box of the model ends on its boundary.
  ///
  /// Along a closed curve the gradient in the plane would turn once round, so that it would point every way. It does
  /// not where it misses one and the same way, of those along the axes, in all parts of the box, wherever phi = c;
  /// other ways it may point anywhere.
  bool has_no_closed_curve(const LocalModel& model) const;

 private:
  static constexpr int kHalvings = 3;  ///< how often a face is halved for a proof

  bool proves(const LocalModel& model, const Direction& along, int depth);
  /// Whether the gradient misses a way in all quarters, of which `proofs` tells what the model itself shows.
  bool is_missed(const Quarters& quarters, const PartProofs& proofs, unsigned way, int depth) const;

  double decay_;
  const NearAtoms* atoms_ = nullptr;
  int axis_ = 0;
  Vec3 refuting_gradient_{};
};

}  // namespace gaussmesh

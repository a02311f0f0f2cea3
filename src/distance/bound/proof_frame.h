#pragma once

#include "box_pair_bounds.h"
#include "certificate.h"
#include "distance/kernels/pair_frame.h"

namespace concave_distance::detail {

/// Says where both bodies of one proof are, centred at the origins of their hierarchies, and how far its
/// bounds may be off.
struct ProofFrame : PairFrame {
  ProofFrame(const BodyMesh& body_a, const BodyMesh& body_b, const Eigen::Isometry3d& pose)
      : PairFrame(body_a, body_b, pose, body_a.hierarchy().origin(), body_b.hierarchy().origin()),
        turned(rotation.transpose()),
        scale(body_a.hierarchy().reach() + body_b.hierarchy().reach() + offset.norm(), kBoundError),
        error(kProofError * proofScale(body_a, body_b, pose)) {}

  /// Bounds the rounding of one bound relative to the scale; it is a part of kProofError.
  static constexpr double kBoundError = 0x1.0p-48;  // 16 machine epsilons

  Eigen::Matrix3d turned;  ///< from A's axes to B's
  BoundScale scale;
  double error;  ///< metres, of the whole proof
};

}  // namespace concave_distance::detail

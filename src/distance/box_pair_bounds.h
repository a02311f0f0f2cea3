#pragma once

#include <Eigen/Core>

#include "mesh/trees/bounding_volume_hierarchy.h"

namespace concave_distance::detail {

/// One number for each of a node's children.
using Lanes = Eigen::Array<double, BoundingVolumeHierarchy::kWidth, 1>;
using FloatLanes = Eigen::Array<float, BoundingVolumeHierarchy::kWidth, 1>;

inline Lanes lanes(const double* values) {
  return Eigen::Map<const Lanes, Eigen::Aligned16>(values);
}

/// Of each lane's point, [coordinate][lane].
inline Lanes along(const Eigen::Vector3d& direction,
                   const double (&point)[3][BoundingVolumeHierarchy::kWidth]) {
  return direction.x() * lanes(point[0]) + direction.y() * lanes(point[1]) + direction.z() * lanes(point[2]);
}

/// How far each of the node's boxes reaches from its centre along a unit vector.
inline Lanes reachAlong(const Eigen::Vector3d& direction, const BoundingVolumeHierarchy::Node& node) {
  return lanes(node.half[0]) * along(direction, node.axes[0]).abs() +
         lanes(node.half[1]) * along(direction, node.axes[1]).abs() +
         lanes(node.half[2]) * along(direction, node.axes[2]).abs();
}

inline double reachAlong(const Eigen::Vector3d& direction, const OrientedBox& box) {
  return (box.axes.transpose() * direction).cwiseAbs().dot(box.half);
}

/// A box as the other tree's nodes are compared with it: in their frame, for the direction along, and once
/// more in single precision with lengths relative to the scene's scale.
struct ComparedBox {
  ComparedBox() = default;
  ComparedBox(const OrientedBox& box_in_node_frame, double inverse_scale)
      : box(box_in_node_frame),
        axes(box.axes.cast<float>()),
        half((box.half * inverse_scale).cast<float>()) {}

  OrientedBox box;
  Eigen::Matrix3f axes;
  Eigen::Vector3f half;
};

/// What every bound of one query shares.
struct BoundScale {
  BoundScale(double metres, double relative_slack)
      : scale(metres), inverse_scale(1.0 / metres), slack(relative_slack * metres) {}

  double scale;          ///< metres, no smaller than any distance between points of the two bodies
  double inverse_scale;  ///< of it
  double slack;          ///< metres: rounding of a bound in double precision
  /// The same in single precision, relative to `scale`: 64 of its machine epsilons. No term of a bound errs
  /// by more than 4 of them (an axis by 1, a product by 1, an offset by 1, the sum by 1), and the weights of
  /// a bound's 12 terms add up to less than 16.
  static constexpr float kFloatSlack = 0x1.0p-17F;
};

/// Squared lower bounds of the distances between `box` and each of the node's boxes; square metres.
/// Separating axes: `direction` (unit, node's frame, from `box` towards the node) in double precision, which
/// decides even ties between parallel walls; and in single precision the line of the centres and the axes of
/// both boxes, where what separates along the three axes of one box adds up as in a vector. When `direction`
/// alone separates all by `enough` (metres) the others are not looked at.
inline Lanes squaredBounds(const BoundingVolumeHierarchy::Node& node, const ComparedBox& compared,
                           const Eigen::Vector3d& direction, const BoundScale& scale, double enough) {
  const OrientedBox& box = compared.box;
  const Lanes dx = lanes(node.centre[0]) - box.centre.x();
  const Lanes dy = lanes(node.centre[1]) - box.centre.y();
  const Lanes dz = lanes(node.centre[2]) - box.centre.z();
  Lanes separation = direction.x() * dx + direction.y() * dy + direction.z() * dz -
                     (reachAlong(direction, box) + scale.slack) - reachAlong(direction, node);
  separation = separation.max(0.0);
  const Lanes squared = separation.square();
  if (separation.minCoeff() >= enough) return squared;

  constexpr float kSlack = BoundScale::kFloatSlack;
  const FloatLanes fx = (dx * scale.inverse_scale).cast<float>();
  const FloatLanes fy = (dy * scale.inverse_scale).cast<float>();
  const FloatLanes fz = (dz * scale.inverse_scale).cast<float>();
  const FloatLanes squared_gap = fx * fx + fy * fy + fz * fz;
  FloatLanes along_centres = squared_gap;
  FloatLanes along_box[3];
  for (int k = 0; k < 3; ++k) {
    const FloatLanes offset =
        (compared.axes(0, k) * fx + compared.axes(1, k) * fy + compared.axes(2, k) * fz).abs();
    along_centres -= offset * compared.half[k];
    along_box[k] = offset - compared.half[k];
  }
  FloatLanes sum_node = FloatLanes::Zero();
  for (int i = 0; i < 3; ++i) {
    const FloatLanes x = lanes(node.axes[i][0]).cast<float>();
    const FloatLanes y = lanes(node.axes[i][1]).cast<float>();
    const FloatLanes z = lanes(node.axes[i][2]).cast<float>();
    const FloatLanes half = (lanes(node.half[i]) * scale.inverse_scale).cast<float>();
    const FloatLanes offset = (x * fx + y * fy + z * fz).abs();
    along_centres -= offset * half;
    FloatLanes along_node = offset - half;
    for (int k = 0; k < 3; ++k) {
      const FloatLanes cosine =
          (x * compared.axes(0, k) + y * compared.axes(1, k) + z * compared.axes(2, k)).abs();
      along_node -= cosine * compared.half[k];
      along_box[k] -= cosine * half;
    }
    sum_node += (along_node - kSlack).max(0.0F).square();
  }
  const FloatLanes sum_box = (along_box[0] - kSlack).max(0.0F).square() +
                             (along_box[1] - kSlack).max(0.0F).square() +
                             (along_box[2] - kSlack).max(0.0F).square();
  // The gap is at most 1 in these units, so that the slack need not be multiplied with it. Where the centres
  // fall together nothing is left above.
  const FloatLanes centres = (along_centres - kSlack).max(0.0F);
  const FloatLanes sum_centres = centres.square() / squared_gap.max(0x1.0p-100F);
  const FloatLanes best = sum_node.max(sum_box).max(sum_centres);
  return squared.max(best.cast<double>() * (scale.scale * scale.scale * (1.0 - 0x1.0p-20)));
}

}  // namespace concave_distance::detail

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

/// A box as the other tree's nodes are compared with it: in their frame, lengths relative to the scene's
/// scale, in single precision.
struct ComparedBox {
  ComparedBox() = default;
  ComparedBox(const OrientedBox& box_in_node_frame, double inverse_scale)
      : centre((box_in_node_frame.centre * inverse_scale).cast<float>()),
        axes(box_in_node_frame.axes.cast<float>()),
        half((box_in_node_frame.half * inverse_scale).cast<float>()) {}

  Eigen::Vector3f centre;
  Eigen::Matrix3f axes;
  Eigen::Vector3f half;
};

/// What every bound of one query shares.
struct BoundScale {
  BoundScale(double metres, double relative_slack)
      : scale(metres), inverse_scale(1.0 / metres), squared_scale(metres * metres), slack(relative_slack * metres) {}

  double scale;          ///< metres, no smaller than any distance between points of the two bodies
  double inverse_scale;  ///< of it
  double squared_scale;
  double slack;          ///< metres: rounding of a bound in double precision
  /// The same in single precision, relative to `scale`: 64 of its machine epsilons. No term of a bound errs
  /// by more than 4 of them (an axis by 1, a product by 1, an offset by 1, the sum by 1), and the weights of
  /// a bound's 12 terms add up to less than 16.
  static constexpr float kFloatSlack = 0x1.0p-17F;
};

inline FloatLanes lanes(const float* values) {
  return Eigen::Map<const FloatLanes, Eigen::Aligned16>(values);
}

/// Squared lower bounds of the distances between `box` and each of the node's boxes, relative to the squared
/// scale. Separating axes: the line of the centres and the axes of both boxes, where what separates along the
/// three axes of one box adds up as in a vector. `unit`: the reach of the node's body relative to the scale.
inline FloatLanes squaredBounds(const BoundingVolumeHierarchy::SingleNode& node, const ComparedBox& box,
                                float unit) {
  constexpr float kSlack = BoundScale::kFloatSlack;
  const FloatLanes fx = lanes(node.centre[0]) * unit - box.centre.x();
  const FloatLanes fy = lanes(node.centre[1]) * unit - box.centre.y();
  const FloatLanes fz = lanes(node.centre[2]) * unit - box.centre.z();
  const FloatLanes squared_gap = fx * fx + fy * fy + fz * fz;
  FloatLanes along_centres = squared_gap;
  FloatLanes along_box[3];
  for (int k = 0; k < 3; ++k) {
    const FloatLanes offset = (box.axes(0, k) * fx + box.axes(1, k) * fy + box.axes(2, k) * fz).abs();
    along_centres -= offset * box.half[k];
    along_box[k] = offset - box.half[k];
  }
  FloatLanes sum_node = FloatLanes::Zero();
  for (int i = 0; i < 3; ++i) {
    const FloatLanes x = lanes(node.axes[i][0]);
    const FloatLanes y = lanes(node.axes[i][1]);
    const FloatLanes z = lanes(node.axes[i][2]);
    const FloatLanes half = lanes(node.half[i]) * unit;
    const FloatLanes offset = (x * fx + y * fy + z * fz).abs();
    along_centres -= offset * half;
    FloatLanes along_node = offset - half;
    for (int k = 0; k < 3; ++k) {
      const FloatLanes cosine = (x * box.axes(0, k) + y * box.axes(1, k) + z * box.axes(2, k)).abs();
      along_node -= cosine * box.half[k];
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
  return sum_node.max(sum_box).max(sum_centres) * (1.0F - 0x1.0p-20F);
}

}  // namespace concave_distance::detail

#pragma once

#include <Eigen/Core>

#include "concave_distance/mesh/bounding_volume_hierarchy.h"

namespace concave_distance::detail {

/// One number for each of a node's children.
using Lanes = Eigen::Array<double, BoundingVolumeHierarchy::kWidth, 1>;

inline Lanes lanes(const double* values) {
  return Eigen::Map<const Lanes, Eigen::Aligned16>(values);
}

inline Lanes absOf(const Lanes& x) {
  return x.abs();
}

/// Bit i is set when lane i lies below `limit`.
inline unsigned lanesBelow(const Lanes& values, double limit) {
  unsigned mask = 0;
  for (unsigned lane = 0; lane < BoundingVolumeHierarchy::kWidth; ++lane) {
    mask |= static_cast<unsigned>(values[lane] < limit) << lane;
  }
  return mask;
}

/// Squared lower bounds of the distances between `box` and each of the node's boxes, both in the node's
/// frame; square metres. Separating axes: `direction` (unit, from `box` towards the node) and the axes of
/// both boxes, where what separates along the three axes of one box adds up as in a vector. `slack` (metres)
/// is taken off every separation for rounding. When `direction` alone separates all by `enough` (metres) the
/// others are not looked at.
inline Lanes squaredBounds(const BoundingVolumeHierarchy::Node& node, const OrientedBox& box,
                           const Eigen::Vector3d& direction, double slack, double enough) {
  const Lanes dx = lanes(node.centre[0]) - box.centre.x();
  const Lanes dy = lanes(node.centre[1]) - box.centre.y();
  const Lanes dz = lanes(node.centre[2]) - box.centre.z();
  const Lanes half[3] = {lanes(node.half[0]), lanes(node.half[1]), lanes(node.half[2])};

  const double box_support = (box.axes.transpose() * direction).cwiseAbs().dot(box.half);
  Lanes separation = direction.x() * dx + direction.y() * dy + direction.z() * dz - (box_support + slack);
  for (int i = 0; i < 3; ++i) {
    separation -=
        half[i] * absOf(direction.x() * lanes(node.axes[i][0]) + direction.y() * lanes(node.axes[i][1]) +
                        direction.z() * lanes(node.axes[i][2]));
  }
  separation = separation.max(0.0);
  const Lanes squared = separation.square();
  if ((separation >= enough).all()) return squared;

  Lanes along_box[3];  // what separates along the box's axes
  for (int k = 0; k < 3; ++k) {
    along_box[k] =
        absOf(box.axes(0, k) * dx + box.axes(1, k) * dy + box.axes(2, k) * dz) - (box.half[k] + slack);
  }
  Lanes sum_node = Lanes::Zero();
  for (int i = 0; i < 3; ++i) {
    const Lanes x = lanes(node.axes[i][0]);
    const Lanes y = lanes(node.axes[i][1]);
    const Lanes z = lanes(node.axes[i][2]);
    Lanes along_node = absOf(x * dx + y * dy + z * dz) - half[i] - slack;
    for (int k = 0; k < 3; ++k) {
      const Lanes cosine = absOf(x * box.axes(0, k) + y * box.axes(1, k) + z * box.axes(2, k));
      along_node -= cosine * box.half[k];
      along_box[k] -= cosine * half[i];
    }
    sum_node += along_node.max(0.0).square();
  }
  const Lanes sum_box =
      along_box[0].max(0.0).square() + along_box[1].max(0.0).square() + along_box[2].max(0.0).square();
  return squared.max(sum_node.max(sum_box));
}

}  // namespace concave_distance::detail

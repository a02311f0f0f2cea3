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

/// Projects each lane's point, [coordinate][lane], on a direction.
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

/// A rotation and an offset relative to the scene's scale, single precision.
struct SinglePose {
  SinglePose(const Eigen::Matrix3d& turn, const Eigen::Vector3d& shift)
      : rotation(turn.cast<float>()), offset(shift.cast<float>()) {}

  Eigen::Matrix3f rotation;
  Eigen::Vector3f offset;
};

/// A box as the other tree's nodes are compared with it: in their frame, lengths relative to the scene's
/// scale. `unit`: the reach of the box's own body relative to the scale.
struct ComparedBox {
  ComparedBox() = default;
  ComparedBox(const BoundingVolumeHierarchy::SingleNode& node, std::uint32_t lane, float unit,
              const SinglePose& node_from_box) {
    for (int k = 0; k < 3; ++k) {
      centre[k] = node.centre[k][lane] * unit;
      half[k] = node.half[k][lane] * unit;
      for (int c = 0; c < 3; ++c) axes(c, k) = node.axes[k][c][lane];
    }
    centre = (node_from_box.rotation * centre + node_from_box.offset).eval();
    axes = (node_from_box.rotation * axes).eval();
  }

  Eigen::Vector3f centre;
  Eigen::Matrix3f axes;
  Eigen::Vector3f half;
};

/// What every bound of one query shares.
struct BoundScale {
  BoundScale(double metres, double relative_slack)
      : scale(metres),
        inverse_scale(1.0 / metres),
        squared_scale(metres * metres),
        slack(relative_slack * metres) {}

  double scale;          ///< metres, no smaller than any distance between points of the two bodies
  double inverse_scale;  ///< 1 / scale
  double squared_scale;
  double slack;  ///< metres: rounding of a bound in double precision
  /// The same in single precision, relative to `scale`: 64 of its machine epsilons. A box brought to the
  /// other frame errs by 4 in its centre and by 2.5 in each axis, so that an offset along an axis errs by 11,
  /// a cosine by 5 and all cosines' products with half lengths, which add up to less than 1.8, by 9; the
  /// sums' own rounding is below 8.
  static constexpr float kFloatSlack = 0x1.0p-17F;
};

inline FloatLanes lanes(const float* values) {
  return Eigen::Map<const FloatLanes, Eigen::Aligned16>(values);
}

/// Squared distances from the box's centre to those of the node's boxes, relative to the squared scale.
inline FloatLanes squaredGaps(const BoundingVolumeHierarchy::SingleNode& node, const ComparedBox& box,
                              float unit) {
  return (lanes(node.centre[0]) * unit - box.centre.x()).square() +
         (lanes(node.centre[1]) * unit - box.centre.y()).square() +
         (lanes(node.centre[2]) * unit - box.centre.z()).square();
}

/// A direction for each of a node's children, in the node's frame, with how far the child reaches against it:
/// no point of the child is below `least` along it.
struct LaneDirections {
  FloatLanes direction[3];
  FloatLanes least;  ///< relative to the reach of the node's body
};

/// Makes the directions unit vectors (shorter, where they nearly vanish) and sets `least`.
inline void normalise(const BoundingVolumeHierarchy::SingleNode& node, LaneDirections& lane_directions) {
  FloatLanes(&d)[3] = lane_directions.direction;
  const FloatLanes squared_length = d[0].square() + d[1].square() + d[2].square();
  const FloatLanes inverse = squared_length.max(0x1.0p-100F).sqrt().inverse();
  for (FloatLanes& coordinate : d) coordinate *= inverse;
  FloatLanes least =
      d[0] * lanes(node.centre[0]) + d[1] * lanes(node.centre[1]) + d[2] * lanes(node.centre[2]);
  for (int i = 0; i < 3; ++i) {
    const FloatLanes cosine =
        d[0] * lanes(node.axes[i][0]) + d[1] * lanes(node.axes[i][1]) + d[2] * lanes(node.axes[i][2]);
    least -= cosine.abs() * lanes(node.half[i]);
  }
  lane_directions.least = least;
}

/// Squared lower bounds of the distances between `box` and each of the node's boxes, relative to the squared
/// scale. Separating axes: the line of the centres and the axes of both boxes, where what separates along the
/// three axes of one box adds up as in a vector. `unit`: the reach of the node's body relative to the scale.
/// `separating`, if given: the unit directions from `box` to the lanes that give the bounds.
inline FloatLanes squaredBounds(const BoundingVolumeHierarchy::SingleNode& node, const ComparedBox& box,
                                float unit, LaneDirections* separating) {
  constexpr float kSlack = BoundScale::kFloatSlack;
  const FloatLanes f[3] = {lanes(node.centre[0]) * unit - box.centre.x(),
                           lanes(node.centre[1]) * unit - box.centre.y(),
                           lanes(node.centre[2]) * unit - box.centre.z()};
  const FloatLanes squared_gap = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
  FloatLanes along_centres = squared_gap;
  FloatLanes offset_box[3];
  FloatLanes reach_box[3];
  for (int k = 0; k < 3; ++k) {
    offset_box[k] = box.axes(0, k) * f[0] + box.axes(1, k) * f[1] + box.axes(2, k) * f[2];
    along_centres -= offset_box[k].abs() * box.half[k];
    reach_box[k] = FloatLanes::Constant(box.half[k] + kSlack);
  }
  FloatLanes gap_node[3];
  FloatLanes sum_node = FloatLanes::Zero();
  for (int i = 0; i < 3; ++i) {
    const FloatLanes x = lanes(node.axes[i][0]);
    const FloatLanes y = lanes(node.axes[i][1]);
    const FloatLanes z = lanes(node.axes[i][2]);
    const FloatLanes half = lanes(node.half[i]) * unit;
    const FloatLanes offset = x * f[0] + y * f[1] + z * f[2];
    along_centres -= offset.abs() * half;
    FloatLanes reach = half + kSlack;
    for (int k = 0; k < 3; ++k) {
      const FloatLanes cosine = (x * box.axes(0, k) + y * box.axes(1, k) + z * box.axes(2, k)).abs();
      reach += cosine * box.half[k];
      reach_box[k] += cosine * half;
    }
    gap_node[i] = offset - offset.min(reach).max(-reach);
    sum_node += gap_node[i].square();
  }
  FloatLanes gap_box[3];
  FloatLanes sum_box = FloatLanes::Zero();
  for (int k = 0; k < 3; ++k) {
    gap_box[k] = offset_box[k] - offset_box[k].min(reach_box[k]).max(-reach_box[k]);
    sum_box += gap_box[k].square();
  }
  // The gap is at most 1 in these units, so that the slack need not be multiplied with it. Where the centres
  // fall together nothing is left above.
  const FloatLanes centres = (along_centres - kSlack).max(0.0F);
  const FloatLanes sum_centres = centres.square() / squared_gap.max(0x1.0p-100F);
  const FloatLanes best = sum_node.max(sum_box).max(sum_centres);
  if (separating != nullptr) {
    // Where several do as well, their sum is as good a direction as any.
    const FloatLanes by_node = (sum_node >= best).cast<float>();
    const FloatLanes by_box = (sum_box >= best).cast<float>();
    const FloatLanes by_centres = (sum_centres >= best).cast<float>();
    for (int c = 0; c < 3; ++c) {
      const FloatLanes along_node = gap_node[0] * lanes(node.axes[0][c]) +
                                    gap_node[1] * lanes(node.axes[1][c]) +
                                    gap_node[2] * lanes(node.axes[2][c]);
      const FloatLanes along_box =
          gap_box[0] * box.axes(c, 0) + gap_box[1] * box.axes(c, 1) + gap_box[2] * box.axes(c, 2);
      separating->direction[c] = by_node * along_node + by_box * along_box + by_centres * f[c];
    }
    normalise(node, *separating);
  }
  return best * (1.0F - 0x1.0p-20F);
}

/// How far each lane is from the box `other` in `lane` along the lane's direction, relative to the scale; may
/// be negative. `node_from_box` takes the box's points to the node's frame.
inline FloatLanes separations(const LaneDirections& of_node, float unit,
                              const BoundingVolumeHierarchy::SingleNode& other, std::uint32_t lane,
                              float other_unit, const SinglePose& node_from_box) {
  const Eigen::Matrix3f& rotation = node_from_box.rotation;
  const Eigen::Vector3f& offset = node_from_box.offset;
  const FloatLanes(&d)[3] = of_node.direction;
  FloatLanes turned[3];
  for (int c = 0; c < 3; ++c) {
    turned[c] = rotation(0, c) * d[0] + rotation(1, c) * d[1] + rotation(2, c) * d[2];
  }
  FloatLanes most = turned[0] * other.centre[0][lane] + turned[1] * other.centre[1][lane] +
                    turned[2] * other.centre[2][lane];
  for (int k = 0; k < 3; ++k) {
    most += (turned[0] * other.axes[k][0][lane] + turned[1] * other.axes[k][1][lane] +
             turned[2] * other.axes[k][2][lane])
                .abs() *
            other.half[k][lane];
  }
  return of_node.least * unit - most * other_unit -
         (d[0] * offset.x() + d[1] * offset.y() + d[2] * offset.z()) - BoundScale::kFloatSlack;
}

}  // namespace concave_distance::detail

#pragma once

#include <Eigen/Core>
#include <limits>

#include "local_frames.h"
#include "mesh/trees/normal_cone_tree.h"

namespace concave_distance::detail {

/// One number for each of a node's children.
using ConeLanes = Eigen::Array<float, NormalConeTree::kWidth, 1>;

inline ConeLanes coneLanes(const float* values) {
  return Eigen::Map<const ConeLanes, Eigen::Aligned16>(values);
}

/// A child of one tree as the other tree's nodes are compared with it: in their frame and unit.
struct ComparedCone {
  float centre[3];
  float radius;
  float axis[3];
  float angle;
  float cosine;
  float sine;
};

/// What all comparisons with one tree's nodes share, in its unit.
struct ConeLimits {
  ConeLimits(double metres_of_slack, double metres_of_size, double metres_of_cutoff, double unit) {
    const double size = metres_of_size / unit;
    // Squares of what is larger could leave the range of single precision; nothing is left out then.
    slack = size < 1e15 ? static_cast<float>(metres_of_slack / unit + kFloatSlack * size)
                        : std::numeric_limits<float>::infinity();
    cutoff = static_cast<float>(metres_of_cutoff / unit * (1.0 + kFloatSlack));
  }

  /// 64 machine epsilons of the largest coordinate: the terms of a bound are at most 8 products of three
  /// factors, each rounded, and err by less than 32.
  static constexpr double kFloatSlack = 0x1.0p-18;
  /// Of cosines and angles.
  static constexpr float kAngleSlack = 0x1.0p-20F;

  float slack;
  float cutoff;
};

/// Why no local minimum with a distance of at most the cutoff can have one end in the kept child and the
/// other in the node's: each is above 0 where it is a reason, and not where a number is not one. Lengths in
/// the node's unit.
struct ConeReasons {
  ConeLanes turned_away;  ///< their caps do not face each other: radians that the bodies may turn, at least
  ConeLanes too_far;      ///< beyond the cutoff by so much
  ConeLanes
      misses_kept;  ///< no line between the spheres is in the kept cap: so far may the node's centre move
  ConeLanes misses_node;  ///< nor in the node's cap: so far may the kept centre move, as seen from the node

  ConeLanes largest() const { return turned_away.max(too_far).max(misses_kept).max(misses_node); }
};

inline ConeReasons coneReasons(const NormalConeTree::Node& node, const ComparedCone& kept,
                               const ConeLimits& limits) {
  const ConeLanes axis_x = coneLanes(node.axis[0]);
  const ConeLanes axis_y = coneLanes(node.axis[1]);
  const ConeLanes axis_z = coneLanes(node.axis[2]);
  const ConeLanes cosine = coneLanes(node.cosine);
  const ConeLanes sine = coneLanes(node.sine);
  // Caps that face each other: the angle from the one to the other's opposite is within their sum.
  const ConeLanes facing = kept.axis[0] * axis_x + kept.axis[1] * axis_y + kept.axis[2] * axis_z;
  const ConeLanes turned_away =
      (kept.cosine * cosine - kept.sine * sine + (facing - ConeLimits::kAngleSlack))
          .min(static_cast<float>(M_PI) - ConeLimits::kAngleSlack - (coneLanes(node.angle) + kept.angle));
  const ConeLanes x = coneLanes(node.centre[0]) - kept.centre[0];
  const ConeLanes y = coneLanes(node.centre[1]) - kept.centre[1];
  const ConeLanes z = coneLanes(node.centre[2]) - kept.centre[2];
  const ConeLanes reach = coneLanes(node.radius) + (kept.radius + limits.slack);
  const ConeLanes beyond = (x * x + y * y + z * z).sqrt() - reach;
  // A cone of the other sphere's directions misses the cap when the sphere misses the cone over the cap:
  // beside it (distance from its flank), or behind its apex.
  const auto misses = [&](const ConeLanes& along, const ConeLanes& across, const auto& cos, const auto& sin) {
    const ConeLanes beside = across * cos - along * sin;
    const ConeLanes behind = -(along * cos + across * sin);
    return ConeLanes((beside - reach).max(beside.min(behind).min(beyond)));
  };
  const auto length = [](const ConeLanes& i, const ConeLanes& j, const ConeLanes& k) {
    return ConeLanes((i * i + j * j + k * k).sqrt());
  };
  const ConeLanes along_kept = x * kept.axis[0] + y * kept.axis[1] + z * kept.axis[2];
  const ConeLanes across_kept =
      length(y * kept.axis[2] - z * kept.axis[1], z * kept.axis[0] - x * kept.axis[2],
             x * kept.axis[1] - y * kept.axis[0]);
  const ConeLanes along_node = -(x * axis_x + y * axis_y + z * axis_z);
  const ConeLanes across_node =
      length(y * axis_z - z * axis_y, z * axis_x - x * axis_z, x * axis_y - y * axis_x);
  return {turned_away, beyond - limits.cutoff, misses(along_kept, across_kept, kept.cosine, kept.sine),
          misses(along_node, across_node, cosine, sine)};
}

}  // namespace concave_distance::detail

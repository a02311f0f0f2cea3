#pragma once

#include <Eigen/Core>
#include <limits>

#include "distance/kernels/pair_frame.h"
#include "mesh/trees/normal_cone_tree.h"

namespace concave_distance::detail {

/// One number for each of a node's children.
using ConeLanes = Eigen::Array<float, NormalConeTree::kWidth, 1>;

/// A group in the frame and unit of one tree, or with ConeLanes several.
template <typename Number>
struct ComparedCone {
  Number centre[3];
  Number radius;
  Number axis[3];
  Number angle;
  Number cosine;
  Number sine;
};

inline ComparedCone<ConeLanes> coneLanes(const NormalConeTree::Group& first,
                                         const NormalConeTree::Group& second,
                                         const NormalConeTree::Group& third,
                                         const NormalConeTree::Group& fourth) {
  const auto lanes = [&](float NormalConeTree::Group::*number) {
    return ConeLanes(first.*number, second.*number, third.*number, fourth.*number);
  };
  const auto vector = [&](float(NormalConeTree::Group::*numbers)[3], std::size_t k) {
    return ConeLanes((first.*numbers)[k], (second.*numbers)[k], (third.*numbers)[k], (fourth.*numbers)[k]);
  };
  using Group = NormalConeTree::Group;
  return {{vector(&Group::centre, 0), vector(&Group::centre, 1), vector(&Group::centre, 2)},
          lanes(&Group::radius),
          {vector(&Group::axis, 0), vector(&Group::axis, 1), vector(&Group::axis, 2)},
          lanes(&Group::angle),
          lanes(&Group::cosine),
          lanes(&Group::sine)};
}

/// Holds what all comparisons in one tree's frame share, in its unit.
struct ConeLimits {
  ConeLimits(double metres_of_slack, double metres_of_size, double metres_of_cutoff, double unit) {
    const double size = metres_of_size / unit;
    // Squares of what is larger could leave the range of single precision; nothing is left out then.
    slack = size < 1e15 ? static_cast<float>(metres_of_slack / unit + kFloatSlack * size)
                        : std::numeric_limits<float>::infinity();
    cutoff = static_cast<float>(metres_of_cutoff / unit * (1.0 + kFloatSlack));
  }

  /// 128 units of rounding (2^-24) of the largest coordinate: the terms of a bound are at most 8 products of
  /// three factors, each rounded, and err by less than 32; a centre and an axis that are moved in single
  /// precision by less than 8 each, which enters twice.
  static constexpr double kFloatSlack = 0x1.0p-17;
  /// Bounds the error of cosines and angles, 32 units: a moved axis errs by less than 8, a sum of 5 products
  /// by less than 8.
  static constexpr float kAngleSlack = 0x1.0p-19F;

  float slack;
  float cutoff;
};

/// Says why no local minimum with a distance of at most the cutoff can have one end in one group and the
/// other in the other: each is above 0 where it is a reason, and not where a number is not one. Lengths in
/// the unit of the tree in whose frame they are.
struct ConeReasons {
  ConeLanes turned_away;  ///< their caps do not face each other: radians that the bodies may turn, at least
  ConeLanes too_far;      ///< beyond the cutoff by so much
  ConeLanes
      misses_kept;  ///< no line between the spheres is in the kept cap: so far may the other centre move
  ConeLanes
      misses_other;  ///< nor in the other's cap: so far may the kept centre move, as seen from the other

  ConeLanes largest() const { return turned_away.max(too_far).max(misses_kept).max(misses_other); }
};

/// @param kept one group, to be compared with four, or one for each of them
template <typename Number>
ConeReasons coneReasons(const ComparedCone<ConeLanes>& others, const ComparedCone<Number>& kept,
                        const ConeLimits& limits) {
  const ConeLanes& axis_x = others.axis[0];
  const ConeLanes& axis_y = others.axis[1];
  const ConeLanes& axis_z = others.axis[2];
  // Caps that face each other: the angle from the one to the other's opposite is within their sum.
  const ConeLanes facing = kept.axis[0] * axis_x + kept.axis[1] * axis_y + kept.axis[2] * axis_z;
  const ConeLanes turned_away =
      (kept.cosine * others.cosine - kept.sine * others.sine + (facing - ConeLimits::kAngleSlack))
          .min(static_cast<float>(M_PI) - ConeLimits::kAngleSlack - (others.angle + kept.angle));
  const ConeLanes x = others.centre[0] - kept.centre[0];
  const ConeLanes y = others.centre[1] - kept.centre[1];
  const ConeLanes z = others.centre[2] - kept.centre[2];
  const ConeLanes reach = others.radius + (kept.radius + limits.slack);
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
  const ConeLanes along_other = -(x * axis_x + y * axis_y + z * axis_z);
  const ConeLanes across_other =
      length(y * axis_z - z * axis_y, z * axis_x - x * axis_z, x * axis_y - y * axis_x);
  return {turned_away, beyond - limits.cutoff, misses(along_kept, across_kept, kept.cosine, kept.sine),
          misses(along_other, across_other, others.cosine, others.sine)};
}

}  // namespace concave_distance::detail

#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "concave_distance/scene/broad_phase.h"

namespace concave_distance {

/// Returns a box along the world's axes that holds a body at a rigid pose, moved out by `margin`; rounded
/// outwards.
inline Eigen::AlignedBox3d boxAt(const BodyBounds& bounds, const Eigen::Isometry3d& world_from_body,
                                 double margin) {
  constexpr double kRoundings = 16.0 * std::numeric_limits<double>::epsilon();
  const Eigen::Vector3d centre = world_from_body * bounds.centre;
  const Eigen::Vector3d turned = world_from_body.linear().cwiseAbs() * bounds.half_extents;
  const double scale = world_from_body.translation().lpNorm<1>() + 2.0 * bounds.centre.lpNorm<1>() +
                       2.0 * bounds.half_extents.sum() + margin;
  const Eigen::Vector3d half = (turned.cwiseMin(bounds.radius).array() + margin) + kRoundings * scale;
  return {centre - half, centre + half};
}

}  // namespace concave_distance

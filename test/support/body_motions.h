#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "base/random_engine.h"
#include "support/triangle_pairs.h"

namespace concave_distance::test {

/// A motion along a smooth path, turning about a changing axis.
struct Motion {
  Eigen::Vector3d centre;
  Eigen::Vector3d reach;
  Eigen::Vector3d turns;

  Eigen::Isometry3d at(double t) const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() =
        centre + Eigen::Vector3d(reach.x() * std::sin(3.0 * t), reach.y() * std::cos(2.0 * t),
                                 reach.z() * std::sin(t + 1.0));
    pose.linear() = (Eigen::AngleAxisd(turns.x() * t, Eigen::Vector3d::UnitX()) *
                     Eigen::AngleAxisd(turns.y() * t, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(turns.z() * t, Eigen::Vector3d::UnitZ()))
                        .toRotationMatrix();
    return pose;
  }
};

inline Motion randomMotion(RandomEngine& engine) {
  const Eigen::Vector3d centre = uniformInCube(engine, 1.5);
  const Eigen::Vector3d reach = uniformInCube(engine, 0.6);
  return {centre, reach, uniformInCube(engine, 3.0)};
}

}  // namespace concave_distance::test

#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <utility>

#include "base/random_engine.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/concave_shapes.h"
#include "support/plain_shapes.h"
#include "support/triangle_pairs.h"

namespace concave_distance::test {

/// A body whose search grid is the surface itself unless an edge length is given.
inline std::shared_ptr<const BodyMesh> makeBody(SurfaceMesh surface, double max_edge_length = 0.0) {
  BodyMeshOptions options;
  options.max_edge_length = max_edge_length > 0.0 ? max_edge_length : 2.0 * surface.diameter();
  return std::make_shared<const BodyMesh>("body", std::move(surface), options);
}

inline Eigen::Isometry3d translation(const Eigen::Vector3d& v) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = v;
  return pose;
}

inline Eigen::Isometry3d turned(double angle, const Eigen::Vector3d& axis, const Eigen::Vector3d& position) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(angle, axis.normalized()));
  pose.translation() = position;
  return pose;
}

inline Eigen::Isometry3d randomPose(RandomEngine& engine, double reach) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = randomRotation(engine);
  pose.translation() = uniformInCube(engine, reach);
  return pose;
}

/// One of the concave shapes, by number (any).
inline SurfaceMesh concaveShape(std::uint32_t number) {
  switch (number % 6) {
    case 0:
      return makeComb(3);
    case 1:
      return makeStairs(4);
    case 2:
      return makeLShape();
    case 3:
      return makeHook();
    case 4:
      return makeSheet(5, 4, 0.15, 0.1);
    default:
      return makeJoined(makeHook(), makeLShape(), Eigen::Vector3d(0.7, 0.1, 0.3));
  }
}

/// A comb of five teeth, with the automatic search grid.
inline const std::shared_ptr<const BodyMesh>& fiveTeeth() {
  static const auto kComb = std::make_shared<const BodyMesh>("comb", makeComb(5), BodyMeshOptions());
  return kComb;
}

/// Where the teeth of one such comb sway in the other's gaps within the clearance, at time t.
/// @param depth metres that they are apart along the teeth, on average
inline Eigen::Isometry3d swayingComb(double t, double turn = 0.01, double depth = 0.6, double stroke = 0.1) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(M_PI + turn * std::sin(4.0 * t), Eigen::Vector3d::UnitZ()));
  pose.translation() << 1.225 + 0.008 * std::sin(6.0 * t), depth + stroke * std::sin(3.0 * t),
      0.02 * std::sin(3.0 * t);
  return pose;
}

}  // namespace concave_distance::test

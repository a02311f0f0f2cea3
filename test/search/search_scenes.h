#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "concave_distance/mesh/body_mesh.h"
#include "support/concave_shapes.h"

/// Bodies and poses of the search's tests.
namespace concave_distance::test {

inline std::unique_ptr<BodyMesh> makeSearchBody(const SurfaceMesh& surface, double max_edge_length,
                                                std::size_t matrix_node_limit = 65535) {
  BodyMeshOptions options;
  options.max_edge_length = max_edge_length;
  options.matrix_node_limit = matrix_node_limit;
  return std::make_unique<BodyMesh>("test body", surface, options);
}

inline Eigen::Isometry3d makePose(double angle, const Eigen::Vector3d& axis,
                                  const Eigen::Vector3d& translation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

/// A pair of bodies at one pose.
struct PairScene {
  std::unique_ptr<BodyMesh> a;
  std::unique_ptr<BodyMesh> b;
  Eigen::Isometry3d a_from_b;
};

/// Two combs, teeth towards each other, slightly askew: every tooth has its niches.
inline PairScene facingCombs(double max_edge_length = 0.1, std::size_t matrix_node_limit = 65535) {
  PairScene scene{makeSearchBody(makeComb(4), max_edge_length, matrix_node_limit),
                  makeSearchBody(makeComb(4), max_edge_length, matrix_node_limit),
                  {}};
  scene.a_from_b = makePose(3.05, Eigen::Vector3d::UnitZ(), {0.9, 0.95, 0.03}) *
                   Eigen::Isometry3d(Eigen::AngleAxisd(0.12, Eigen::Vector3d(1.0, 0.3, 0.0).normalized()));
  return scene;
}

/// A hook beside stairs.
inline PairScene hookAndStairs(double max_edge_length = 0.1, std::size_t matrix_node_limit = 65535) {
  return {makeSearchBody(makeStairs(5), max_edge_length, matrix_node_limit),
          makeSearchBody(makeHook(), max_edge_length, matrix_node_limit),
          makePose(0.5, {1.0, 2.0, 3.0}, {0.1, 0.75, 0.1})};
}

/// Two shells each, so that some nodes have no path between them.
inline PairScene shellsAndShells(double max_edge_length = 0.15) {
  return {makeSearchBody(makeJoined(makeLShape(), makeHook(), {1.2, 0.0, 0.0}), max_edge_length),
          makeSearchBody(makeJoined(makeComb(3), makeLShape(), {0.0, 0.9, 0.3}), max_edge_length),
          makePose(0.4, {0.2, 1.0, 0.4}, {0.2, 1.0, 0.6})};
}

}  // namespace concave_distance::test

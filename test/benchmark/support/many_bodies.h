#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance::benchmark {

using Poses = std::vector<std::optional<Eigen::Isometry3d>>;

inline constexpr double kCutoff = 0.2;  ///< metres, of manyBodies()

/// A smooth path about a home: a sum of slow sines.
struct Path {
  Eigen::Vector3d home;
  std::array<Eigen::Vector3d, 3> amplitude;
  std::array<Eigen::Vector3d, 3> phase;
  Eigen::Vector3d axis;
  double spin = 0.0;

  Eigen::Isometry3d at(double time) const;
};

/// A scene in which each body moves on a path of its own.
struct ManyBodies {
  Scene scene;
  std::vector<Path> paths;  ///< one for each body
  Poses posesAt(double time) const;
};

/// Returns 20 shapes, 0.2 to 0.5 m across: a third spheres, a third boxes, a third bumpy balls of 1,000 to
/// 5,000 triangles.
std::vector<std::shared_ptr<const BodyMesh>> manyShapes();

/// Returns bodies of manyShapes() with a cubic metre each, all watched against all.
ManyBodies manyBodies(std::size_t count);

}  // namespace concave_distance::benchmark

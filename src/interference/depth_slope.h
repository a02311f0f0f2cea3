#pragma once

#include <Eigen/Core>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance::detail {

/// Finds how the greatest depth changes with the motion of the surface that the deepest point lies below.
class DepthSlope {
 public:
  /// A body, where it is and a point, all in one frame.
  struct Surface {
    const BodyMesh& body;
    Eigen::Isometry3d frame_from_body;
  };
  /// Returns the rate of the greatest depth per metre that `other` moves along it, as a vector: at most of
  /// length 1. Where the deepest point is held between several walls it is the mean of their directions that
  /// is across the surface which the point can give way on; of a flat bottom it is one of them.
  /// @param point the deepest one, on `own`, inside `other` @param depth metres
  /// @param tolerance metres: what is nearer is one place
  Eigen::Vector3d find(const Surface& own, const Surface& other, const Eigen::Vector3d& point, double depth,
                       double tolerance);

 private:
  struct Direction {
    double distance;
    Eigen::Vector3d out;                               ///< unit, to the closest point of a wall
    Eigen::Vector2d across = Eigen::Vector2d::Zero();  ///< along the surface that the point can give way on
  };
  void collectDirections(const Surface& other, const Eigen::Vector3d& point, double reach);
  /// Returns the number of directions in which the surface goes on both ways, which `along` begins with.
  int findWays(const Surface& own, const Eigen::Vector3d& point, double tolerance,
               Eigen::Matrix<double, 3, 2>& along) const;
  Eigen::Vector3d meanOnLine() const;
  Eigen::Vector3d meanOnPlane() const;

  std::vector<Direction> directions_;  ///< nearest first
};

}  // namespace concave_distance::detail

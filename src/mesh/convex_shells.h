#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance {

/// A body that is the union of convex solids, each a shell of its surface, as links modelled by primitives
/// are.
struct ConvexShells {
  struct Shell {
    std::shared_ptr<const BodyMesh> mesh;  ///< in the body's frame
    std::vector<TriangleIndex> triangles;  ///< of the body, by triangle of `mesh`
    Eigen::Vector3d centre;                ///< inside, body frame, metres
  };
  std::vector<Shell> shells;  ///< empty: a shell is not convex up to rounding, or there are too many
};

/// More shells than this are not looked at one by one.
inline constexpr std::size_t kMostConvexShells = 128;

ConvexShells findConvexShells(const BodyMesh& body);

}  // namespace concave_distance

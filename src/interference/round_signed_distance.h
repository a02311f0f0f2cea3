#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance::detail {

/// The signed distance of two round solids, A's frame.
struct RoundSignedDistance {
  double value;  ///< metres
  Eigen::Vector3d point_a_in_a;
  Eigen::Vector3d point_b_in_a;
  Eigen::Vector3d pivot_in_a;     ///< on the core that is a ball swept along
  Eigen::Vector3d gradient_in_a;  ///< unit, rate of the value with B's motion at the pivot
};

/// Returns the signed distance of the core of one from the other less the core's radius; nothing for two
/// cylinders.
std::optional<RoundSignedDistance> roundSignedDistance(const RoundShape& a, const RoundShape& b,
                                                       const Eigen::Isometry3d& a_from_b);

/// Returns whether the depth of a round solid in a mesh is that of the mesh below its surface: while the
/// solid's core, a point or a segment, is outside the mesh. From a point of the solid's surface in the mesh
/// the way to the core leaves the mesh at a point that is at least as deep in the solid.
bool isCoreOutside(const RoundShape& shape, const BodyMesh& mesh, const Eigen::Isometry3d& mesh_from_body);

}  // namespace concave_distance::detail

#pragma once

#include <Eigen/Core>
#include <string>

#include "concave_distance/mesh/surface_mesh.h"

namespace concave_distance {

/// Reads every mesh of a file (binary or ASCII STL, OBJ, PLY, DAE and what else assimp reads), with the node
/// transforms of the file applied; for DAE its unit and up-axis too, so that the result is in metres in the
/// frame that rviz would draw it in.
/// @param scale the URDF's mesh scale, a factor per axis; a negative product mirrors, and the winding is
///        turned so that normals keep pointing outwards
/// @throws Error naming the file when it is missing, unreadable, empty, or the scale is zero or not finite
TriangleSoup importMesh(const std::string& path, const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());

/// Appends `part`, transformed, to `body`: several collision elements of a link become one body.
void appendTransformed(TriangleSoup& body, const TriangleSoup& part, const Eigen::Isometry3d& body_from_part);

}  // namespace concave_distance

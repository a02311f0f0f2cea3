#pragma once

#include <Eigen/Geometry>
#include <string>

#include "exact_solid.h"
#include "thesis/src/continuous/build_constraint_tree.h"

namespace concave_distance {

/// buildConstraintTree() from the solid itself, which may touch itself as no surface mesh may.
/// @param bounding_box of the solid
BuiltTree buildTreeOf(const ExactSolid& solid, const Eigen::AlignedBox3d& bounding_box,
                      const TreeBuildOptions& options, const std::string& where);

}  // namespace concave_distance

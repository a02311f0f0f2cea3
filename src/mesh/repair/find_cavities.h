#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface/resolve_shells.h"

namespace concave_distance::detail {

/// Finds units that bound a cavity: they lie in the material of others and are wound the other way than the
/// outermost unit around them. All others bound material, also those that some seconds of work do not decide,
/// which takes thousands of shells within one another. O(log n) for each pair of units with one bounding box
/// inside the other, times the triangles that a ray crosses.
std::vector<bool> findCavities(const std::vector<Eigen::Vector3d>& vertices, const ResolvedShells& resolved);

}  // namespace concave_distance::detail

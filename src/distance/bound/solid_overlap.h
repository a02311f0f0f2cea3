#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance {

/// Returns whether one body has a shell, open or closed, in the material of the other one's closed shells.
/// Where the surfaces do not meet, each shell lies wholly inside or wholly outside, so that one point of each
/// decides; the bodies are apart exactly when this is false, for two solids that overlap without their
/// surfaces meeting have a piece of surface inside the other. Where they do meet it says nothing that counts.
/// Empty when the limit was reached first; it is not checked for the first 64 shells of each body.
/// O(shells) where the points lie outside the other's box, O(log n) more for each that does not.
std::optional<bool> isContained(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                WorkLimit& limit);

}  // namespace concave_distance

#include "round_signed_distance.h"

#include "distance/kernels/round_kernels.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance::detail {
namespace {

Eigen::Vector3d coreEnd(const RoundShape& shape, double sign) {
  return {0.0, 0.0, hasSide(shape) ? sign * shape.half_length : 0.0};
}

}  // namespace

std::optional<RoundSignedDistance> roundSignedDistance(const RoundShape& a, const RoundShape& b,
                                                       const Eigen::Isometry3d& a_from_b) {
  const bool core_is_of_b = !hasFlatEnds(b);
  if (!core_is_of_b && hasFlatEnds(a)) return std::nullopt;
  const RoundShape& own = core_is_of_b ? b : a;
  const RoundShape& solid = core_is_of_b ? a : b;
  const Eigen::Isometry3d a_from_own =
      core_is_of_b ? a_from_b * own.body_from_shape : Eigen::Isometry3d(own.body_from_shape);
  const Eigen::Isometry3d a_from_solid =
      core_is_of_b ? Eigen::Isometry3d(solid.body_from_shape) : a_from_b * solid.body_from_shape;
  const Eigen::Isometry3d solid_from_own = a_from_solid.inverse(Eigen::Isometry) * a_from_own;
  const LowestPoint lowest =
      lowestOnSegment(solid, solid_from_own * coreEnd(own, -1.0), solid_from_own * coreEnd(own, 1.0));
  const Eigen::Vector3d out = outwardDirection(solid, lowest.point);
  const Eigen::Vector3d on_own = a_from_solid * (lowest.point - own.radius * out);
  const Eigen::Vector3d on_solid = a_from_solid * (lowest.point - lowest.value * out);
  const Eigen::Vector3d gradient = (core_is_of_b ? 1.0 : -1.0) * (a_from_solid.linear() * out);
  return RoundSignedDistance{lowest.value - own.radius, core_is_of_b ? on_solid : on_own,
                             core_is_of_b ? on_own : on_solid, a_from_solid * lowest.point, gradient};
}

bool isCoreOutside(const RoundShape& shape, const BodyMesh& mesh, const Eigen::Isometry3d& mesh_from_body) {
  if (hasFlatEnds(shape)) return false;
  const Eigen::Isometry3d mesh_from_shape = mesh_from_body * shape.body_from_shape;
  const Eigen::Vector3d from = mesh_from_shape * coreEnd(shape, -1.0);
  const Eigen::Vector3d to = mesh_from_shape * coreEnd(shape, 1.0);
  if (containsPoint(mesh.tree(), mesh.surface(), mesh.topology().shell_is_closed,
                    mesh.topology().shell_of_triangle, from))
    return false;
  return !hasSide(shape) || !segmentHits(mesh.tree(), mesh.surface(), from, to, 0.0);
}

}  // namespace concave_distance::detail

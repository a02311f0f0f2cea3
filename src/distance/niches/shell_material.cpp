#include "shell_material.h"

#include "mesh/surface/mesh_topology.h"

namespace concave_distance::detail {
namespace {

/// Says how far before a surface it is asked what is there, relative to the body.
constexpr double kStepOff = 1e-7;

/// @param towards unit vector; zero: along the triangle's normal
bool isInside(const BodyMesh& body, TriangleIndex triangle, const Eigen::Vector3d& point,
              const Eigen::Vector3d& towards) {
  if (body.shellContacts().joints.empty()) return false;
  const Eigen::Vector3d& direction =
      towards.isZero(0.0) ? body.topology().triangle_normals[triangle.value] : towards;
  return isInsideOtherShell(body.surface(), body.topology(), body.tree(), triangle,
                            point + kStepOff * body.diameter() * direction);
}

}  // namespace

bool isInsideMaterial(const PairFrame& frame, const WitnessPair& witness) {
  if (!frame.hasJoints()) return false;
  const Eigen::Vector3d towards_b = (witness.point_b_in_a - witness.point_a_in_a).stableNormalized();
  const Eigen::Isometry3d b_from_a = frame.a_from_b.inverse(Eigen::Isometry);
  return isInside(frame.a, witness.triangle_a, witness.point_a_in_a, towards_b) ||
         isInside(frame.b, witness.triangle_b, b_from_a * witness.point_b_in_a,
                  -(b_from_a.linear() * towards_b));
}

}  // namespace concave_distance::detail

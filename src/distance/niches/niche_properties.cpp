#include "niche_properties.h"

#include <algorithm>
#include <cmath>

#include "mesh/trees/triangle_tree.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;

/// In the body frame; not a unit vector. Counts every triangle of the witness's shell at an edge or vertex.
Vector3d pseudonormal(const BodyMesh& body, TriangleIndex triangle, Feature feature) {
  const MeshTopology& topology = body.topology();
  const SurfaceMesh& surface = body.surface();
  const TriangleNodes& nodes = surface.triangle(triangle);
  const auto code = static_cast<std::size_t>(feature);
  if (code >= 6) return topology.triangle_normals[triangle.value];
  const std::uint32_t shell = topology.shell_of_triangle[triangle.value];
  const auto is_of_shell = [&](TriangleIndex t) { return topology.shell_of_triangle[t.value] == shell; };
  const NodeIndex at = nodes[code % 3];
  const auto fan = topology.triangles_of_vertex.row(at.value);
  if (code < 3 && std::all_of(fan.begin(), fan.end(), is_of_shell)) return topology.vertex_normals[at.value];
  Vector3d sum = Vector3d::Zero();
  for (const TriangleIndex t : fan) {
    if (!is_of_shell(t)) continue;
    const TriangleNodes& corners = surface.triangle(t);
    const Vector3d& normal = topology.triangle_normals[t.value];
    if (code < 3) {
      const auto k = static_cast<int>(std::find(corners.begin(), corners.end(), at) - corners.begin());
      const Vector3d out = surface.corner(t, (k + 1) % 3) - surface.vertex(at);
      const Vector3d back = surface.corner(t, (k + 2) % 3) - surface.vertex(at);
      sum += std::atan2(out.cross(back).norm(), out.dot(back)) * normal;
    } else if (std::find(corners.begin(), corners.end(), nodes[(code - 2) % 3]) != corners.end()) {
      sum += normal;
    }
  }
  return sum;
}

/// `direction` away from the body's witness, body frame.
Outwardness classifyOneSide(const BodyMesh& body, TriangleIndex triangle, Feature feature,
                            const Vector3d& direction) {
  // In the plane of a sheet's border either side is as good as the other.
  constexpr double kInPlane = 1e-9;
  const Vector3d normal = pseudonormal(body, triangle, feature);
  if (normal.dot(direction) >= -kInPlane * normal.norm() * direction.norm()) return Outwardness::Outward;
  const MeshTopology& topology = body.topology();
  const bool closed = topology.isOnClosedShell(triangle);
  return closed ? Outwardness::ThroughMaterial : Outwardness::Unknown;
}

}  // namespace

Outwardness classifyOutwardness(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                const WitnessPair& witness) {
  const Vector3d direction = witness.point_b_in_a - witness.point_a_in_a;
  if (witness.squared_distance == 0.0) return Outwardness::Outward;
  const Outwardness of_a = classifyOneSide(a, witness.triangle_a, witness.feature_a, direction);
  const Outwardness of_b =
      classifyOneSide(b, witness.triangle_b, witness.feature_b, a_from_b.linear().transpose() * -direction);
  if (of_a == Outwardness::ThroughMaterial || of_b == Outwardness::ThroughMaterial) {
    return Outwardness::ThroughMaterial;
  }
  return of_a == Outwardness::Outward ? of_b : of_a;
}

bool isVisible(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
               const WitnessPair& witness, Occluder& occluder) {
  constexpr double kMargin = 1e-12;
  const Eigen::Isometry3d b_from_a = a_from_b.inverse(Eigen::Isometry);
  const auto is_free = [&](Side side) {
    const BodyMesh& body = side == Side::A ? a : b;
    const Vector3d from = side == Side::A ? witness.point_a_in_a : b_from_a * witness.point_a_in_a;
    const Vector3d to = side == Side::A ? witness.point_b_in_a : b_from_a * witness.point_b_in_a;
    const double size = body.diameter() + std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
    const TriangleIndex first = occluder.side == side ? occluder.triangle : kNoTriangle;
    const TriangleIndex hit = findHit(body.tree(), body.surface(), from, to, kMargin * size, first);
    if (hit != kNoTriangle) occluder = {side, hit};
    return hit == kNoTriangle;
  };
  const Side before = occluder.side;
  return is_free(before) && is_free(before == Side::A ? Side::B : Side::A);
}

bool isVisible(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
               const WitnessPair& witness) {
  Occluder unknown;
  return isVisible(a, b, a_from_b, witness, unknown);
}

}  // namespace concave_distance

#include "round_certificate.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/constants.h"
#include "closest_point.h"
#include "distance/kernels/round_pair_distance.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;

/// Says which body is the solid, and where it is.
struct RoundRoles {
  RoundRoles(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b)
      : a_is_shape(a.shape() != nullptr),
        shape(a_is_shape ? *a.shape() : *b.shape()),
        a_from_shape(a_is_shape ? shape.body_from_shape : a_from_b * shape.body_from_shape) {}

  RoundAndMesh pair(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) const {
    return a_is_shape ? RoundAndMesh(shape, b, a_from_b.inverse(Eigen::Isometry))
                      : RoundAndMesh(shape, a, a_from_b);
  }

  bool a_is_shape;
  const RoundShape& shape;
  Eigen::Isometry3d a_from_shape;
};

TriangleIndex nearestTriangle(const BodyMesh& body, const Vector3d& point_in_body) {
  return closestPoint(body, point_in_body, TriangleIndex{0}).triangle;
}

WitnessPair witnessOf(const RoundRoles& roles, const BodyMesh& a, const BodyMesh& b,
                      const RoundMinimum& found) {
  const double value = std::abs(found.lowest.value);
  const Vector3d on_mesh = found.lowest.point;
  const Vector3d on_shape = detail::surfacePoint(roles.shape, on_mesh);
  const Vector3d mesh_in_a = roles.a_from_shape * on_mesh;
  const Vector3d shape_in_a = roles.a_from_shape * on_shape;
  const TriangleIndex nearest =
      nearestTriangle(roles.a_is_shape ? a : b, roles.shape.body_from_shape * on_shape);
  WitnessPair witness;
  witness.squared_distance = value * value;
  witness.point_a_in_a = roles.a_is_shape ? shape_in_a : mesh_in_a;
  witness.point_b_in_a = roles.a_is_shape ? mesh_in_a : shape_in_a;
  witness.triangle_a = roles.a_is_shape ? nearest : found.triangle;
  witness.triangle_b = roles.a_is_shape ? found.triangle : nearest;
  return witness;
}

/// Touching: one point at distance 0, as of two meshes.
void meetAtMesh(const RoundRoles& roles, WitnessPair& witness) {
  witness.squared_distance = 0.0;
  (roles.a_is_shape ? witness.point_a_in_a : witness.point_b_in_a) =
      roles.a_is_shape ? witness.point_b_in_a : witness.point_a_in_a;
}

WitnessPair witnessOfShapes(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                            const RoundPairDistance& found) {
  const Eigen::Isometry3d& a_from_shape = a.shape()->body_from_shape;
  WitnessPair witness;
  witness.point_a_in_a = a_from_shape * found.point_a;
  witness.point_b_in_a = a_from_shape * found.point_b;
  if (found.overlap) {
    const Vector3d middle = 0.5 * (witness.point_a_in_a + witness.point_b_in_a);
    witness.point_a_in_a = witness.point_b_in_a = middle;
  }
  witness.squared_distance = found.distance * found.distance;
  witness.triangle_a = nearestTriangle(a, witness.point_a_in_a);
  witness.triangle_b = nearestTriangle(b, a_from_b.inverse(Eigen::Isometry) * witness.point_b_in_a);
  return witness;
}

RoundPairDistance shapesDistance(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  return roundPairDistance(
      *a.shape(), *b.shape(),
      a.shape()->body_from_shape.inverse(Eigen::Isometry) * a_from_b * b.shape()->body_from_shape);
}

double roundedDown(double bound) {
  return std::max(0.0, std::nextafter(bound, 0.0));
}

DistanceCertificate certifyShapes(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  const RoundPairDistance found = shapesDistance(a, b, a_from_b);
  DistanceCertificate certificate;
  certificate.witness = witnessOfShapes(a, b, a_from_b, found);
  certificate.distance = found.distance;
  certificate.lower_bound = roundedDown(found.lower_bound - kProofError * proofScale(a, b, a_from_b));
  certificate.status = found.overlap ? CertificateStatus::Penetrating : CertificateStatus::Proven;
  return certificate;
}

DistanceCertificate certifyWithMesh(const RoundRoles& roles, const BodyMesh& a, const BodyMesh& b,
                                    const Eigen::Isometry3d& a_from_b, const TrianglePair* starts,
                                    std::size_t start_count, const CertificateRequest& request) {
  const RoundAndMesh pair = roles.pair(a, b, a_from_b);
  const auto start = [&](std::size_t i) { return roles.a_is_shape ? starts[i].b : starts[i].a; };
  RoundMinimum best =
      descendOnMesh(pair, start_count > 0 ? start(0) : nearestTriangle(pair.mesh, pair.centre_in_mesh));
  for (std::size_t i = 1; i < start_count; ++i) {
    const RoundMinimum other = descendOnMesh(pair, start(i));
    if (other.lowest.value < best.lowest.value) best = other;
  }
  DistanceCertificate certificate;
  const LowestFound search = findLowest(pair, request, best, certificate.cost);
  const RoundMinimum found = search.best;
  const std::optional<RoundMinimum> inside = found.lowest.value < 0.0 ? highestIfInside(pair) : std::nullopt;
  certificate.witness = witnessOf(roles, a, b, inside.value_or(found));
  certificate.distance = std::abs(inside.value_or(found).lowest.value);
  if (found.lowest.value <= 0.0 && !inside) {
    certificate.distance = 0.0;
    meetAtMesh(roles, certificate.witness);
    certificate.status = CertificateStatus::Penetrating;
    return certificate;
  }
  const double error = kProofError * proofScale(a, b, a_from_b);
  const double bound = inside ? certificate.distance : search.lower_bound;
  certificate.lower_bound = roundedDown(bound - error);
  certificate.status = search.was_cut                 ? CertificateStatus::Budget
                       : bound < certificate.distance ? CertificateStatus::Tolerance
                                                      : CertificateStatus::Proven;
  return certificate;
}

}  // namespace

DistanceCertificate certifyRoundDistance(const BodyMesh& a, const BodyMesh& b,
                                         const Eigen::Isometry3d& a_from_b, const TrianglePair* starts,
                                         std::size_t start_count, const CertificateRequest& request) {
  if (!a_from_b.matrix().allFinite() || a_from_b.translation().cwiseAbs().maxCoeff() > kLargestCoordinate)
    return {};
  if (a.shape() != nullptr && b.shape() != nullptr) return certifyShapes(a, b, a_from_b);
  return certifyWithMesh(RoundRoles(a, b, a_from_b), a, b, a_from_b, starts, start_count, request);
}

WitnessPair refineRoundWitness(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                               const TrianglePair& start) {
  if (a.shape() != nullptr && b.shape() != nullptr)
    return witnessOfShapes(a, b, a_from_b, shapesDistance(a, b, a_from_b));
  const RoundRoles roles(a, b, a_from_b);
  const RoundMinimum found = descendOnMesh(roles.pair(a, b, a_from_b), roles.a_is_shape ? start.b : start.a);
  WitnessPair witness = witnessOf(roles, a, b, found);
  if (found.lowest.value <= 0.0) meetAtMesh(roles, witness);
  return witness;
}

bool isRoundContained(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  if (a.shape() != nullptr && b.shape() != nullptr) return shapesDistance(a, b, a_from_b).overlap;
  const RoundRoles roles(a, b, a_from_b);
  const RoundAndMesh pair = roles.pair(a, b, a_from_b);
  if (highestIfInside(pair)) return true;
  const MeshTopology& topology = pair.mesh.topology();
  return containsPoint(pair.mesh.tree(), pair.mesh.surface(), topology.shell_is_closed,
                       topology.shell_of_triangle, pair.centre_in_mesh);
}

}  // namespace concave_distance

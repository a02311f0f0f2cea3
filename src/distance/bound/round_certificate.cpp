#include "round_certificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/coordinate_limit.h"
#include "distance/kernels/closest_point.h"
#include "distance/kernels/round_pair_distance.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;

/// Which body is the solid, and where it is.
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

/// Depth first, the nearer box first.
class LowestSearch {
 public:
  LowestSearch(const RoundAndMesh& pair, const CertificateRequest& request, const RoundMinimum& best)
      : pair_(pair), request_(request), best_(best), least_skipped_(best.lowest.value) {}

  void run() {
    std::array<Waiting, 96> stack;  // the builder keeps the depth below 80; one waiting child a level
    std::size_t waiting = 0;
    stack[waiting++] = bound(0);
    while (waiting > 0 && best_.lowest.value > 0.0) {
      const Waiting next = stack[--waiting];
      if (isSkipped(next.bound)) continue;
      if (request_.limit != nullptr && request_.limit->isOverNow()) {
        was_cut_ = true;
        for (++waiting; waiting > 0; --waiting) skip(stack[waiting - 1].bound);
        return;
      }
      const TriangleTree::Node& node = pair_.mesh.tree().nodes()[next.node];
      if (node.count == 0) {
        Waiting near = bound(next.node + 1);
        Waiting far = bound(node.first);
        if (far.bound < near.bound) std::swap(near, far);
        stack[waiting++] = far;
        stack[waiting++] = near;
      } else {
        lookAt(node);
      }
    }
  }

  const RoundMinimum& best() const { return best_; }
  double leastSkipped() const { return std::min(least_skipped_, best_.lowest.value); }
  bool wasCut() const { return was_cut_; }
  const CertificateCost& cost() const { return cost_; }

 private:
  struct Waiting {
    std::uint32_t node;
    double bound;
  };

  Waiting bound(std::uint32_t index) {
    ++cost_.box_bounds;
    const Eigen::AlignedBox3d& box = pair_.mesh.tree().nodes()[index].box;
    const Vector3d middle = pair_.inShape(box.center());
    const Vector3d out = pair_.shape_from_mesh.transpose() * detail::outwardDirection(pair_.shape, middle);
    return {index, detail::signedDistance(pair_.shape, middle) - 0.5 * out.cwiseAbs().dot(box.sizes())};
  }

  void skip(double bound) { least_skipped_ = std::min(least_skipped_, bound); }
  bool isSkipped(double bound) {
    const double best = best_.lowest.value;
    const double allowed = std::max(request_.absolute_tolerance, request_.relative_tolerance * best);
    if (bound < best - allowed) return false;
    skip(bound);
    return true;
  }

  void lookAt(const TriangleTree::Node& leaf) {
    ++cost_.leaf_pairs;
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      const TriangleIndex triangle = pair_.mesh.tree().order()[i];
      const TrianglePoints corners = pair_.triangleInShape(triangle);
      if (isSkipped(lowerBoundOnTriangle(pair_.shape, corners))) continue;
      ++cost_.triangle_pairs;
      const LowestPoint lowest = lowestOnTriangle(pair_.shape, corners);
      if (lowest.value < best_.lowest.value) best_ = {lowest, triangle};
    }
  }

  const RoundAndMesh& pair_;
  const CertificateRequest& request_;
  RoundMinimum best_;
  double least_skipped_;
  bool was_cut_ = false;
  CertificateCost cost_;
};

/// Of a mesh wholly inside the solid the greatest signed distance, at a vertex since it is convex; else
/// nothing.
std::optional<RoundMinimum> highestIfInside(const RoundAndMesh& pair) {
  const SurfaceMesh& surface = pair.mesh.surface();
  std::optional<RoundMinimum> highest;
  for (std::size_t v = 0; v < surface.vertexCount(); ++v) {
    const Vector3d point = pair.inShape(surface.vertices()[v]);
    const double value = detail::signedDistance(pair.shape, point);
    if (value >= 0.0) return std::nullopt;
    const CompressedRows<TriangleIndex>::Row around = pair.mesh.topology().triangles_of_vertex.row(v);
    if (!around.empty() && (!highest || value > highest->lowest.value)) highest = {{value, point}, around[0]};
  }
  return highest;
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

/// But for roundings.
bool touches(const TrianglePoints& triangle, const Vector3d& point) {
  constexpr double kRoundings = 0x1.0p-42;
  const double size = (triangle[1] - triangle[0]).norm() + (triangle[2] - triangle[0]).norm() + point.norm();
  const double slack = kRoundings * size;
  return pointTriangleDistance(point, triangle).squared_distance <= slack * slack;
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
                                    const Eigen::Isometry3d& a_from_b, const TrianglePair* seeds,
                                    std::size_t seed_count, const CertificateRequest& request) {
  const RoundAndMesh pair = roles.pair(a, b, a_from_b);
  const auto seed = [&](std::size_t i) { return roles.a_is_shape ? seeds[i].b : seeds[i].a; };
  RoundMinimum best =
      descendOnMesh(pair, seed_count > 0 ? seed(0) : nearestTriangle(pair.mesh, pair.centre_in_mesh));
  for (std::size_t i = 1; i < seed_count; ++i) {
    const RoundMinimum other = descendOnMesh(pair, seed(i));
    if (other.lowest.value < best.lowest.value) best = other;
  }
  LowestSearch search(pair, request, best);
  search.run();
  DistanceCertificate certificate;
  certificate.cost = search.cost();
  RoundMinimum found = search.best();
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
  const double bound = inside ? certificate.distance : search.leastSkipped();
  certificate.lower_bound = roundedDown(bound - error);
  certificate.status = search.wasCut()                ? CertificateStatus::Budget
                       : bound < certificate.distance ? CertificateStatus::Tolerance
                                                      : CertificateStatus::Proven;
  return certificate;
}

}  // namespace

RoundAndMesh::RoundAndMesh(const RoundShape& round, const BodyMesh& other,
                           const Eigen::Isometry3d& mesh_from_body)
    : shape(round), mesh(other) {
  const Eigen::Isometry3d mesh_from_shape = mesh_from_body * round.body_from_shape;
  shape_from_mesh = mesh_from_shape.linear().transpose();
  centre_in_mesh = mesh_from_shape.translation();
}

TrianglePoints RoundAndMesh::triangleInShape(TriangleIndex triangle) const {
  const SurfaceMesh& surface = mesh.surface();
  return {inShape(surface.corner(triangle, 0)), inShape(surface.corner(triangle, 1)),
          inShape(surface.corner(triangle, 2))};
}

RoundMinimum descendOnMesh(const RoundAndMesh& pair, TriangleIndex start) {
  RoundMinimum best{lowestOnTriangle(pair.shape, pair.triangleInShape(start)), start};
  for (bool moved = true; moved;) {
    moved = false;
    const TriangleNodes nodes = pair.mesh.surface().triangle(best.triangle);
    for (const NodeIndex node : nodes) {
      for (const TriangleIndex triangle : pair.mesh.topology().triangles_of_vertex.row(node.value)) {
        const TrianglePoints corners = pair.triangleInShape(triangle);
        if (!(lowerBoundOnTriangle(pair.shape, corners) < best.lowest.value)) continue;
        if (!touches(corners, best.lowest.point)) continue;
        const LowestPoint lowest = lowestOnTriangle(pair.shape, corners);
        if (!(lowest.value < best.lowest.value)) continue;
        best = {lowest, triangle};
        moved = true;
      }
    }
  }
  return best;
}

DistanceCertificate certifyRoundDistance(const BodyMesh& a, const BodyMesh& b,
                                         const Eigen::Isometry3d& a_from_b, const TrianglePair* seeds,
                                         std::size_t seed_count, const CertificateRequest& request) {
  if (!a_from_b.matrix().allFinite() || a_from_b.translation().cwiseAbs().maxCoeff() > kLargestCoordinate)
    return {};
  if (a.shape() != nullptr && b.shape() != nullptr) return certifyShapes(a, b, a_from_b);
  return certifyWithMesh(RoundRoles(a, b, a_from_b), a, b, a_from_b, seeds, seed_count, request);
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

#include "projection.h"

#include "distance/closest_point.h"
#include "mesh/grid/node_graph.h"

namespace concave_distance {
namespace {

void refineFrom(PairGeometry& geometry, TriangleIndex triangle_a, TriangleIndex triangle_b,
                std::vector<NicheCandidate>& candidates) {
  const WitnessRefinement refined = geometry.refine(triangle_a, triangle_b);
  candidates.push_back({refined.witness, geometry.nodePairNear(refined.witness), refined.proven, 0});
}

}  // namespace

void projectWitness(PairGeometry& geometry, const NicheRecord& record,
                    std::vector<NicheCandidate>& candidates) {
  const BodyMesh& a = *geometry.a;
  const BodyMesh& b = *geometry.b;
  const WitnessPair witness = record.niche.witness;
  const auto known = [&](const SurfacePoint& on_a, const SurfacePoint& on_b) {
    return on_a.triangle == witness.triangle_a && on_b.triangle == witness.triangle_b;
  };
  const SurfacePoint b_to_a = closestPoint(b, geometry.b_from_a * witness.point_a_in_a, witness.triangle_b);
  const SurfacePoint a_to_that = closestPoint(a, geometry.a_from_b * b_to_a.point, witness.triangle_a);
  if (!known(a_to_that, b_to_a)) {
    refineFrom(geometry, a_to_that.triangle, b_to_a.triangle, candidates);
  }
  const SurfacePoint a_to_b = closestPoint(a, witness.point_b_in_a, witness.triangle_a);
  const SurfacePoint b_to_that = closestPoint(b, geometry.b_from_a * a_to_b.point, witness.triangle_b);
  if (!known(a_to_b, b_to_that)) {
    refineFrom(geometry, a_to_b.triangle, b_to_that.triangle, candidates);
  }
}

void projectNode(PairGeometry& geometry, Side side, NodeIndex node, std::vector<NicheCandidate>& candidates) {
  const BodyMesh& a = *geometry.a;
  const BodyMesh& b = *geometry.b;
  const TriangleIndex any{0};
  if (side == Side::A) {
    const Eigen::Vector3d& start = a.graph().positions[node.value];
    const SurfacePoint on_b = closestPoint(b, geometry.b_from_a * start, any);
    const SurfacePoint on_a = closestPoint(a, geometry.a_from_b * on_b.point, a.originalTriangle(node));
    refineFrom(geometry, on_a.triangle, on_b.triangle, candidates);
  } else {
    const Eigen::Vector3d& start = b.graph().positions[node.value];
    const SurfacePoint on_a = closestPoint(a, geometry.a_from_b * start, any);
    const SurfacePoint on_b = closestPoint(b, geometry.b_from_a * on_a.point, b.originalTriangle(node));
    refineFrom(geometry, on_a.triangle, on_b.triangle, candidates);
  }
}

}  // namespace concave_distance

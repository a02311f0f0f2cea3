#include "niche_placement.h"

#include <cmath>
#include <limits>

#include "mesh/surface/mesh_topology.h"
#include "niche_archive.h"
#include "search/grid/body_grid.h"

namespace concave_distance {

WitnessPair nodeWitness(const PairFrame& frame, const TrialPoint& pair) {
  WitnessPair witness;
  const SearchNodes& a = gridOf(frame.a).nodes();
  const SearchNodes& b = gridOf(frame.b).nodes();
  witness.point_a_in_a = a.graph.positions[pair.node_a.value];
  witness.point_b_in_a = frame.a_from_b * b.graph.positions[pair.node_b.value];
  witness.squared_distance = (witness.point_b_in_a - witness.point_a_in_a).squaredNorm();
  witness.triangle_a = a.originalTriangle(pair.node_a);
  witness.triangle_b = b.originalTriangle(pair.node_b);
  return witness;
}

TrialPoint nodePairNear(const PairFrame& frame, const WitnessPair& witness) {
  const auto nearest = [](const BodyMesh& body, TriangleIndex triangle, const Eigen::Vector3d& point) {
    const SearchNodes& nodes = gridOf(body).nodes();
    NodeIndex best;
    double least = std::numeric_limits<double>::infinity();
    for (const NodeIndex corner : body.surface().triangle(triangle)) {
      const NodeIndex node = nodes.graphNode(corner);
      const double squared = (nodes.graph.positions[node.value] - point).squaredNorm();
      if (squared < least) {
        least = squared;
        best = node;
      }
    }
    return best;
  };
  const NodeIndex node_a = nearest(frame.a, witness.triangle_a, witness.point_a_in_a);
  const NodeIndex node_b = nearest(frame.b, witness.triangle_b, frame.bFromA() * witness.point_b_in_a);
  const Eigen::Vector3d& point_a = gridOf(frame.a).graph().positions[node_a.value];
  const Eigen::Vector3d& point_b = gridOf(frame.b).graph().positions[node_b.value];
  return {node_a, node_b, (point_a - frame.a_from_b * point_b).squaredNorm()};
}

void placeRecord(NicheRecord& record, const PairFrame& frame, const WitnessPair& witness) {
  TrackedNiche& niche = record.niche;
  niche.witness = witness;
  niche.distance = std::sqrt(witness.squared_distance);
  niche.point_a_in_a = witness.point_a_in_a;
  niche.point_b_in_a = witness.point_b_in_a;
  record.point_b_in_b = frame.bFromA() * witness.point_b_in_a;
  niche.normal_in_a = niche.distance > 0.0
                          ? Eigen::Vector3d((witness.point_b_in_a - witness.point_a_in_a) / niche.distance)
                          : frame.a.topology().triangle_normals[witness.triangle_a.value];
}

void carryRecord(NicheRecord& record, const PairFrame& frame) {
  WitnessPair witness = record.niche.witness;
  witness.point_b_in_a = frame.a_from_b * record.point_b_in_b;
  witness.squared_distance = (witness.point_b_in_a - witness.point_a_in_a).squaredNorm();
  placeRecord(record, frame, witness);
  record.niche.closing_speed = kNotComputed;
  record.niche.proven_local_minimum = false;
  record.least_distance = -std::numeric_limits<double>::infinity();
  record.carried = true;
}

}  // namespace concave_distance

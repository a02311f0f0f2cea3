#pragma once

#include <Eigen/Geometry>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/trial_point.h"

namespace concave_distance {

/// Two bodies at one relative pose: what every search operator works on. The genes are nodes of the search
/// grids; distances are measured in A's frame, or in B's while a descent moves B's node, so that no node is
/// ever transformed twice.
class PairObjective {
 public:
  PairObjective(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b)
      : a_(&a), b_(&b), a_from_b_(a_from_b), b_from_a_(a_from_b.inverse(Eigen::Isometry)) {}

  const BodyMesh& bodyA() const { return *a_; }
  const BodyMesh& bodyB() const { return *b_; }
  const Eigen::Isometry3d& aFromB() const { return a_from_b_; }
  const Eigen::Isometry3d& bFromA() const { return b_from_a_; }

  /// Carretero, eq. (3.2); square metres.
  double squaredDistance(NodeIndex node_a, NodeIndex node_b) const {
    return (a_->graph().positions[node_a.value] - a_from_b_ * b_->graph().positions[node_b.value])
        .squaredNorm();
  }
  TrialPoint evaluate(NodeIndex node_a, NodeIndex node_b, SearchCost& cost) const {
    ++cost.evaluations;
    return {node_a, node_b, squaredDistance(node_a, node_b)};
  }

 private:
  const BodyMesh* a_;
  const BodyMesh* b_;
  Eigen::Isometry3d a_from_b_;
  Eigen::Isometry3d b_from_a_;
};

}  // namespace concave_distance

#pragma once

#include <Eigen/Geometry>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/trial_point.h"
#include "search/grid/body_grid.h"

namespace concave_distance {

/// Written out, so that every place that compares node distances rounds them in the same way.
inline double squaredDistanceBetween(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  const double x = p.x() - q.x();
  const double y = p.y() - q.y();
  const double z = p.z() - q.z();
  return x * x + y * y + z * z;
}

/// Two bodies at one relative pose: what every search operator works on. The genes are nodes of the search
/// grids; distances are those in A's frame. A descent that moves B's node may look in B's frame, so that it
/// transforms once and not once a neighbour, but compares in A's frame what it has found.
class PairObjective {
 public:
  PairObjective(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b)
      : a_(&gridOf(a)), b_(&gridOf(b)), a_from_b_(a_from_b), b_from_a_(a_from_b.inverse(Eigen::Isometry)) {}

  const BodyMesh& bodyA() const { return a_->body(); }
  const BodyMesh& bodyB() const { return b_->body(); }
  const BodyGrid& gridA() const { return *a_; }
  const BodyGrid& gridB() const { return *b_; }
  const Eigen::Isometry3d& aFromB() const { return a_from_b_; }
  const Eigen::Isometry3d& bFromA() const { return b_from_a_; }

  /// Carretero, eq. (3.2); square metres.
  double squaredDistance(NodeIndex node_a, NodeIndex node_b) const {
    return squaredDistanceBetween(a_->graph().positions[node_a.value],
                                  a_from_b_ * b_->graph().positions[node_b.value]);
  }
  TrialPoint evaluate(NodeIndex node_a, NodeIndex node_b, SearchCost& cost) const {
    ++cost.evaluations;
    return {node_a, node_b, squaredDistance(node_a, node_b)};
  }

 private:
  const BodyGrid* a_;
  const BodyGrid* b_;
  Eigen::Isometry3d a_from_b_;
  Eigen::Isometry3d b_from_a_;
};

}  // namespace concave_distance

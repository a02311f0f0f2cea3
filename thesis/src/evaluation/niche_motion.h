#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "first_guess.h"
#include "search/pair_metric.h"

namespace concave_distance::evaluation {

/// Follows the solution points of niches over the instants of a motion and says where they are expected at
/// the next: by first and second differences of their places on the bodies (Carretero, sec. 7.1.3). Instants
/// are taken to be equally far apart.
class NicheMotion {
 public:
  NicheMotion(const BodyMesh& a, const BodyMesh& b, Extrapolation extrapolation)
      : a_(&a), b_(&b), extrapolation_(extrapolation) {}

  /// Takes the niches of an instant, and moves them to the nodes where they are expected at the next. A niche
  /// is the nearest one of the instant before within `radius`, or a new one, which stays where it is.
  void extrapolate(double radius, PairMetric& metric, std::vector<TrialPoint>& niches);

 private:
  /// Places at the latest instants at which it was there, the last one first.
  struct Path {
    std::array<TrialPoint, 3> places;
    std::size_t count = 1;
  };
  Path pathTo(const TrialPoint& niche, double radius, PairMetric& metric) const;

  const BodyMesh* a_;
  const BodyMesh* b_;
  Extrapolation extrapolation_;
  std::vector<Path> paths_;  ///< of the last instant's niches
  std::vector<Path> next_;
};

/// The node that steps along edges lead to from `start`, each to the neighbour nearest to `goal`, until none
/// is nearer.
NodeIndex nodeTowardsPoint(const NodeGraph& graph, NodeIndex start, const Eigen::Vector3d& goal);

}  // namespace concave_distance::evaluation

#pragma once

#include <limits>

#include "proof_frame.h"

namespace concave_distance::detail {

/// Keeps the nearest pair of triangles that a proof has measured, and measures those pairs of two leaves that
/// may be nearer.
class NearestTriangles {
 public:
  NearestTriangles(const ProofFrame& frame, const CertificateRequest& request, RefinementWorkspace& workspace,
                   CertificateCost& cost)
      : frame_(frame), request_(request), workspace_(workspace), cost_(cost) {}

  /// Measures the local minimum that a pair of triangles leads to, or only the pair itself where the request
  /// has a bound that is far enough: walking there takes longer than most such proofs.
  void begin(const TrianglePair& start);

  /// Returns a bound of the distance between two leaves' triangles, metres; measures those that it cannot
  /// exclude.
  /// @param tries_normals tries the leaves' mean normals as well, which only a kept bound gains from
  /// @param parting gets the direction most likely to part all of them at the next pose
  double measureLeaves(const BoundingVolumeHierarchy::Leaf& leaf_a,
                       const BoundingVolumeHierarchy::Leaf& leaf_b, bool tries_normals,
                       Eigen::Vector3d& parting);

  double distance() const { return distance_; }  ///< metres, infinite before anything was measured
  double squaredDistance() const { return squared_distance_; }
  double enough() const { return enough_; }  ///< metres: what is farther need not be opened
  double squaredEnough() const { return squared_enough_; }
  const Eigen::Vector3d& direction() const { return direction_; }  ///< from A's witness to B's, unit
  const TrianglePairDistance& closest() const { return closest_; }
  /// Counts the changes of direction().
  std::uint32_t directionCount() const { return direction_count_; }
  WitnessPair witness() const { return frame_.toWitness(closest_, triangle_a_, triangle_b_); }

 private:
  TrianglePairDistance measure(const TrianglePoints& a, const TrianglePoints& b, TriangleIndex triangle_a,
                               TriangleIndex triangle_b);

  const ProofFrame& frame_;
  const CertificateRequest& request_;
  RefinementWorkspace& workspace_;
  CertificateCost& cost_;
  TrianglePairDistance closest_{};
  TriangleIndex triangle_a_;
  TriangleIndex triangle_b_;
  double squared_distance_ = std::numeric_limits<double>::infinity();
  double distance_ = std::numeric_limits<double>::infinity();
  double enough_ = std::numeric_limits<double>::infinity();
  double squared_enough_ = std::numeric_limits<double>::infinity();
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();
  std::uint32_t direction_count_ = 0;
};

}  // namespace concave_distance::detail

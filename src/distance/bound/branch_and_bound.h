#pragma once

#include "bound_cache.h"
#include "box_pair_bounds.h"
#include "certificate.h"
#include "directional_support.h"
#include "distance/kernels/pair_frame.h"
#include "hierarchy_access.h"
#include "leaf_pair.h"

namespace concave_distance::detail {

/// Orders a heap of open pairs so that the least bound comes first.
inline bool isFarther(const CertificateWorkspace::OpenPair& l, const CertificateWorkspace::OpenPair& r) {
  return l.squared_bound > r.squared_bound;
}

/// One proof: descends into every pair of boxes that could hide a pair of points closer than the best one
/// known, and keeps, where a cache is given, what it has excluded with its bound.
class BranchAndBound {
 public:
  BranchAndBound(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                 const CertificateRequest& request, CertificateWorkspace& workspace, BoundCache* cache);
  DistanceCertificate run(const TrianglePair* starts, std::size_t start_count);

 private:
  using Hierarchy = BoundingVolumeHierarchy;
  using Slot = Hierarchy::Slot;
  using OpenPair = CertificateWorkspace::OpenPair;

  void descend(const TrianglePair& start);
  void dive();
  TrianglePair nearestTriangles(const Hierarchy::Leaf& leaf_a, const Hierarchy::Leaf& leaf_b) const;
  TrianglePairDistance measure(const TrianglePoints& a, const TrianglePoints& b, TriangleIndex triangle_a,
                               TriangleIndex triangle_b);

  void beginAtRoots();
  bool partsAtRoots();
  bool isProvenAtOnce();
  void reopenCache();
  void search();
  OpenPair take();
  void add(Slot kept, std::uint32_t opened, std::uint32_t lane, bool opens_b, double squared_bound);
  void expand(const OpenPair& pair);
  void openLeaves(const OpenPair& pair);
  double measureLeaves(const Hierarchy::Leaf& leaf_a, const Hierarchy::Leaf& leaf_b,
                       Eigen::Vector3d& parting);
  double leafSeparation(const Hierarchy::Leaf& leaf_a, const Hierarchy::Leaf& leaf_b,
                        const Eigen::Vector3d& direction) const;
  double separationAlongNormals(const Hierarchy::Leaf& leaf_a, const LeafLanes& b,
                                Eigen::Vector3d& parting) const;
  bool raiseAlongWitnesses(Slot kept, Slot child, bool opens_b, double& squared_bound);
  bool stillParts(std::size_t i, double moved);
  bool opensB(Slot a, Slot b) const {
    if (isLeaf(a_.child(a))) return true;
    return !isLeaf(b_.child(b)) &&
           squaredSize(b_, b) * unit_b_ * unit_b_ >= squaredSize(a_, a) * unit_a_ * unit_a_;
  }
  Lanes childBounds(Slot kept, std::uint32_t opened, bool opens_b, LaneDirections* directions);
  double separationAlongWitnesses(Slot a, Slot b);
  void exclude(double bound) { excluded_ = std::min(excluded_, bound); }
  void excludeSquared(double squared_bound) {
    squared_excluded_ = std::min(squared_excluded_, squared_bound);
  }
  void dropCache();
  DistanceCertificate conclude();

  std::uint8_t subtreeOf(Slot slot_of_b) const { return b_.subtreeOfNode(slot_of_b / Hierarchy::kWidth); }
  std::ptrdiff_t openCount() const { return static_cast<std::ptrdiff_t>(open_count_); }

  const Hierarchy& a_;
  const Hierarchy& b_;
  const PairFrame frame_;
  const Eigen::Matrix3d turned_;  ///< from A's axes to B's
  const CertificateRequest& request_;
  WorkLimit unlimited_;
  WorkLimit& limit_;
  const bool timed_;             ///< then the least bound comes first
  bool cut_ = false;             ///< the limit was reached
  std::vector<OpenPair>& open_;  ///< the first open_count_ of it
  std::size_t open_count_ = 0;
  std::uint32_t asked_again_ = 0;  ///< quads along what parted them last
  std::uint32_t leaves_asked_again_ = 0;
  RefinementWorkspace& refinement_;
  BoundCache* cache_;             ///< null: nothing is kept
  DirectionalSupport support_a_;  ///< along direction_
  DirectionalSupport support_b_;  ///< against it
  const BoundScale scale_;
  const float unit_a_;  ///< reach of A relative to the scale
  const float unit_b_;
  const SinglePose single_a_from_b_;
  const SinglePose single_b_from_a_;
  const double error_;
  DistanceCertificate result_;

  TrianglePairDistance closest_{};
  TriangleIndex triangle_a_;
  TriangleIndex triangle_b_;
  double squared_distance_ = std::numeric_limits<double>::infinity();
  double distance_ = std::numeric_limits<double>::infinity();
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();  ///< from A's witness to B's, unit
  Eigen::Vector3d direction_in_b_ = Eigen::Vector3d::Zero();
  double root_separation_ = 0.0;  ///< of the bodies as wholes, along the first direction
  double offset_along_ = 0.0;     ///< from A's origin to B's along direction_
  bool supports_are_new_ = false;
  double enough_ = std::numeric_limits<double>::infinity();  ///< farther than this need not be opened
  double squared_enough_ = std::numeric_limits<double>::infinity();
  double excluded_ = std::numeric_limits<double>::infinity();  ///< least bound of what was not opened
  double squared_excluded_ = std::numeric_limits<double>::infinity();

  // Boxes are compared several times in a row.
  Slot compared_slot_a_ = Hierarchy::kNoChild;
  Slot compared_slot_b_ = Hierarchy::kNoChild;
  ComparedBox compared_a_;
  ComparedBox compared_b_;
};

}  // namespace concave_distance::detail

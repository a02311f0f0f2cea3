#pragma once

#include "certificate.h"
#include "nearest_triangles.h"
#include "open_pairs.h"
#include "proof_frame.h"
#include "tree_pair_bounds.h"

namespace concave_distance::detail {

/// One proof: opens every pair of boxes that could hide a pair of points closer than the best one known, and
/// keeps, where a cache is given, what it has excluded with its bound.
class BranchAndBound {
 public:
  BranchAndBound(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                 const CertificateRequest& request, CertificateWorkspace& workspace, BoundCache* cache);
  DistanceCertificate run(const TrianglePair* starts, std::size_t start_count);

 private:
  using Hierarchy = BoundingVolumeHierarchy;
  using Slot = Hierarchy::Slot;

  void dive();
  void beginAtRoots();
  bool partsAtRoots();
  bool isProvenAtOnce();
  void reopenCache();
  double reopenLeaves(BoundCache::LeafPair& pair);
  void reopenQuad(std::size_t i, double moved);
  bool stillParts(std::size_t i, double moved);
  void search();
  void expand(const OpenPairs::OpenPair& pair);
  void openLeaves(const OpenPairs::OpenPair& pair);
  BoundCache::Quad* keepQuad(Slot kept, std::uint32_t opened, bool opens_b, const LaneDirections& directions);
  bool raiseAlongWitnesses(Slot kept, Slot child, bool opens_b, double& squared_bound);
  void add(Slot kept, Slot child, bool opens_b, double squared_bound);
  void exclude(double bound) { excluded_ = std::min(excluded_, bound); }
  void excludeSquared(double squared_bound) {
    squared_excluded_ = std::min(squared_excluded_, squared_bound);
  }
  void dropCache();
  DistanceCertificate conclude();

  const Hierarchy::Leaf& leafOfA(Slot slot) const { return leafOf(a_, a_.child(slot)); }
  const Hierarchy::Leaf& leafOfB(Slot slot) const { return leafOf(b_, b_.child(slot)); }
  std::uint8_t subtreeOf(Slot slot_of_b) const { return b_.subtreeOfNode(slot_of_b / Hierarchy::kWidth); }

  const Hierarchy& a_;
  const Hierarchy& b_;
  const ProofFrame frame_;
  WorkLimit unlimited_;
  WorkLimit& limit_;
  bool cut_ = false;               ///< the limit was reached
  BoundCache* cache_;              ///< null: nothing is kept
  std::uint32_t asked_again_ = 0;  ///< quads along what parted them last
  std::uint32_t leaves_asked_again_ = 0;
  double root_separation_ = 0.0;  ///< metres, of the bodies as wholes, along the first direction
  double excluded_ = std::numeric_limits<double>::infinity();  ///< least bound of what was not opened
  double squared_excluded_ = std::numeric_limits<double>::infinity();
  DistanceCertificate result_;
  OpenPairs open_;
  NearestTriangles nearest_;
  TreePairBounds bounds_;
};

}  // namespace concave_distance::detail

#pragma once

#include "box_pair_bounds.h"
#include "distance/kernels/triangle_distance.h"
#include "proof_frame.h"

namespace concave_distance::detail {

/// Holds the triangles of one of B's leaves in the local frame of A, lane by lane.
struct LeafLanes {
  LeafLanes(const BoundingVolumeHierarchy::Leaf& leaf, const Eigen::Matrix3d& rotation,
            const Eigen::Vector3d& offset);

  void computeNormals();
  TrianglePoints triangle(std::size_t lane) const;

  Lanes corner[3][3];    ///< [corner][coordinate]
  Lanes normal[3];       ///< of each triangle, not normalised; set by computeNormals()
  Lanes squared_normal;  ///< squared lengths of `normal`
};

inline TrianglePoints triangleOf(const BoundingVolumeHierarchy::Leaf& leaf, std::size_t lane) {
  TrianglePoints points;
  for (std::size_t k = 0; k < 3; ++k) {
    points[k] = {leaf.corner[k][0][lane], leaf.corner[k][1][lane], leaf.corner[k][2][lane]};
  }
  return points;
}

/// Returns the sum of the lanes' normals, not normalised, frame of the leaf.
Eigen::Vector3d sumOfNormals(const BoundingVolumeHierarchy::Leaf& leaf);
/// Returns the same of a leaf whose normals are computed.
Eigen::Vector3d sumOfNormals(const LeafLanes& leaf);

/// Returns the least value of `direction` over the corners of each lane.
Lanes leastAlong(const LeafLanes& leaf, const Eigen::Vector3d& direction);

/// Returns the greatest value of `direction` over the corners of each lane, frame of the leaf.
Lanes mostAlong(const BoundingVolumeHierarchy::Leaf& leaf, const Eigen::Vector3d& direction);

/// Returns how far a's plane or the lane's own plane parts triangle `a` from each lane; metres, 0 where
/// neither does. Needs the leaf's normals.
Lanes planeSeparation(const TrianglePoints& a, const LeafLanes& b);

/// Returns how far two leaves are apart along a unit direction from A to B, metres; negative where they
/// overlap along it.
double separationAlong(const BoundingVolumeHierarchy::Leaf& leaf_a,
                       const BoundingVolumeHierarchy::Leaf& leaf_b, const Eigen::Vector3d& direction,
                       const ProofFrame& frame);

/// Returns how far leaves are apart along the mean of either leaf's normals, which parts leaves that bend
/// little, and that normal; metres, 0 where neither reaches `enough`. Needs the normals of `b`.
double separationAlongNormals(const BoundingVolumeHierarchy::Leaf& leaf_a, const LeafLanes& b, double slack,
                              double enough, Eigen::Vector3d& parting);

/// Returns the pair of triangles whose centres are nearest to each other.
TrianglePair nearestByCentres(const BoundingVolumeHierarchy::Leaf& leaf_a,
                              const BoundingVolumeHierarchy::Leaf& leaf_b, const ProofFrame& frame);

}  // namespace concave_distance::detail

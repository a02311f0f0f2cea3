#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/trial_point.h"
#include "concave_distance/tracking/pair_solution.h"
#include "distance/kernels/witness_refinement.h"
#include "distance/niches/niche_properties.h"

namespace concave_distance {

/// Two bodies at one pose with the buffers of the exact levels: what following and admitting niches share.
struct PairGeometry {
  PairGeometry(std::shared_ptr<const BodyMesh> body_a, std::shared_ptr<const BodyMesh> body_b)
      : a(std::move(body_a)), b(std::move(body_b)) {}

  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d b_from_a = Eigen::Isometry3d::Identity();
  RefinementWorkspace refinement;
  std::vector<NodeIndex> ring_a;  ///< nodes around a pair's genes, for level `nodes`
  std::vector<NodeIndex> ring_b;

  void setPose(const Eigen::Isometry3d& pose) {
    a_from_b = pose;
    b_from_a = pose.inverse(Eigen::Isometry);
  }
  double scale() const { return a->diameter() + b->diameter(); }
  /// Two refined witnesses nearer than this on both bodies are one, metres: far above the rounding of the
  /// kernels, far below any feature.
  double samePlaceTolerance() const { return 1e-7 * scale(); }

  WitnessRefinement refine(TriangleIndex triangle_a, TriangleIndex triangle_b) {
    return refineWitness(*a, *b, a_from_b, triangle_a, triangle_b, refinement);
  }
  /// The node nearest to each witness among those of its triangle's corners: where a search takes a refined
  /// niche up again.
  TrialPoint nodePairNear(const WitnessPair& witness) const;
  /// The node pair as a witness pair, for level `nodes`.
  WitnessPair nodeWitness(const TrialPoint& pair) const;
};

/// Places a record at a witness: points, distance, normal. Keeps id, birth and flags.
void placeRecord(struct NicheRecord& record, const PairGeometry& geometry, const WitnessPair& witness);

/// Keeps the points of a record on their bodies and measures them at the present pose: an upper bound of its
/// minimum.
void carryRecord(struct NicheRecord& record, const PairGeometry& geometry);

}  // namespace concave_distance

#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/tracking/pair_solution.h"
#include "distance/kernels/witness_refinement.h"

namespace concave_distance {

/// Tracks a single solution (Carretero, sec. 4.1): the last cycle's closest pair is the only guess, moved
/// downhill to the local minimum that it leads to, which is the next cycle's guess. It does not learn of
/// other minima. Kept to show where it goes wrong, beside niche tracking.
class SingleMinimum {
 public:
  SingleMinimum(std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b);

  /// Begins at a pair of triangles, e.g. a first solve's.
  void start(TriangleIndex triangle_a, TriangleIndex triangle_b);
  bool started() const { return started_; }
  /// @return the minimum reached from the last one
  const WitnessPair& update(const Eigen::Isometry3d& a_from_b);
  const WitnessPair& witness() const { return witness_; }
  double distance() const;  ///< of it, metres; NaN before the first update
  /// Returns whether the minimum followed is farther than the proven distance, so that the guess was wrong.
  bool wrong(const PairSolution& proven) const;

 private:
  std::shared_ptr<const BodyMesh> a_;
  std::shared_ptr<const BodyMesh> b_;
  RefinementWorkspace workspace_;
  WitnessPair witness_;
  bool started_ = false;
  bool updated_ = false;
};

}  // namespace concave_distance

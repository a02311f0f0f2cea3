#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

/// One pair of bodies over time: each cycle is warm-started from the niches of the last one (Carretero, sec.
/// 6.2.2), every niche is re-descended, refined and matched to its persistent id. Not thread-safe; different
/// trackers may run in parallel. A warm cycle allocates nothing.
class PairTracker {
 public:
  /// @param name keys the random streams, with the seed and the cycle
  /// @param largest_used_id niche ids are greater than this
  /// @throws Error for parameters out of range
  PairTracker(std::string name, std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
              const TrackerParameters& parameters, std::uint64_t largest_used_id = 0);
  ~PairTracker();
  PairTracker(PairTracker&&) noexcept;
  PairTracker& operator=(PairTracker&&) noexcept;

  /// Solves at one pose. @param a_from_b rigid, rotation orthonormal within 1e-3, else status InvalidPose
  /// @param time seconds of the transforms, for velocities; a time not after the last one gives no velocity
  /// `solution` keeps its capacity.
  void update(const Eigen::Isometry3d& a_from_b, double time, PairSolution& solution);

  /// Forgets all niches: the next cycle is cold. Ids go on counting.
  void reset();

  /// Takes effect at the next cycle. @throws Error for parameters out of range
  void setParameters(const TrackerParameters& parameters);
  const TrackerParameters& parameters() const;
  std::size_t memoryBytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A cold, independent solve: same answer as the first cycle of a tracker with that name and seed.
PairSolution solveOnce(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                       const std::shared_ptr<const BodyMesh>& b, const TrackerParameters& parameters,
                       const Eigen::Isometry3d& a_from_b);

}  // namespace concave_distance

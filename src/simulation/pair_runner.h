#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>

#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/tracked_pair.h"
#include "concave_distance/simulation/simulation.h"
#include "coupling.h"
#include "single_minimum.h"

namespace concave_distance::detail {

/// The wrenches of a pair's contacts on B, world axes, about the world's origin.
struct ContactWrenches {
  Wrench normal;
  Wrench friction;
};

/// One pair of a simulation: distance, contacts and the single minimum at each pose.
class PairRunner {
 public:
  /// @throws Error for a pair whose level proves no distance
  /// @param index of the pair in the scene
  PairRunner(const Scene& scene, std::size_t index, const SimulationSettings& settings);

  /// Sets whether the next update() lists the niches, in a simulation that follows them.
  void wantNiches(bool wanted) { tracked_.demand.niches = follows_niches_ && wanted; }

  /// Solves at the bodies' poses. @param step seconds since the last call
  void update(double time, double step, const SimulatedBody& a, const SimulatedBody& b, SimulatedPair& pair,
              SimulationCounters& counters);
  static ContactWrenches wrenchesOnB(const SimulatedPair& pair, const Eigen::Isometry3d& world_from_a);

  /// Returns what the forces of the pair's contacts come to, about A's origin, A's axes, on B.
  static CouplingForce forceOnB(const SimulatedPair& pair, const SimulatedBody& a, const SimulatedBody& b);

  /// Returns whether its effects bring forces; a pair without forces holds no step back.
  bool hasForces() const { return tracked_.settings.effects.normal_force.has_value(); }
  /// A lower estimate of the depth that the pair's next contact reaches, metres; 0 without forces.
  double expectedDepth(const ContactLoad& load, double size) const;

  /// Bristles and regions of the last update() are kept, and returned to.
  void keep() { tracked_.effects.keep(); }
  void goBack() { tracked_.effects.goBack(); }

 private:
  void followSingle(SimulatedPair& pair);
  void countSolve(SimulatedPair& pair, SimulationCounters& counters);

  TrackedPair tracked_;
  bool follows_niches_;
  ContactMaterial material_;
  std::optional<SingleMinimum> single_;
};

}  // namespace concave_distance::detail

#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>

#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/tracked_pair.h"
#include "concave_distance/simulation/simulation.h"
#include "single_minimum.h"

namespace concave_distance::detail {

/// The wrenches of a pair's contacts on B, world axes, about the world's origin.
struct ContactWrenches {
  Wrench normal;
  Wrench friction;
};

/// How stiff and how damped one contact is: what a step has to resolve.
struct ContactRates {
  NormalForce normal;
  FrictionRates friction;
};

/// The sum of the stiffnesses and dampings of a pair's contacts, each with the compliance of the bodies
/// there.
struct ContactSpeeds {
  double stiffness_rate = 0.0;  ///< 1/s^2
  double damping_rate = 0.0;    ///< 1/s
};

/// One pair of a simulation: distance, contacts and the single minimum at each pose.
class PairRunner {
 public:
  /// @throws Error for a pair whose level proves no distance
  /// @param index of the pair in the scene
  PairRunner(const Scene& scene, std::size_t index, const SimulationSettings& settings);

  /// Solves at the bodies' poses. @param step seconds since the last call
  void update(double time, double step, const SimulatedBody& a, const SimulatedBody& b, SimulatedPair& pair,
              SimulationCounters& counters);
  static ContactWrenches wrenchesOnB(const SimulatedPair& pair, const Eigen::Isometry3d& world_from_a);

  /// @param compliance (point in the world, direction) -> 1/kg, of both bodies together
  template <typename Compliance>
  ContactSpeeds speeds(const SimulatedPair& pair, const Eigen::Isometry3d& world_from_a, double step,
                       const Compliance& compliance) const {
    ContactSpeeds speeds;
    for (const ContactRegion& region : pair.contacts.regions) {
      if (!(region.overlap.depth > 0.0) || !(region.normal_force >= 0.0)) continue;
      const Eigen::Vector3d point = world_from_a * region.point_in_a;
      const Eigen::Vector3d normal = world_from_a.linear() * region.overlap.normal_in_a;
      const ContactRates rates = ratesOf(region, step);
      const double along = compliance.along(point, normal);
      const double across = compliance.largest(point);
      speeds.stiffness_rate += rates.normal.stiffness * along + rates.friction.stiffness * across;
      speeds.damping_rate += rates.normal.damping * along + rates.friction.damping * across;
    }
    return speeds;
  }

 private:
  ContactRates ratesOf(const ContactRegion& region, double step) const;
  void followSingle(SimulatedPair& pair);
  void countSolve(SimulationCounters& counters);

  TrackedPair tracked_;
  ContactMaterial material_;
  std::optional<SingleMinimum> single_;
};

}  // namespace concave_distance::detail

#pragma once

#include <string>
#include <vector>

#include "base/random_engine.h"
#include "benchmark/support/motion_stage.h"

namespace concave_distance::benchmark {

/// Draws motions of an arm on a stage:
/// - short: two waypoints, up to 0.3 rad for each joint
/// - long: four to six waypoints
/// - near: two to four, comes as near as 50 mm and touches nothing
/// - colliding: two to four, each clear of all, and a contact between them
/// - cubic: as near, with velocities at the waypoints
/// - grazing: the same way moved aside until it just touches, and then 1e-6 to 1e-2 of that more or less
class RandomMotions {
 public:
  static const std::vector<std::string>& kinds();

  /// @param path CSV of joint positions that the motions begin and end around
  /// @param from seconds of it, as `to`
  /// @param share of the waypoints that are around the path; the others are anywhere in the joints' ranges
  RandomMotions(const MotionStage& stage, const std::string& path, double from, double to, double share,
                std::uint64_t seed);

  Motion draw(const std::string& kind);

 private:
  double uniform(double lowest, double highest);
  Eigen::VectorXd drawPositions();
  Motion drawAny(std::size_t waypoints);
  Motion drawNear(std::size_t waypoints);
  Motion drawColliding(std::size_t waypoints);
  Motion drawGrazing(std::size_t waypoints);
  bool isClear(const Eigen::VectorXd& positions) const;
  bool touches(const Motion& motion) const;

  const MotionStage& stage_;
  std::vector<Eigen::VectorXd> path_;
  double share_;
  RandomEngine engine_;
};

/// The motions of a stage, by the demo's path there.
RandomMotions motionsOf(const MotionStage& stage, std::uint64_t seed);

}  // namespace concave_distance::benchmark

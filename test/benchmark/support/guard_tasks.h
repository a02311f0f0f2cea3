#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "concave_distance/kinematics/scene_kinematics.h"

namespace concave_distance::benchmark {

/// A robot among obstacles and who drives it, for runs of a guard in a closed loop. Whether it touches
/// anything is judged by code of its own, from the joints' positions on: its kinematics too.
class GuardTask {
 public:
  virtual ~GuardTask() = default;
  virtual const Scene& scene() const = 0;
  /// Begins a run: start, goal and obstacles by its number.
  virtual Eigen::VectorXd begin(std::uint64_t number) = 0;
  /// The velocities that the driver wants, rad/s and m/s.
  virtual Eigen::VectorXd command(double time, const Eigen::VectorXd& positions) = 0;
  virtual bool hasArrived(const Eigen::VectorXd& positions) = 0;
  virtual bool touches(const Eigen::VectorXd& positions) = 0;
  virtual void moveObstacles(double /*step*/, const Eigen::VectorXd& /*positions*/) {}
  virtual void placeObstacles(SceneState& /*state*/) const {}
  virtual double acceleration() const = 0;  ///< rad/s^2 and m/s^2, of every joint
  virtual double rowDistance() const = 0;   ///< metres
  virtual double timeLimit() const = 0;     ///< s
};

/// The demo arm in its cell: from anywhere to anywhere.
std::unique_ptr<GuardTask> makeArmTask();
/// Begins with the arm's hand in the crate, which it has to leave.
std::unique_ptr<GuardTask> makeCrateTask();
/// A mobile base between three walls, with a driver who steers roughly: it has to come out.
std::unique_ptr<GuardTask> makeNarrowTask();
/// The base crosses a hall with obstacles that move, and turn back before it.
std::unique_ptr<GuardTask> makeCrossingTask();

}  // namespace concave_distance::benchmark

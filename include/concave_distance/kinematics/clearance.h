#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "concave_distance/base/eigen_alignment.h"
#include "concave_distance/base/not_computed.h"
#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance {

/// A motion of joints. Between two waypoints every position runs on a straight line, angles as they are given
/// (nothing is wrapped to the shorter way round); a floating joint's translation runs straight and its
/// quaternion turns by the smaller angle at constant speed (slerp). With velocities every position but those
/// of floating joints runs on the cubic that has them at the waypoints, with accelerations too on the quintic
/// that has both, as joint_trajectory_controller plays them.
struct JointMotion {
  /// As SceneKinematics::positionNames(), any of them: joints that are not named stay as they are in the
  /// state. Joints that mimic a named one follow it. Planar and floating joints need all their numbers.
  std::vector<std::string> joints;
  std::vector<double> times;      ///< s, ascending; empty: the waypoints' numbers 0, 1, 2
  Eigen::MatrixXd positions;      ///< rad or m, a row for each waypoint, a column for each name
  Eigen::MatrixXd velocities;     ///< rad/s or m/s, likewise; empty: none
  Eigen::MatrixXd accelerations;  ///< rad/s^2 or m/s^2, likewise, with velocities alone; empty: none
};

/// A motion of one body, with what is attached to it (Attachment): from waypoint to waypoint the translation
/// runs straight and the rotation by the smaller angle at constant speed (slerp).
struct PoseMotion {
  std::string body;
  std::vector<double> times;               ///< as in JointMotion
  std::vector<Eigen::Vector3d> positions;  ///< m, of the body in the world as SceneState::world_from_body
  std::vector<Eigen::Quaterniond, Eigen::aligned_allocator<Eigen::Quaterniond>> rotations;  ///< unit
};

struct ClearanceProgress {
  double fraction = 0.0;           ///< of all pairs' motions that is proven no nearer than the answer
  double distance = kNotComputed;  ///< metres: least distance found so far; infinite before the first
  double lower_bound = kNotComputed;
  std::uint64_t queries = 0;
};

struct ClearanceParameters {
  double tolerance = 1e-3;  ///< metres: lower_bound may stay this far below the distance
  /// Metres; the first time below it is looked for. Empty: only that of contact, if there is contact.
  std::optional<double> threshold;
  double time_budget = std::numeric_limits<double>::infinity();  ///< s
  /// Pairs at one time that are looked at, by boxes or exactly; some 300 bytes each.
  std::uint64_t sample_limit = 2'000'000;
  bool each_pair = false;                   ///< proves every pair's own least distance to the tolerance
  bool niches = false;                      ///< adds all niches of the nearest pair at the least time
  std::uint32_t threads = 0;                ///< 0: one per core
  const std::atomic<bool>* stop = nullptr;  ///< set: ends as if the time had run out
  /// Called by the calling thread, about ten times a second.
  std::function<void(const ClearanceProgress&)> progress;
};

enum class ClearanceStatus : std::uint8_t {
  Ok,           ///< lower_bound is within the tolerance of the distance
  Penetrating,  ///< bodies touch or overlap at `time`: distance and lower_bound are 0
  /// Time or samples ran out first, or rounding allows no proof to the tolerance; lower_bound holds.
  BudgetExhausted,
  NoPairs  ///< the motion moves no watched pair of bodies whose poses are known
};
std::string_view toString(ClearanceStatus status);

/// Holds what is known of one pair over the whole motion.
struct PairClearance {
  std::size_t body_a = 0;  ///< in Scene::bodies
  std::size_t body_b = 0;
  double lower_bound = kNotComputed;  ///< metres, proven for every time of the motion
  /// Metres, at `time`; NaN where the pair was never nearer than the answer and its distance not computed.
  double distance = kNotComputed;
  double time = kNotComputed;  ///< s
};

/// When a distance first falls below the threshold.
struct FirstBelow {
  /// Proven: before this time (s) no pair is below the threshold. That of the last waypoint and more, where
  /// none is.
  double proven_until = kNotComputed;
  double time = kNotComputed;  ///< s: here a pair is below; NaN: none was found
  std::size_t body_a = 0;
  std::size_t body_b = 0;
};

struct ClearanceResult {
  ClearanceStatus status = ClearanceStatus::NoPairs;
  double distance = kNotComputed;     ///< metres, margins taken off: of the pair below, at `time`
  double lower_bound = kNotComputed;  ///< metres, proven: at no time of the motion is any pair nearer
  double time = kNotComputed;         ///< s
  std::size_t body_a = 0;             ///< in Scene::bodies
  std::size_t body_b = 0;
  Eigen::Vector3d point_a = Eigen::Vector3d::Constant(kNotComputed);  ///< world, metres, at `time`
  Eigen::Vector3d point_b = Eigen::Vector3d::Constant(kNotComputed);
  Eigen::Isometry3d world_from_a = Eigen::Isometry3d::Identity();  ///< at `time`
  /// Holds the nearest pair at `time` with its niches, in A's frame, where that was asked for.
  std::optional<PairSolution> solution;
  std::optional<FirstBelow> first_below;  ///< with a threshold, or where there is contact
  std::vector<PairClearance> pairs;       ///< all that the motion moves against each other
  /// Bodies that the motion might move against others, but whose poses are not known: nothing is proven of
  /// their pairs.
  std::vector<std::size_t> not_located;
  /// Names of positions that leave the range that the URDF gives them.
  std::vector<std::string> outside_limits;
  /// Velocities were given and not used for a floating joint.
  bool velocities_ignored = false;
  std::uint64_t queries = 0;      ///< certified distances
  std::uint64_t box_queries = 0;  ///< bounds by boxes alone
  double seconds = kNotComputed;  ///< that the computation took
};

/// Finds the least distance over a whole motion, between the waypoints too, with a proof (doc/clearance.md):
/// each certified distance holds around its time for as long as no point can have moved farther than it
/// allows. Looks at the pairs of Scene::pairs and Scene::rules that the motion moves against each other,
/// those listed and disabled and cutoffs aside: a listed pair must be enabled, and no cutoff counts.
/// @param joints of this scene
/// @param state where everything is that the motion does not move, and the roots of robots
/// @throws Error for a motion without waypoints or with times that do not ascend, sizes that differ, numbers
///         that are not finite, unknown or repeated joints, a robot that has left the scene, an unknown body,
///         and parameters out of range
[[nodiscard]] ClearanceResult findClearance(const Scene& scene, const SceneKinematics& joints,
                                            const SceneState& state, const JointMotion& motion,
                                            const ClearanceParameters& parameters = {});
/// Does so for a body on no robot, or one that a robot's link carries: it leaves the link.
[[nodiscard]] ClearanceResult findClearance(const Scene& scene, const SceneKinematics& joints,
                                            const SceneState& state, const PoseMotion& motion,
                                            const ClearanceParameters& parameters = {});

}  // namespace concave_distance

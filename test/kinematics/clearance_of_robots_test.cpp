// Clearance of random motions of whole robots, against dense samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "clearance_fixture.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "support/robots.h"

namespace concave_distance::clearance_of_robots_test {
namespace {

using test::ClearanceTest;
using test::kRounding;

/// Straight lines through random positions of all joints.
JointMotion randomMotion(const SceneKinematics& joints, std::size_t waypoints, std::mt19937& engine) {
  JointMotion motion;
  motion.joints = joints.positionNames();
  motion.positions.resize(static_cast<Eigen::Index>(waypoints),
                          static_cast<Eigen::Index>(motion.joints.size()));
  for (std::size_t row = 0; row < waypoints; ++row) {
    motion.times.push_back(static_cast<double>(row));
    motion.positions.row(static_cast<Eigen::Index>(row)) =
        test::randomPositions(*joints.robots().front(), engine).transpose();
  }
  return motion;
}

/// The positions of a straight motion at a share of a segment, quaternions of floating joints by slerp.
Eigen::VectorXd positionsAt(const RobotKinematics& robot, const JointMotion& motion, Eigen::Index segment,
                            double share) {
  const Eigen::VectorXd from = motion.positions.row(segment).transpose();
  const Eigen::VectorXd to = motion.positions.row(segment + 1).transpose();
  Eigen::VectorXd positions = (1.0 - share) * from + share * to;
  for (Eigen::Index i = 0; i + 3 < positions.size(); ++i) {
    const std::string& name = robot.positionNames()[static_cast<std::size_t>(i)];
    if (name.size() < 6 || name.compare(name.size() - 6, 6, "/rot_x") != 0) continue;
    const auto rotation = [i](const Eigen::VectorXd& of) {
      return Eigen::Quaterniond(Eigen::Vector4d(of.segment<4>(i))).normalized();
    };
    positions.segment<4>(i) = rotation(from).slerp(share, rotation(to)).coeffs();
  }
  return positions;
}

class MotionsOfRobots : public ClearanceTest {
 protected:
  /// Compares each pair at many times with its bracket.
  void compareWithSamples(const JointMotion& motion, int samples_of_segment) {
    const ClearanceResult result = clearance(motion);
    ASSERT_FALSE(result.pairs.empty());
    ASSERT_NE(result.status, ClearanceStatus::BudgetExhausted);
    ASSERT_GE(result.lower_bound, result.distance - parameters.tolerance);
    contacts += result.status == ClearanceStatus::Penetrating ? 1 : 0;
    std::vector<PairTracker> trackers;
    TrackerParameters distance_alone;
    distance_alone.niches_wanted = false;
    for (const PairClearance& pair : result.pairs) {
      trackers.emplace_back("pair", scene.bodies[pair.body_a].mesh, scene.bodies[pair.body_b].mesh,
                            distance_alone);
    }
    double least = std::numeric_limits<double>::infinity();
    PairSolution solution;
    for (Eigen::Index segment = 0; segment + 1 < motion.positions.rows(); ++segment) {
      for (int k = 0; k <= samples_of_segment; ++k) {
        const double share = static_cast<double>(k) / samples_of_segment;
        joints->evaluate(positionsAt(*joints->robots().front(), motion, segment, share), state);
        for (std::size_t i = 0; i < trackers.size(); ++i) {
          const PairClearance& pair = result.pairs[i];
          const Eigen::Isometry3d a_from_b =
              state.world_from_body[pair.body_a]->inverse() * *state.world_from_body[pair.body_b];
          trackers[i].update(a_from_b, 0.0, solution);
          least = std::min(least, solution.distance);
          ASSERT_GE(solution.distance, pair.lower_bound - kRounding)
              << scene.bodies[pair.body_a].name << " and " << scene.bodies[pair.body_b].name << " at segment "
              << segment << ", share " << share;
        }
        if (!result.first_below || std::isnan(result.first_below->time)) continue;
        const double time = static_cast<double>(segment) + share;
        if (time < result.first_below->proven_until) {
          ASSERT_GE(least, parameters.threshold.value_or(1e-300));
        }
      }
    }
    ASSERT_LE(result.lower_bound, least + kRounding);
    ++motions;
  }

  int contacts = 0;
  int motions = 0;
};

TEST_F(MotionsOfRobots, OfTheArmInTheCellAreNeverNearerThanProven) {
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  options.descriptions["robot_description"] = test::packageFile("urdf/wam.urdf");
  use(loadSceneFile(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/config/cell.yaml", options));
  std::mt19937 engine(5);
  for (int trial = 0; trial < 12; ++trial) {
    if (trial % 3 == 1) parameters.threshold = 0.05;
    if (trial % 3 == 2) parameters.threshold.reset();
    JointMotion motion = randomMotion(*joints, 3, engine);
    // Small motions stay apart more often.
    for (Eigen::Index row = 1; row < 3 && trial % 2 == 0; ++row) {
      motion.positions.row(row) =
          motion.positions.row(0) + 0.05 * (motion.positions.row(row) - motion.positions.row(0));
    }
    compareWithSamples(motion, 60);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(contacts, 0);
  EXPECT_LT(contacts, motions);
}

TEST_F(MotionsOfRobots, OfEveryTypeOfJointAreNeverNearerThanProven) {
  options.descriptions["robot"] = test::mobileRobot();
  use(load(
      "defaults: {max_edge_length: 100}\nrobots:\n  - {description: robot}\n"
      "bodies:\n  - {name: ball, frame: world, sphere: {radius: 0.1}, pose: {xyz: [2.5, 0.5, 0.5]}}\n"
      "  - {name: post, frame: world, box: {size: [0.1, 0.1, 3]}, pose: {xyz: [-2, 1, 0]}, margin: 0.02}\n"));
  std::mt19937 engine(6);
  parameters.each_pair = true;
  for (int trial = 0; trial < 6; ++trial) {
    compareWithSamples(randomMotion(*joints, 3, engine), 60);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace concave_distance::clearance_of_robots_test

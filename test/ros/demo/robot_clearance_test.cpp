#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "benchmark/support/fcl_distance.h"
#include "benchmark/support/joint_path.h"
#include "concave_distance/loading/load_scene.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "loading/query_poses.h"
#include "simulation/pose_path.h"

namespace concave_distance::demo::robot_clearance_test {
namespace {

using benchmark::FclModel;
using benchmark::NamedJointPath;
using benchmark::readJointPath;

const std::string kPackage = CONCAVE_DISTANCE_SOURCE_DIR;

std::string readText(const std::string& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// Loaded once for all tests: the meshes' metrics take seconds.
const Scene& robotScene() {
  static const Scene scene = [] {
    SceneLoadOptions options;
    options.package_locator = [](const std::string&) { return kPackage; };
    options.descriptions["robot_description"] = readText(kPackage + "/urdf/wam.urdf");
    return loadSceneFile(kPackage + "/config/robot.yaml", options);
  }();
  return scene;
}

/// Poses of the URDF's links in its root for joint positions given by name.
class LinkPoses {
 public:
  explicit LinkPoses(const std::string& urdf) : model_(urdf::parseURDF(urdf)) {}

  std::map<std::string, Eigen::Isometry3d> at(const std::map<std::string, double>& positions) const {
    std::map<std::string, Eigen::Isometry3d> poses;
    place(*model_->getRoot(), Eigen::Isometry3d::Identity(), positions, poses);
    return poses;
  }

 private:
  static void place(const urdf::Link& link, const Eigen::Isometry3d& pose,
                    const std::map<std::string, double>& positions,
                    std::map<std::string, Eigen::Isometry3d>& poses) {
    poses[link.name] = pose;
    for (const urdf::JointSharedPtr& joint : link.child_joints) {
      const urdf::Pose& origin = joint->parent_to_joint_origin_transform;
      Eigen::Isometry3d child = pose;
      child.translate(Eigen::Vector3d(origin.position.x, origin.position.y, origin.position.z));
      child.rotate(
          Eigen::Quaterniond(origin.rotation.w, origin.rotation.x, origin.rotation.y, origin.rotation.z));
      if (joint->type == urdf::Joint::REVOLUTE) {
        child.rotate(Eigen::AngleAxisd(positions.at(joint->name),
                                       Eigen::Vector3d(joint->axis.x, joint->axis.y, joint->axis.z)));
      }
      const auto next =
          std::find_if(link.child_links.begin(), link.child_links.end(),
                       [&](const urdf::LinkSharedPtr& l) { return l->name == joint->child_link_name; });
      place(**next, child, positions, poses);
    }
  }

  urdf::ModelInterfaceSharedPtr model_;
};

/// The robot demo in motion.
class RobotDemo {
 public:
  RobotDemo()
      : links_(readText(kPackage + "/urdf/wam.urdf")),
        wam_(readJointPath(kPackage + "/config/wam_path.csv")) {
    // How far a point of the arm can be from the axis of each joint, metres: shoulder to tip 0.927, the
    // elbow's offset 0.045 and the links' radii of less than 0.1; from the wrist on 0.077 and 0.1.
    const double reach[] = {1.1, 1.1, 1.1, 0.55, 0.5, 0.2, 0.1};
    travel_.push_back(0.0);
    for (double time = 0.0; time < wam_.path.period(); time += kStep) {
      const Eigen::VectorXd change = wam_.path.at(time + kStep) - wam_.path.at(time);
      double displacement = 0.0;
      for (Eigen::Index joint = 0; joint < change.size(); ++joint) {
        displacement += std::abs(change[joint]) * reach[joint];
      }
      travel_.push_back(travel_.back() + displacement);
    }
  }

  double period() const { return wam_.path.period(); }

  Eigen::Isometry3d poseOf(const std::string& frame, double time) const {
    const Eigen::VectorXd positions = wam_.path.at(time);
    std::map<std::string, double> by_name;
    for (std::size_t joint = 0; joint < wam_.joints.size(); ++joint) {
      by_name[wam_.joints[joint]] = positions[static_cast<Eigen::Index>(joint)];
    }
    return links_.at(by_name).at(frame);
  }

  /// The first time after `time` at which two bodies that are `distance` apart now could touch: no point of
  /// the arm travels farther until then, and two of its points together not more than the sum over all
  /// joints.
  double earliestContact(double time, double distance) const {
    const auto now = static_cast<std::size_t>(time / kStep);
    const auto then = std::upper_bound(travel_.begin() + static_cast<std::ptrdiff_t>(now), travel_.end(),
                                       travel_[now] + distance);
    return static_cast<double>(then - travel_.begin() - 1) * kStep;
  }

  static constexpr double kStep = 1e-3;  // seconds

 private:
  LinkPoses links_;
  NamedJointPath wam_;
  std::vector<double> travel_;  ///< metres, bound, summed up to each step
};

/// FCL's distance; 0 or below when the meshes touch or cross.
double distanceOf(const FclModel& a, const FclModel& b, const Eigen::Isometry3d& a_from_b) {
  return benchmark::fclDistance(a, b, a_from_b).distance;
}

std::shared_ptr<const FclModel> loadFclModel(const std::string& path) {
  return benchmark::makeFclModel(repairMesh(importMesh(path), {}, path).mesh);
}

TEST(RobotDemo, HasThirtyFivePairsAndTwelveOfThemBetweenBodiesOfFiveThousandTriangles) {
  const Scene& scene = robotScene();
  EXPECT_TRUE(scene.problems.empty());
  int enabled = 0;
  int large = 0;
  for (const ScenePair& pair : allPairs(scene)) {
    if (!pair.enabled) continue;
    ++enabled;
    const auto size = [&](std::size_t body) { return scene.bodies[body].mesh->surface().triangleCount(); };
    if (size(pair.body_a) >= 5000 && size(pair.body_b) >= 5000) ++large;
  }
  EXPECT_EQ(enabled, 35);
  EXPECT_EQ(large, 12);
}

TEST(RobotDemo, NeverComesNearerThanACentimetre) {
  const Scene& scene = robotScene();
  const RobotDemo demo;
  std::vector<std::shared_ptr<const FclModel>> models;
  for (const SceneBody& body : scene.bodies) models.push_back(benchmark::makeFclModel(body.mesh->surface()));
  constexpr double kLeast = 0.01;  // metres
  for (const ScenePair& pair : allPairs(scene)) {
    if (!pair.enabled) continue;
    const SceneBody& a = scene.bodies[pair.body_a];
    const SceneBody& b = scene.bodies[pair.body_b];
    // From one time to the next at which the pair could have come within the limit.
    for (double time = 0.0; time < demo.period();) {
      const Eigen::Isometry3d a_from_b = demo.poseOf(a.frame, time).inverse() * demo.poseOf(b.frame, time);
      const double distance = distanceOf(*models[pair.body_a], *models[pair.body_b], a_from_b);
      ASSERT_GT(distance, kLeast) << pair.name << " at " << time << " s";
      time = std::max(demo.earliestContact(time, distance - kLeast), time + RobotDemo::kStep);
    }
  }
}

const std::string kFolder = kPackage + "/meshes/thesis/";

// Between hexagonal pins and holes, of circumradius 0.055 and 0.085, once the battery is aligned: the
// apothems differ by 0.03 cos 30 deg. The meshes are in single precision.
constexpr double kPinClearance = 0.0259807;

TEST(InsertionManoeuvre, KeepsClearOfTheFixtureThroughoutAtAThousandHertz) {
  const PosePath path(readPosePath(kFolder + "manoeuvre_200.csv"));
  const auto fixture = loadFclModel(kFolder + "fixture.stl");
  const auto battery = loadFclModel(kFolder + "battery.stl");
  double least = 1e9;
  double least_time = 0.0;
  for (int step = 0; step <= 20'000; ++step) {
    const double time = step * 1e-3;
    const double distance = distanceOf(*fixture, *battery, path.poseAt(time));
    if (distance < least) {
      least = distance;
      least_time = time;
    }
  }
  EXPECT_NEAR(least, kPinClearance, 1e-6) << "at " << least_time << " s";
}

TEST(InsertionManoeuvre, HasTwoHundredStepsAtTenHertzThatEndInserted) {
  const PosePath path(readPosePath(kFolder + "manoeuvre_200.csv"));
  EXPECT_DOUBLE_EQ(path.startTime(), 0.1);
  EXPECT_DOUBLE_EQ(path.endTime(), 20.0);
  EXPECT_TRUE(path.poseAt(20.0).linear().isIdentity(1e-12));
  // Approach with rotation, then a straight insertion.
  EXPECT_GT(Eigen::AngleAxisd(path.poseAt(0.1).linear()).angle(), 1.0);
  EXPECT_TRUE(path.poseAt(10.0).linear().isIdentity(1e-12));
  EXPECT_LT(path.poseAt(20.0).translation().z(), 0.1);
}

}  // namespace
}  // namespace concave_distance::demo::robot_clearance_test

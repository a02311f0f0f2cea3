#include <fcl/narrowphase/collision.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>

#include "benchmark/support/fcl_distance.h"
#include "benchmark/support/guard_tasks.h"
#include "concave_distance/loading/load_scene.h"
#include "support/robots.h"

namespace concave_distance::benchmark {
namespace {

using Eigen::Isometry3d;
using Eigen::VectorXd;

constexpr double kFastest = 1.0;          // rad/s
constexpr double kGain = 2.0;             // 1/s
constexpr double kArrived = 0.03;         // rad
constexpr double kBeginsInCrate = 11.75;  // s of the demo's path: the hand stands still in the crate
constexpr double kIsOut = 14.5;           // s of the path: it is above the crate
constexpr double kPathStep = 0.1;         // s of the path from one of the driver's targets to the next

Scene loadCell() {
  SceneLoadOptions options;
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  options.descriptions["robot_description"] = test::packageFile("urdf/wam.urdf");
  return loadSceneFile(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/config/cell.yaml", options);
}

/// Judges contact by FCL's collision of the triangles, at poses by a walk along the URDF's chain.
class ArmOracle {
 public:
  explicit ArmOracle(const Scene& scene)
      : model_(urdf::parseURDF(test::packageFile("urdf/wam.urdf"))), bodies_(scene.bodies.size()) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const SceneBody& body = scene.bodies[i];
      bodies_[i].link = body.is_robot_link ? body.frame : "";
      bodies_[i].place = body.frame_from_body;
      bodies_[i].object = std::make_unique<fcl::CollisionObject<double>>(
          makeFclModel(body.mesh->surface()), fcl::Transform3<double>(body.frame_from_body));
      bodies_[i].object->computeAABB();
    }
  }

  bool touches(const VectorXd& positions) {
    for (Body& body : bodies_) {
      if (body.link.empty()) continue;
      body.object->setTransform(fcl::Transform3<double>(poseOf(body.link, positions) * body.place));
      body.object->computeAABB();
    }
    for (const Body& link : bodies_) {
      if (link.link.empty()) continue;
      for (const Body& other : bodies_) {
        if (!other.link.empty() || !link.object->getAABB().overlap(other.object->getAABB())) continue;
        fcl::CollisionResult<double> result;
        if (fcl::collide(link.object.get(), other.object.get(), fcl::CollisionRequest<double>(), result) > 0)
          return true;
      }
    }
    return false;
  }

 private:
  struct Body {
    std::string link;  ///< empty: it stands
    Isometry3d place;
    std::unique_ptr<fcl::CollisionObject<double>> object;
  };

  Isometry3d poseOf(const std::string& link, const VectorXd& positions) const {
    Isometry3d pose = Isometry3d::Identity();
    for (auto at = model_->getLink(link); at->parent_joint; at = at->getParent()) {
      const urdf::Joint& joint = *at->parent_joint;
      const urdf::Pose& origin = joint.parent_to_joint_origin_transform;
      double qx = 0.0, qy = 0.0, qz = 0.0, qw = 1.0;
      origin.rotation.getQuaternion(qx, qy, qz, qw);
      Isometry3d step = Eigen::Translation3d(origin.position.x, origin.position.y, origin.position.z) *
                        Eigen::Quaterniond(qw, qx, qy, qz);
      if (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS) {
        const Eigen::Index index = joint.name.back() - '1';  // j1 to j7
        const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
        step = step * Eigen::AngleAxisd(positions[index], axis.normalized());
      } else if (joint.type != urdf::Joint::FIXED) {
        throw std::logic_error("joint " + joint.name + " of the demo arm neither turns nor is fixed");
      }
      pose = step * pose;
    }
    return pose;
  }

  urdf::ModelInterfaceSharedPtr model_;
  std::vector<Body> bodies_;
};

class ArmTask : public GuardTask {
 public:
  ArmTask() : scene_(loadCell()), oracle_(scene_), robot_(*scene_.robots.front()) {}
  const Scene& scene() const override { return scene_; }
  VectorXd begin(std::uint64_t number) override {
    engine_.seed(1000 + static_cast<unsigned>(number));
    const VectorXd start = freePositions();
    target_ = freePositions();
    return start;
  }
  VectorXd command(double /*time*/, const VectorXd& positions) override {
    VectorXd wanted = kGain * (target_ - positions);
    const double largest = wanted.cwiseAbs().maxCoeff();
    return largest > kFastest ? VectorXd(wanted * (kFastest / largest)) : wanted;
  }
  bool hasArrived(const VectorXd& positions) override {
    return (target_ - positions).cwiseAbs().maxCoeff() < kArrived;
  }
  bool touches(const VectorXd& positions) override { return oracle_.touches(positions); }
  double acceleration() const override { return 4.0; }
  double rowDistance() const override { return 0.25; }
  double timeLimit() const override { return 6.0; }

 protected:
  /// Positions at which nothing touches, nor does it after a small move of any kind.
  VectorXd freePositions() {
    for (;;) {
      const VectorXd positions = test::randomPositions(robot_, engine_);
      if (isClear(positions)) return positions;
    }
  }
  bool isClear(const VectorXd& positions) {
    if (oracle_.touches(positions)) return false;
    std::uniform_real_distribution<double> nudge(-0.06, 0.06);
    for (int i = 0; i < 12; ++i) {
      VectorXd moved = positions;
      for (double& value : moved) value += nudge(engine_);
      if (oracle_.touches(moved)) return false;
    }
    return true;
  }

  Scene scene_;
  ArmOracle oracle_;
  const RobotKinematics& robot_;
  std::mt19937 engine_;
  VectorXd target_;
};

class CrateTask : public ArmTask {
 public:
  CrateTask() {
    std::istringstream lines(test::packageFile("config/cell_path.csv"));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream cells(line);
      path_.emplace_back(std::istream_iterator<double>(cells), std::istream_iterator<double>());
    }
  }
  VectorXd begin(std::uint64_t number) override {
    engine_.seed(2000 + static_cast<unsigned>(number));
    at_ = kBeginsInCrate;
    std::uniform_real_distribution<double> nudge(-0.03, 0.03);
    for (int tries = 0; tries < 10000; ++tries) {
      VectorXd start = pathAt(at_);
      for (double& value : start) value += nudge(engine_);
      if (isClear(start)) return start;
    }
    return pathAt(at_);
  }
  VectorXd command(double time, const VectorXd& positions) override {
    while (at_ < kIsOut && (pathAt(at_) - positions).cwiseAbs().maxCoeff() < 0.1) at_ += kPathStep;
    target_ = pathAt(at_);
    return ArmTask::command(time, positions);
  }
  bool hasArrived(const VectorXd& positions) override {
    return at_ >= kIsOut && (pathAt(kIsOut) - positions).cwiseAbs().maxCoeff() < 0.1;
  }
  double timeLimit() const override { return 15.0; }

 private:
  VectorXd pathAt(double time) const {
    std::size_t next = 1;
    while (next + 1 < path_.size() && path_[next][0] < time) ++next;
    const double share = (time - path_[next - 1][0]) / (path_[next][0] - path_[next - 1][0]);
    VectorXd positions(static_cast<Eigen::Index>(path_[next].size() - 1));
    for (Eigen::Index i = 0; i < positions.size(); ++i) {
      const auto cell = static_cast<std::size_t>(i) + 1;
      positions[i] = path_[next - 1][cell] + share * (path_[next][cell] - path_[next - 1][cell]);
    }
    return positions;
  }

  std::vector<std::vector<double>> path_;
  double at_ = 0.0;  ///< s of the path: where the driver's target is
};

}  // namespace

std::unique_ptr<GuardTask> makeArmTask() {
  return std::make_unique<ArmTask>();
}
std::unique_ptr<GuardTask> makeCrateTask() {
  return std::make_unique<CrateTask>();
}

}  // namespace concave_distance::benchmark

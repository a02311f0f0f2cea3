#include "joint_positions.h"

#include <string>

#include "concave_distance/base/error.h"
#include "tracking/rigid_pose.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

std::vector<Eigen::Isometry3d> readRoots(const SceneKinematics& joints, const py::object& roots) {
  std::vector<Eigen::Isometry3d> poses;
  if (roots.is_none()) return poses;
  const std::vector<GivenPose> given = readPoses(roots, "roots");
  const std::size_t robots = joints.robots().size();
  if (given.size() != robots)
    throw Error("roots",
                "there are " + std::to_string(given.size()) + " for " + std::to_string(robots) + " robots",
                "give one for each of Scene.robot_names");
  for (std::size_t i = 0; i < robots; ++i) {
    const std::optional<Eigen::Isometry3d> pose = rigidPose(given[i].pose);
    if (!pose)
      throw Error("roots", "that of robot '" + joints.robots()[i]->name() + "' is no pose",
                  "give a rotation and a finite position");
    poses.push_back(*pose);
  }
  return poses;
}

}  // namespace

JointPositions::JointPositions(const PythonScene& scene, const py::object& positions, const py::object& roots)
    : numbers_(readNumbers(positions, "positions")),
      width_(scene.joints->positionNames().size()),
      world_from_root_(readRoots(*scene.joints, roots)) {
  const py::ssize_t axes = numbers_.ndim();
  if (axes < 1 || axes > 2 || static_cast<std::size_t>(numbers_.shape(axes - 1)) != width_)
    throw Error("positions",
                "the shape is " + shapeOf(numbers_) + ", with " + std::to_string(width_) + " joint positions",
                "give (p,) or (n, p), in the order of Scene.position_names");
}

Eigen::Map<const Eigen::VectorXd> JointPositions::row(std::size_t index) const {
  return {numbers_.data() + index * width_, static_cast<Eigen::Index>(width_)};
}

void JointPositions::placeRoots(SceneState& state) const {
  for (std::size_t i = 0; i < state.robots.size(); ++i) {
    state.robots[i].world_from_link.front() =
        world_from_root_.empty() ? Eigen::Isometry3d::Identity() : world_from_root_[i];
  }
}

}  // namespace concave_distance::python

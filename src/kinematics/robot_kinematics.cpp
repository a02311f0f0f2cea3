#include "concave_distance/kinematics/robot_kinematics.h"

#include <cmath>
#include <utility>

#include "concave_distance/base/error.h"
#include "frame_name.h"
#include "robot_tree.h"
#include "urdf_text.h"

namespace concave_distance {
namespace {

using detail::JointType;
using detail::RobotTree;
using detail::TreeJoint;
using Positions = Eigen::Ref<const Eigen::VectorXd>;

detail::RobotStructure readStructure(const std::string& urdf, const std::string& where) {
  tinyxml2::XMLDocument document;
  detail::parseXml(document, urdf, where);
  const detail::ParsedModel parsed = detail::requireModel(document, where);
  return detail::structureOf(*document.FirstChildElement("robot"), *parsed.model);
}

Eigen::VectorXd toVector(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

Eigen::Index place(std::size_t index) {
  return static_cast<Eigen::Index>(index);
}

/// Moves the child of a joint: joint_from_child.
Eigen::Isometry3d motionOf(const TreeJoint& joint, const Positions& positions) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  const Eigen::Index first = place(joint.first_position);
  switch (joint.given.type) {
    case JointType::Fixed:
      break;
    case JointType::Revolute:
    case JointType::Continuous:
      motion.linear() =
          Eigen::AngleAxisd(joint.factor * positions[first] + joint.offset, joint.axis).toRotationMatrix();
      break;
    case JointType::Prismatic:
      motion.translation() = (joint.factor * positions[first] + joint.offset) * joint.axis;
      break;
    case JointType::Planar:
      motion.translation() = joint.axes.leftCols<2>() * positions.segment<2>(first);
      motion.linear() = Eigen::AngleAxisd(positions[first + 2], joint.axis).toRotationMatrix();
      break;
    case JointType::Floating:
      motion.translation() = positions.segment<3>(first);
      motion.linear() = Eigen::Quaterniond(positions.segment<4>(first + 3)).normalized().toRotationMatrix();
      break;
  }
  return motion;
}

/// Places the axes of a joint by the poses of its parent and child: a joint turns about the child's origin.
void placeAxes(const TreeJoint& joint, const Eigen::Isometry3d& parent, const Eigen::Isometry3d& child,
               RobotState& state) {
  const Eigen::Matrix3d world_from_joint = parent.linear() * joint.given.parent_from_joint.linear();
  const auto set = [&](std::size_t k, const Eigen::Vector3d& direction, bool turns) {
    state.axes[joint.first_axis + k] = {world_from_joint * direction, child.translation(), turns};
  };
  switch (joint.given.type) {
    case JointType::Fixed:
      break;
    case JointType::Revolute:
    case JointType::Continuous:
      set(0, joint.axis, true);
      break;
    case JointType::Prismatic:
      set(0, joint.axis, false);
      break;
    case JointType::Planar:
      for (std::size_t k = 0; k < 3; ++k) set(k, joint.axes.col(place(k)), k == 2);
      break;
    case JointType::Floating:
      for (std::size_t k = 0; k < 6; ++k) set(k, joint.axes.col(place(k % 3)), k >= 3);
      break;
  }
}

void requirePositions(const RobotTree& tree, const Positions& positions) {
  if (positions.size() != place(tree.rest.size())) {
    throw Error("robot '" + tree.name + "'", std::to_string(positions.size()) + " joint positions",
                "give " + std::to_string(tree.rest.size()) + ", in the order of positionNames()");
  }
  if (!positions.allFinite()) {
    for (Eigen::Index i = 0; i < positions.size(); ++i) {
      if (std::isfinite(positions[i])) continue;
      throw Error("joint '" + tree.position_names[static_cast<std::size_t>(i)] + "'",
                  "its position is not finite", "give rad or m");
    }
  }
  for (const TreeJoint& joint : tree.joints) {
    if (joint.given.type != JointType::Floating) continue;
    if (positions.segment<4>(place(joint.first_position) + 3).squaredNorm() > 0.0) continue;
    throw Error("joint '" + joint.given.name + "'", "its quaternion is zero", "no rotation is rot_w: 1");
  }
}

}  // namespace

RobotKinematics::RobotKinematics(const std::string& urdf, const std::string& where, const std::string& prefix)
    : RobotKinematics(readStructure(urdf, where), where, prefix) {}
RobotKinematics::RobotKinematics(const detail::RobotStructure& structure, const std::string& where,
                                 const std::string& prefix)
    : tree_(std::make_unique<const RobotTree>(structure, where, withoutLeadingSlash(prefix))) {}
RobotKinematics::~RobotKinematics() = default;
RobotKinematics::RobotKinematics(RobotKinematics&&) noexcept = default;
RobotKinematics& RobotKinematics::operator=(RobotKinematics&&) noexcept = default;

const std::string& RobotKinematics::name() const {
  return tree_->name;
}
const std::vector<std::string>& RobotKinematics::linkNames() const {
  return tree_->links;
}
std::optional<std::size_t> RobotKinematics::findLink(const std::string& name) const {
  const auto found = tree_->link_of.find(name);
  return found == tree_->link_of.end() ? std::nullopt : std::optional<std::size_t>(found->second);
}
std::size_t RobotKinematics::parentOf(std::size_t link) const {
  return tree_->joints[link - 1].parent;
}
bool RobotKinematics::isMoved(std::size_t link) const {
  return tree_->is_moved[link];
}
const std::vector<std::string>& RobotKinematics::jointNames() const {
  return tree_->joint_names;
}
const std::vector<std::string>& RobotKinematics::positionNames() const {
  return tree_->position_names;
}
const std::vector<std::string>& RobotKinematics::velocityNames() const {
  return tree_->velocity_names;
}
Eigen::VectorXd RobotKinematics::restPositions() const {
  return toVector(tree_->rest);
}
Eigen::VectorXd RobotKinematics::lowestPositions() const {
  return toVector(tree_->lowest);
}
Eigen::VectorXd RobotKinematics::highestPositions() const {
  return toVector(tree_->highest);
}
bool RobotKinematics::isAngle(std::size_t position) const {
  return tree_->is_angle[position];
}
Eigen::VectorXd RobotKinematics::positionsOf(const std::vector<std::string>& names,
                                             const std::vector<double>& values) const {
  return tree_->positionsOf(names, values);
}

RobotState RobotKinematics::restState() const {
  RobotState state;
  state.world_from_link.assign(tree_->links.size(), Eigen::Isometry3d::Identity());
  state.axes.resize(tree_->axis_count);
  evaluate(restPositions(), Eigen::Isometry3d::Identity(), state);
  return state;
}

void RobotKinematics::evaluate(const Positions& positions, const Eigen::Isometry3d& world_from_root,
                               RobotState& state) const {
  requirePositions(*tree_, positions);
  state.world_from_link[0] = world_from_root;
  for (std::size_t i = 0; i < tree_->joints.size(); ++i) {
    const TreeJoint& joint = tree_->joints[i];
    const Eigen::Isometry3d& parent = state.world_from_link[joint.parent];
    state.world_from_link[i + 1] = parent * joint.given.parent_from_joint * motionOf(joint, positions);
    placeAxes(joint, parent, state.world_from_link[i + 1], state);
  }
}

bool RobotKinematics::isTaken(std::size_t link) const {
  return link == 0 || tree_->joints[link - 1].given.type != JointType::Fixed;
}

void RobotKinematics::takeLinks(RobotState& state) const {
  for (std::size_t i = 0; i < tree_->joints.size(); ++i) {
    const TreeJoint& joint = tree_->joints[i];
    const Eigen::Isometry3d& parent = state.world_from_link[joint.parent];
    if (!isTaken(i + 1)) state.world_from_link[i + 1] = parent * joint.given.parent_from_joint;
    placeAxes(joint, parent, state.world_from_link[i + 1], state);
  }
}

void RobotKinematics::addToRow(const RobotState& state, std::size_t link, const Eigen::Vector3d& point,
                               const Eigen::Vector3d& direction, double factor,
                               Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> row) const {
  while (link != 0) {
    const TreeJoint& joint = tree_->joints[link - 1];
    for (std::size_t k = 0; k < joint.velocity_count; ++k) {
      const RobotState::Axis& axis = state.axes[joint.first_axis + k];
      const double rate = axis.turns ? direction.dot(axis.direction.cross(point - axis.origin))
                                     : direction.dot(axis.direction);
      row[place(joint.first_velocity + k)] += factor * joint.factor * rate;
    }
    link = joint.parent;
  }
}

void RobotKinematics::jacobian(const RobotState& state, std::size_t link, const Eigen::Vector3d& point,
                               Eigen::Ref<Eigen::Matrix3Xd> columns) const {
  columns.setZero();
  for (int i = 0; i < 3; ++i) {
    addToRow(state, link, point, Eigen::Vector3d::Unit(i), 1.0, columns.row(i));
  }
}

}  // namespace concave_distance

#include "robot_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "wording.h"

namespace concave_distance::detail {
namespace {

constexpr std::size_t kMostNamed = 8;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

std::size_t positionCount(JointType type) {
  switch (type) {
    case JointType::Fixed:
      return 0;
    case JointType::Planar:
      return 3;
    case JointType::Floating:
      return 7;
    default:
      return 1;
  }
}

bool isSingle(JointType type) {
  return positionCount(type) == 1;
}

std::vector<std::string> numbersOf(JointType type) {
  if (type == JointType::Planar) return {"/x", "/y", "/theta"};
  if (type == JointType::Floating) {
    return {"/trans_x", "/trans_y", "/trans_z", "/rot_x", "/rot_y", "/rot_z", "/rot_w"};
  }
  return std::vector<std::string>(positionCount(type));
}

}  // namespace

RobotTree::RobotTree(const RobotStructure& structure, const std::string& where_given,
                     const std::string& prefix)
    : name(prefix + structure.name), where(where_given), prefix_length_(prefix.size()) {
  orderLinks(structure, prefix);
  is_moved.assign(links.size(), false);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    setAxes(joints[i]);
    joint_of_.emplace(joints[i].given.name, i);
    joint_names.push_back(prefix + joints[i].given.name);
    is_moved[i + 1] = is_moved[joints[i].parent] || joints[i].given.type != JointType::Fixed;
  }
  // The numbers stand in the order of the URDF, not of the tree.
  for (const RobotJoint& given : structure.joints) {
    const auto found = joint_of_.find(given.name);
    if (found != joint_of_.end() && given.mimicked.empty()) addNumbers(joints[found->second], prefix);
  }
  for (TreeJoint& joint : joints) {
    if (!joint.given.mimicked.empty() && joint.given.type != JointType::Fixed) follow(joint, prefix);
    joint.first_axis = axis_count;
    axis_count += joint.velocity_count;
  }
  for (std::size_t i = 0; i < position_names.size(); ++i) position_of_.emplace(position_names[i], i);
}

void RobotTree::orderLinks(const RobotStructure& structure, const std::string& prefix) {
  std::map<std::string, std::vector<const RobotJoint*>> below;
  std::map<std::string, bool> is_child;
  for (const RobotJoint& joint : structure.joints) {
    below[joint.parent].push_back(&joint);
    is_child[joint.child] = true;
  }
  const auto root = std::find_if(structure.links.begin(), structure.links.end(),
                                 [&](const std::string& link) { return is_child.count(link) == 0; });
  if (root == structure.links.end()) {
    throw Error(where, "the URDF has no link at its root", "let its joints form a tree");
  }
  std::vector<std::string> bare{*root};  // as the URDF names them
  for (std::size_t link = 0; link < bare.size(); ++link) {
    links.push_back(prefix + bare[link]);
    if (!link_of.emplace(links.back(), link).second) {
      throw Error(where, "two links are called '" + bare[link] + "'", "rename one, or mend the joints");
    }
    for (const RobotJoint* joint : below[bare[link]]) {
      TreeJoint& added = joints.emplace_back();
      added.given = *joint;
      added.parent = link;
      bare.push_back(joint->child);
    }
  }
}

void RobotTree::setAxes(TreeJoint& joint) const {
  const RobotJoint& given = joint.given;
  joint.position_count = positionCount(given.type);
  joint.velocity_count = given.type == JointType::Floating ? 6 : joint.position_count;
  if (given.type == JointType::Fixed || given.type == JointType::Floating) return;
  const double length = given.axis.norm();
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw Error(where + ", joint '" + given.name + "'", "its axis has no direction",
                "give it an <axis xyz=.../> other than zero");
  }
  joint.axis = given.axis / length;
  if (given.type == JointType::Planar) {
    joint.axes = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), joint.axis).toRotationMatrix();
  }
}

void RobotTree::addNumbers(TreeJoint& joint, const std::string& prefix) {
  const RobotJoint& given = joint.given;
  const std::vector<std::string> numbers = numbersOf(given.type);
  joint.first_position = position_names.size();
  joint.first_velocity = velocity_names.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    position_names.push_back(prefix + given.name + numbers[i]);
    if (i < joint.velocity_count) velocity_names.push_back(position_names.back());
    is_angle.push_back(given.type == JointType::Revolute || given.type == JointType::Continuous ||
                       (given.type == JointType::Planar && i == 2));
    const bool is_limited = given.has_limits && isSingle(given.type);
    const bool holds_zero = !is_limited || (given.lower <= 0.0 && given.upper >= 0.0);
    rest.push_back(i == 6 ? 1.0 : holds_zero ? 0.0 : 0.5 * (given.lower + given.upper));
    lowest.push_back(is_limited ? given.lower : -kNoLimit);
    highest.push_back(is_limited ? given.upper : kNoLimit);
  }
}

// Joins the factors and offsets along a chain of joints that follow one another.
void RobotTree::follow(TreeJoint& joint, const std::string& prefix) {
  const std::string here = where + ", joint '" + prefix + joint.given.name + "'";
  joint.follows = true;
  if (!isSingle(joint.given.type)) {
    throw Error(here, "it mimics '" + joint.given.mimicked + "' and has more than one position",
                "let only revolute, continuous and prismatic joints mimic others");
  }
  const TreeJoint* source = &joint;
  for (std::size_t steps = 0; !source->given.mimicked.empty(); ++steps) {
    if (steps == joints.size()) {
      throw Error(here,
                  "the joints that it mimics lead back to themselves, by '" + joint.given.mimicked + "'",
                  "let a chain of mimic elements end at a joint without one");
    }
    joint.offset += joint.factor * source->given.mimic_offset;
    joint.factor *= source->given.mimic_factor;
    const auto next = joint_of_.find(source->given.mimicked);
    if (next == joint_of_.end()) {
      throw Error(here, "it mimics '" + source->given.mimicked + "', which is no joint of the URDF",
                  "name a joint of the same robot");
    }
    source = &joints[next->second];
  }
  if (!isSingle(source->given.type)) {
    throw Error(here, "it mimics '" + source->given.name + "', which has no single position",
                "let it follow a revolute, continuous or prismatic joint");
  }
  if (!std::isfinite(joint.factor) || !std::isfinite(joint.offset)) {
    throw Error(here, "the multiplier or offset of its mimic element is not finite", "give numbers");
  }
  joint.first_position = source->first_position;
  joint.first_velocity = source->first_velocity;
}

const TreeJoint* RobotTree::findJoint(const std::string& prefixed) const {
  if (prefixed.size() < prefix_length_ || name.compare(0, prefix_length_, prefixed, 0, prefix_length_) != 0) {
    return nullptr;
  }
  const auto found = joint_of_.find(prefixed.substr(prefix_length_));
  return found == joint_of_.end() ? nullptr : &joints[found->second];
}

Eigen::VectorXd RobotTree::positionsOf(const std::vector<std::string>& names,
                                       const std::vector<double>& values) const {
  if (names.size() != values.size()) {
    throw Error("joint positions",
                counted(names.size(), "name") + " and " + counted(values.size(), "position"),
                "give one position for each name");
  }
  const double unset = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd positions = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(rest.size()), unset);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string here = "joint '" + names[i] + "'";
    if (!std::isfinite(values[i])) throw Error(here, "its position is not finite", "give rad or m");
    const auto place = position_of_.find(names[i]);
    if (place != position_of_.end()) {
      double& position = positions[static_cast<Eigen::Index>(place->second)];
      if (!std::isnan(position)) throw Error(here, "it is given twice", "give each joint once");
      position = values[i];
      continue;
    }
    const TreeJoint* joint = findJoint(names[i]);
    if (joint == nullptr) {
      throw Error(
          here, "robot '" + name + "' has no such joint",
          "its positions are " + (position_names.empty() ? "none" : listed(position_names, kMostNamed)));
    }
    if (joint->given.type == JointType::Fixed) throw Error(here, "it is fixed", "leave it out");
    if (!joint->follows) {
      throw Error(here, "it has " + counted(joint->position_count, "position"),
                  "name them '" + names[i] + numbersOf(joint->given.type).front() + "' and so on");
    }
  }
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < position_names.size(); ++i) {
    if (std::isnan(positions[static_cast<Eigen::Index>(i)])) missing.push_back(position_names[i]);
  }
  if (!missing.empty()) {
    throw Error("joint positions of robot '" + name + "'", listed(missing, kMostNamed) + " missing",
                "give a position for every joint that moves and mimics no other");
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (position_of_.count(names[i]) != 0) continue;
    const TreeJoint& joint = *findJoint(names[i]);
    const double led =
        joint.factor * positions[static_cast<Eigen::Index>(joint.first_position)] + joint.offset;
    if (std::abs(values[i] - led) > kMimicTolerance) {
      throw Error(
          "joint '" + names[i] + "'",
          "its position is " + numberText(values[i]) + ", but what it mimics puts it at " + numberText(led),
          "leave it out, or give it that position");
    }
  }
  return positions;
}

}  // namespace concave_distance::detail

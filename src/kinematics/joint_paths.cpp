#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "motion_paths.h"
#include "robot_tree.h"
#include "tracking/rigid_pose.h"
#include "waypoint_turns.h"
#include "waypoints.h"
#include "wording.h"

namespace concave_distance::detail {
namespace {

/// Places between two waypoints of a curve where joint limits are looked at.
constexpr int kPlacesOnCurve = 32;

using Columns = std::vector<std::optional<std::size_t>>;  ///< of the motion, by position of a robot

/// Makes the paths of all bodies for a motion of joints.
class JointPaths {
 public:
  JointPaths(const SceneKinematics& joints, const SceneState& state, const JointMotion& motion)
      : joints_(joints), state_(state), motion_(motion) {
    paths_.times = requireWaypoints(motion);
  }

  MotionPaths make() {
    findColumns();
    std::vector<std::vector<BodyPath>> links;
    for (std::size_t robot = 0; robot < joints_.robots().size(); ++robot) {
      requireMimicked(joints_.robots()[robot]->tree());
      watchLimits(*joints_.robots()[robot], columns_[robot]);
      links.push_back(pathsOfLinks(robot));
    }
    for (std::size_t body = 0; body < joints_.bodyCount(); ++body) {
      paths_.bodies.push_back(pathOf(body, links));
    }
    return std::move(paths_);
  }

 private:
  void findColumns() {
    std::unordered_map<std::string, std::pair<std::size_t, std::size_t>> place_of;
    std::unordered_map<std::string, bool> is_joint;
    for (std::size_t robot = 0; robot < joints_.robots().size(); ++robot) {
      const RobotKinematics& kinematics = *joints_.robots()[robot];
      columns_.emplace_back(kinematics.positionNames().size());
      for (std::size_t i = 0; i < kinematics.positionNames().size(); ++i) {
        place_of.emplace(kinematics.positionNames()[i], std::pair(robot, i));
      }
      for (std::size_t i = 0; i < kinematics.jointNames().size(); ++i) {
        if (kinematics.tree().joints[i].follows) followers_[kinematics.jointNames()[i]] = robot;
      }
    }
    std::unordered_map<std::string, std::size_t> seen;
    for (std::size_t column = 0; column < motion_.joints.size(); ++column) {
      const std::string& name = motion_.joints[column];
      if (!seen.emplace(name, column).second) {
        throw Error("joint '" + name + "'", "it is given twice", "give each joint once");
      }
      const auto place = place_of.find(name);
      if (place != place_of.end()) {
        columns_[place->second.first][place->second.second] = column;
      } else if (followers_.count(name) == 0) {
        refuse(name);
      }
    }
  }

  [[noreturn]] void refuse(const std::string& name) const {
    joints_.positionsOfRobots({name}, {0.0});  // throws for a name that no robot has
    throw Error("joint '" + name + "'", "it has no single position",
                "leave a fixed joint out; a planar or floating one has the positions that "
                "positionNames() lists");
  }

  // A joint that follows another has to be where that puts it, if the motion names it.
  void requireMimicked(const RobotTree& tree) const {
    for (std::size_t i = 0; i < tree.joints.size(); ++i) {
      const TreeJoint& joint = tree.joints[i];
      if (!joint.follows) continue;
      const auto named = std::find(motion_.joints.begin(), motion_.joints.end(), tree.joint_names[i]);
      const std::string& source = tree.position_names[joint.first_position];
      const auto led = std::find(motion_.joints.begin(), motion_.joints.end(), source);
      if (named == motion_.joints.end()) continue;
      if (led == motion_.joints.end()) {
        throw Error("joint '" + *named + "'", "it mimics '" + source + "', which the motion does not name",
                    "name that one");
      }
      for (Eigen::Index row = 0; row < motion_.positions.rows(); ++row) {
        const double wanted =
            joint.factor * motion_.positions(row, led - motion_.joints.begin()) + joint.offset;
        const double given = motion_.positions(row, named - motion_.joints.begin());
        if (std::abs(given - wanted) <= kMimicTolerance) continue;
        throw Error(
            "waypoint " + std::to_string(row) + ", joint '" + *named + "'",
            "its position is " + numberText(given) + ", but what it mimics puts it at " + numberText(wanted),
            "leave it out, or give it that position");
      }
    }
  }

  void watchLimits(const RobotKinematics& robot, const Columns& columns) {
    const Eigen::VectorXd lowest = robot.lowestPositions();
    const Eigen::VectorXd highest = robot.highestPositions();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!columns[i]) continue;
      const MotionCurve curve = curveOf(motion_, paths_.times, *columns[i]);
      const auto at = static_cast<Eigen::Index>(i);
      const int places = curve.isStraight() ? 1 : kPlacesOnCurve;
      bool is_outside = false;
      for (std::size_t segment = 0; segment < curve.segmentCount(); ++segment) {
        for (int k = 0; k <= places; ++k) {
          const double value = curve.value({segment, static_cast<double>(k) / places});
          is_outside = is_outside || value < lowest[at] || value > highest[at];
        }
      }
      if (is_outside) paths_.outside_limits.push_back(robot.positionNames()[i]);
    }
  }

  std::vector<BodyPath> pathsOfLinks(std::size_t robot) {
    const RobotTree& tree = joints_.robots()[robot]->tree();
    const std::vector<Eigen::Isometry3d>& poses = state_.robots[robot].world_from_link;
    std::vector<BodyPath> links(tree.links.size());
    if (const auto root = rigidPose(poses.front())) links.front().start = *root;
    for (std::size_t i = 0; i < tree.joints.size(); ++i) {
      const TreeJoint& joint = tree.joints[i];
      BodyPath& link = links[i + 1];
      link = links[joint.parent];
      if (isNamed(joint, columns_[robot])) {
        link.tail = link.tail * joint.given.parent_from_joint;
        addJoint(joint, columns_[robot], link);
      } else if (joint.given.type == JointType::Fixed) {
        link.tail = link.tail * joint.given.parent_from_joint;
      } else {
        const Eigen::Isometry3d stays = poses[joint.parent].inverse(Eigen::Isometry) * poses[i + 1];
        link.tail = link.tail * rigidPose(stays).value_or(stays);
      }
    }
    return links;
  }

  static bool isNamed(const TreeJoint& joint, const Columns& columns) {
    if (joint.given.type == JointType::Fixed) return false;
    const std::size_t count = joint.follows ? 1 : joint.position_count;
    std::size_t named = 0;
    for (std::size_t k = 0; k < count; ++k) named += columns[joint.first_position + k] ? 1 : 0;
    if (named != 0 && named != count) {
      throw Error("joint '" + joint.given.name + "'",
                  "the motion names " + std::to_string(named) + " of its " + counted(count, "position"),
                  "name all of them, or none");
    }
    return named != 0;
  }

  void addJoint(const TreeJoint& joint, const Columns& columns, BodyPath& link) {
    const auto curve = [&](std::size_t k) {
      return curveOf(motion_, paths_.times, *columns[joint.first_position + k]);
    };
    PathElement element;
    element.before = link.tail;
    link.tail = Eigen::Isometry3d::Identity();
    element.curve = paths_.curves.size();
    switch (joint.given.type) {
      case JointType::Fixed:
        return;
      case JointType::Revolute:
      case JointType::Continuous:
      case JointType::Prismatic:
        element.kind =
            joint.given.type == JointType::Prismatic ? PathElement::Kind::Slide : PathElement::Kind::Turn;
        element.axes.col(0) = joint.axis;
        paths_.curves.push_back(joint.follows ? curve(0).scaled(joint.factor, joint.offset) : curve(0));
        return add(element, link);
      case JointType::Planar:
        element.kind = PathElement::Kind::Shift;
        element.axes = joint.axes;
        paths_.curves.push_back(curve(0));
        paths_.curves.push_back(curve(1));
        paths_.curves.push_back(MotionCurve::straight(std::vector<double>(paths_.times.size(), 0.0)));
        add(element, link);
        element = {};
        element.axes.col(0) = joint.axis;
        element.curve = paths_.curves.size();
        paths_.curves.push_back(curve(2));
        return add(element, link);
      case JointType::Floating:
        return addFloating(joint, columns, element, link);
    }
  }

  // Runs straight whatever velocities are given.
  void addFloating(const TreeJoint& joint, const Columns& columns, const PathElement& element,
                   BodyPath& link) {
    paths_.velocities_ignored = paths_.velocities_ignored || motion_.velocities.size() > 0;
    const auto number = [&](std::size_t row, std::size_t k) {
      return motion_.positions(static_cast<Eigen::Index>(row),
                               static_cast<Eigen::Index>(*columns[joint.first_position + k]));
    };
    std::vector<Eigen::Vector3d> positions;
    Quaternions rotations;
    for (std::size_t i = 0; i < paths_.times.size(); ++i) {
      positions.emplace_back(number(i, 0), number(i, 1), number(i, 2));
      const Eigen::Quaterniond rotation(number(i, 6), number(i, 3), number(i, 4), number(i, 5));
      if (!(rotation.norm() > 0.0) || !std::isfinite(rotation.norm())) {
        throw Error("waypoint " + std::to_string(i) + ", joint '" + joint.given.name + "'",
                    "its quaternion has no direction", "no rotation is rot_w: 1");
      }
      rotations.push_back(rotation.normalized());
    }
    for (const PathElement& part : addPoses(positions, rotations, element.before, paths_)) {
      add(part, link);
    }
  }

  void add(const PathElement& element, BodyPath& link) {
    link.elements.push_back(paths_.elements.size());
    paths_.elements.push_back(element);
  }

  std::optional<BodyPath> pathOf(std::size_t body, const std::vector<std::vector<BodyPath>>& links) const {
    if (!state_.world_from_body[body]) return std::nullopt;
    const auto& place = joints_.placeOf(body);
    if (!place) {
      const auto pose = rigidPose(*state_.world_from_body[body]);
      return pose ? std::optional<BodyPath>({{}, *pose, Eigen::Isometry3d::Identity()}) : std::nullopt;
    }
    BodyPath path = links[place->robot][place->link];
    const Eigen::Isometry3d& frame_from_body = joints_.frameFromBody(body);
    path.tail = path.tail * rigidPose(frame_from_body).value_or(frame_from_body);
    return path;
  }

  const SceneKinematics& joints_;
  const SceneState& state_;
  const JointMotion& motion_;
  std::vector<Columns> columns_;  ///< of robots
  std::unordered_map<std::string, std::size_t> followers_;
  MotionPaths paths_;
};

}  // namespace

MotionPaths pathsOf(const SceneKinematics& joints, const SceneState& state, const JointMotion& motion) {
  return JointPaths(joints, state, motion).make();
}

}  // namespace concave_distance::detail

#include "concave_distance/kinematics/scene_kinematics.h"

#include <algorithm>

#include "concave_distance/base/error.h"
#include "wording.h"

namespace concave_distance {
namespace {

constexpr std::size_t kMostNamed = 8;

std::optional<SceneKinematics::Place> placeIn(
    const std::vector<std::shared_ptr<const RobotKinematics>>& robots, const std::string& frame) {
  for (std::size_t robot = 0; robot < robots.size(); ++robot) {
    if (const auto link = robots[robot]->findLink(frame)) return SceneKinematics::Place{robot, *link};
  }
  return std::nullopt;
}

}  // namespace

SceneKinematics::SceneKinematics(const Scene& scene) : rigid_(scene.rigid) {
  for (const auto& robot : scene.robots) {
    const bool is_there = std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const SceneBody& body) {
      return robot->findLink(body.frame).has_value();
    });
    if (!is_there) {
      for (const std::string& name : robot->jointNames()) left_.emplace(name, robot->name());
      for (const std::string& name : robot->positionNames()) left_.emplace(name, robot->name());
      continue;
    }
    first_position_.push_back(position_names_.size());
    first_velocity_.push_back(velocity_names_.size());
    const auto add = [&](const std::string& name) {
      const auto [known, is_new] = robot_of_.emplace(name, robots_.size());
      if (is_new || known->second == robots_.size()) return;
      throw Error("joint '" + name + "'",
                  "robots '" + robots_[known->second]->name() + "' and '" + robot->name() + "' both have it",
                  "give one of the robots a prefix in the scene file");
    };
    for (const std::string& name : robot->jointNames()) add(name);
    for (const std::string& name : robot->positionNames()) {
      add(name);
      position_names_.push_back(name);
    }
    for (const std::string& name : robot->velocityNames()) velocity_names_.push_back(name);
    robots_.push_back(robot);
  }
  for (const SceneBody& body : scene.bodies) {
    places_.push_back(placeIn(robots_, body.frame));
    frame_from_body_.push_back(body.frame_from_body);
    frames_.push_back(body.frame);
    serials_.push_back(body.serial);
    names_.push_back(body.name);
  }
}

Eigen::VectorXd SceneKinematics::restPositions() const {
  Eigen::VectorXd positions(static_cast<Eigen::Index>(position_names_.size()));
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Eigen::VectorXd own = robots_[i]->restPositions();
    positions.segment(static_cast<Eigen::Index>(first_position_[i]), own.size()) = own;
  }
  return positions;
}

std::vector<std::optional<Eigen::VectorXd>> SceneKinematics::positionsOfRobots(
    const std::vector<std::string>& names, const std::vector<double>& values) const {
  if (names.size() != values.size()) {
    throw Error("joint positions",
                detail::counted(names.size(), "name") + " and " + detail::counted(values.size(), "position"),
                "give one position for each name");
  }
  std::vector<std::vector<std::string>> own_names(robots_.size());
  std::vector<std::vector<double>> own_values(robots_.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto robot = robot_of_.find(names[i]);
    if (robot != robot_of_.end()) {
      own_names[robot->second].push_back(names[i]);
      own_values[robot->second].push_back(values[i]);
      continue;
    }
    if (const auto left = left_.find(names[i]); left != left_.end()) {
      throw Error("joint '" + names[i] + "'",
                  "its robot '" + left->second + "' has no body in the scene any more",
                  "leave it out, or add its links again");
    }
    throw Error("joint '" + names[i] + "'", "no robot of the scene has it",
                position_names_.empty()
                    ? "give no joint positions: no robot has joints that move"
                    : "the scene's joints are " + detail::listed(position_names_, kMostNamed));
  }
  std::vector<std::optional<Eigen::VectorXd>> positions(robots_.size());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (!own_names[i].empty()) positions[i] = robots_[i]->positionsOf(own_names[i], own_values[i]);
  }
  return positions;
}

Eigen::VectorXd SceneKinematics::positionsOf(const std::vector<std::string>& names,
                                             const std::vector<double>& values) const {
  const std::vector<std::optional<Eigen::VectorXd>> given = positionsOfRobots(names, values);
  Eigen::VectorXd positions(static_cast<Eigen::Index>(position_names_.size()));
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Eigen::VectorXd own =
        given[i] ? *given[i] : robots_[i]->positionsOf({}, {});  // throws if it has any
    positions.segment(static_cast<Eigen::Index>(first_position_[i]), own.size()) = own;
  }
  return positions;
}

SceneState SceneKinematics::startState(const std::string& world) const {
  SceneState state;
  for (const auto& robot : robots_) state.robots.push_back(robot->restState());
  for (std::size_t body = 0; body < places_.size(); ++body) {
    const bool is_there =
        !places_[body] && (frames_[body] == world || rigid_.areJoined(frames_[body], world));
    state.world_from_body.push_back(is_there ? std::optional<Eigen::Isometry3d>(frame_from_body_[body])
                                             : std::nullopt);
  }
  for (std::size_t robot = 0; robot < robots_.size(); ++robot) placeBodies(robot, state);
  return state;
}

void SceneKinematics::evaluate(const Eigen::Ref<const Eigen::VectorXd>& positions, SceneState& state) const {
  if (positions.size() != static_cast<Eigen::Index>(position_names_.size())) {
    throw Error("joint positions", std::to_string(positions.size()) + " numbers",
                "give " + std::to_string(position_names_.size()) + ", in the order of positionNames()");
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const auto count = static_cast<Eigen::Index>(robots_[i]->positionNames().size());
    const Eigen::Isometry3d world_from_root = state.robots[i].world_from_link.front();
    robots_[i]->evaluate(positions.segment(static_cast<Eigen::Index>(first_position_[i]), count),
                         world_from_root, state.robots[i]);
    placeBodies(i, state);
  }
}

void SceneKinematics::placeBodies(std::size_t robot, SceneState& state) const {
  for (std::size_t body = 0; body < places_.size(); ++body) {
    if (!places_[body] || places_[body]->robot != robot) continue;
    state.world_from_body[body] =
        state.robots[robot].world_from_link[places_[body]->link] * frame_from_body_[body];
  }
}

}  // namespace concave_distance

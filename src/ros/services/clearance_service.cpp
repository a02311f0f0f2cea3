#include "clearance_service.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/number_text.h"
#include "clearance_conversions.h"
#include "concave_distance/base/error.h"
#include "respond.h"
#include "ros/tf/scene_states.h"
#include "ros/tf/tf_poses.h"

namespace concave_distance {
namespace {

/// Returns the positions that the first point of a trajectory gives a robot; empty where it does not name
/// all of them.
std::optional<Eigen::VectorXd> firstPositions(const RobotKinematics& robot,
                                              const trajectory_msgs::JointTrajectory& trajectory) {
  if (trajectory.points.empty()) return std::nullopt;
  const std::vector<double>& first = trajectory.points.front().positions;
  Eigen::VectorXd positions = robot.restPositions();
  for (std::size_t i = 0; i < robot.positionNames().size(); ++i) {
    const auto& names = trajectory.joint_names;
    const auto place = static_cast<std::size_t>(
        std::find(names.begin(), names.end(), robot.positionNames()[i]) - names.begin());
    if (place >= std::min(names.size(), first.size()) || !std::isfinite(first[place])) return std::nullopt;
    positions[static_cast<Eigen::Index>(i)] = first[place];
  }
  return positions;
}

}  // namespace

ClearanceService::ClearanceService(ServiceQueues& queues, SceneStore& keeper, const QueryContext& context,
                                   const NodeLimits& limits)
    : heavy_(queues.heavy()),
      gate_(queues.motionGate()),
      keeper_(keeper),
      context_(context),
      limits_(limits),
      progress_(heavy_.advertise<ClearanceFeedback>("clearance_progress", kQueueLength)),
      get_clearance_(heavy_.advertiseService("get_clearance", &ClearanceService::getClearance, this)) {
  ros::NodeHandle light(queues.light());
  cancel_clearance_ = light.advertiseService("cancel_clearance", &ClearanceService::cancel, this);
}

ClearanceService::StopFlag ClearanceService::begin(const std::string& id) {
  auto stop = std::make_shared<std::atomic<bool>>(false);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!id.empty() && running_.count(id) != 0) {
    throw Error("id", "a request '" + id + "' is running", "give each its own");
  }
  running_.emplace(id, stop);
  return stop;
}

void ClearanceService::end(const std::string& id) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = running_.find(id);
  if (found != running_.end()) running_.erase(found);
}

bool ClearanceService::cancel(CancelClearance::Request& request, CancelClearance::Response& response) {
  return respond(response, [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (running_.count(request.id) == 0) {
      throw Error("id", "no request '" + request.id + "' is running", "give the id of one that is");
    }
    const auto [first, last] = running_.equal_range(request.id);
    for (auto entry = first; entry != last; ++entry) *entry->second = true;
  });
}

bool ClearanceService::getClearance(GetClearance::Request& request, GetClearance::Response& response) {
  return respond(response, [&] {
    const StopFlag stop = begin(request.id);
    const auto finally = [&](const void* /*unused*/) { end(request.id); };
    const std::unique_ptr<const void, decltype(finally)> ending(this, finally);
    const RequestGate::Place place = gate_.enter();
    requireScene(keeper_);
    answer(request, *stop, response);
  });
}

void ClearanceService::answer(const GetClearance::Request& request, const std::atomic<bool>& stop,
                              GetClearance::Response& response) {
  const std::shared_ptr<const ServedScene> served = keeper_.served();
  std::vector<std::string> remarks;
  ClearanceParameters parameters = clearanceParametersOf(request, limits_);
  std::atomic<bool> ends{false};
  ClearanceProgress last;
  parameters.stop = &ends;
  parameters.progress = [&](const ClearanceProgress& progress) {
    ends = stop || gate_.stopped();
    last = progress;
    progress_.publish(toFeedback(request.id, progress, false));
  };
  ends = stop.load();
  const ClearanceResult result = find(request, *served, parameters, remarks);
  fillClearance(*served->scene, result, context_.reference_frame, response);
  addRemarks(*served->scene, result, remarks);
  response.message = joinedText(remarks, "; ");
  if (result.status != ClearanceStatus::BudgetExhausted) last.fraction = 1.0;
  last.distance = result.distance;
  last.lower_bound = result.lower_bound;
  last.queries = result.queries;
  progress_.publish(toFeedback(request.id, last, true));
}

ClearanceResult ClearanceService::find(const GetClearance::Request& request, const ServedScene& served,
                                       const ClearanceParameters& parameters,
                                       std::vector<std::string>& remarks) const {
  const std::shared_ptr<const SceneKinematics> joints = jointsOf(served);
  const bool has_trajectory = !request.trajectory.points.empty() || !request.trajectory.joint_names.empty();
  const bool has_path = !request.poses.empty() || !request.body.empty();
  if (has_trajectory == has_path) {
    throw Error("motion", has_path ? "a trajectory and a path of poses" : "neither a trajectory nor poses",
                "give `trajectory`, or `body` and `poses`");
  }
  if (has_trajectory) {
    const JointMotion motion = jointMotionOf(request, limits_, remarks);
    return findClearance(*served.scene, *joints, stateNow(request, served, *joints), motion, parameters);
  }
  const Eigen::Isometry3d reference_from_frame =
      requireFrame(frameOfPoses(request, context_.reference_frame), "poses");
  const PoseMotion motion = poseMotionOf(request, reference_from_frame, limits_);
  return findClearance(*served.scene, *joints, stateNow(request, served, *joints), motion, parameters);
}

Eigen::Isometry3d ClearanceService::requireFrame(const std::string& frame, const std::string& where) const {
  waitForFrames(*context_.transforms, context_.reference_frame, frame, ros::Time(0),
                context_.transform_timeout);
  const FrameTransform found =
      lookUpFrame(*context_.transforms->current(), context_.reference_frame, frame, ros::Time(0));
  if (found.status == TransformStatus::Ok) return found.target_from_source;
  throw Error(where,
              "tf does not connect '" + frame + "' with '" + context_.reference_frame + "': " + found.message,
              "name a frame that tf knows");
}

// Everything by tf, but for robots whose positions the request gives: of these the root alone.
SceneState ClearanceService::stateNow(const GetClearance::Request& request, const ServedScene& served,
                                      const SceneKinematics& joints) const {
  std::vector<std::optional<Eigen::VectorXd>> given =
      joints.positionsOfRobots(request.joints.name, request.joints.position);
  std::vector<Eigen::Isometry3d> roots(given.size(), Eigen::Isometry3d::Identity());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const RobotKinematics& robot = *joints.robots()[i];
    if (!given[i]) given[i] = firstPositions(robot, request.trajectory);
    if (given[i]) roots[i] = requireFrame(robot.linkNames().front(), "robot '" + robot.name() + "'");
  }
  std::vector<std::string> frames;
  std::vector<Eigen::Isometry3d> places;
  for (const SceneBody& body : served.scene->bodies) {
    frames.push_back(body.frame);
    places.push_back(body.frame_from_body);
  }
  TfLocate locate(context_.reference_frame);
  locate.setBodies(std::move(frames), std::move(places));
  locate.update(context_.transforms->current(), ros::Time::now(), context_.stale_after);
  SceneStates states;
  states.setScene(jointsOf(served), context_.reference_frame);
  states.update(locate);
  SceneState state = states.state();
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!given[i]) continue;
    joints.robots()[i]->evaluate(*given[i], roots[i], state.robots[i]);
    joints.placeBodies(i, state);
  }
  return state;
}

}  // namespace concave_distance

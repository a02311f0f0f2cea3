#include "move_receiver.h"

#include <ros/console.h>

#include <exception>
#include <utility>
#include <vector>

#include "kinematics/frame_name.h"
#include "request_conversions.h"
#include "respond.h"
#include "ros/callback_guard.h"
#include "ros/tf/tf_locate.h"
#include "scene/apply_operations.h"

namespace concave_distance {
namespace {

constexpr std::uint32_t kMostWaiting = 100;  // messages; the oldest is dropped

}  // namespace

MoveReceiver::MoveReceiver(ServiceQueues& queues, SceneStore& keeper, const TransformBuffer& transforms,
                           std::string reference_frame)
    : keeper_(keeper),
      transforms_(transforms),
      reference_frame_(std::move(reference_frame)),
      node_(queues.light()),
      moves_(node_.subscribe<SceneMoves>(
          "scene_moves", kMostWaiting, [this](const SceneMoves::ConstPtr& moves) { receive(*moves); },
          ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay())) {}

void MoveReceiver::receive(const SceneMoves& moves) {
  guarded("A message of scene_moves", [&] {
    std::size_t applied = 0;
    try {
      applied = apply(moves);
    } catch (const Error& problem) {
      note(moves.bodies.empty() ? "" : moves.bodies.front(), problem.what());
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    report_.taken += applied;
  });
}

std::size_t MoveReceiver::apply(const SceneMoves& moves) {
  requireScene(keeper_);
  if (moves.bodies.size() != moves.poses.size()) {
    throw Error(
        "scene_moves",
        std::to_string(moves.bodies.size()) + " bodies and " + std::to_string(moves.poses.size()) + " poses",
        "send one pose for each body");
  }
  detail::requireBatchSize(moves.bodies.size());
  const std::string& given = moves.header.frame_id;
  const std::string frame = given.empty() ? given : requireFrameName(given, "header.frame_id");
  std::vector<detail::SceneOperation> operations(moves.bodies.size());
  for (std::size_t i = 0; i < operations.size(); ++i) {
    detail::SceneOperation& operation = operations[i];
    operation.kind = detail::OperationKind::Move;
    operation.body = moves.bodies[i];
    operation.frame = frame;
    try {
      operation.frame_from_body = poseFromMessage(moves.poses[i], "poses[" + std::to_string(i) + "]");
    } catch (const Error& error) {
      operation.problem = error;
    }
  }
  const detail::FramesNow frames = framesNow(transforms_.current(), reference_frame_);
  detail::AppliedOperations applied;
  keeper_.edit([&](Scene& scene) { applied = detail::applyOperations(scene, operations, frames); });
  for (const detail::OperationFault& fault : applied.faults) note(fault.body, fault.error.what());
  return operations.size() - applied.faults.size();
}

void MoveReceiver::note(const std::string& body, const std::string& problem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++report_.refused;
  ++report_.refused_in_all;
  report_.last_refusal = shortText(problem);
  if (throttle_.isDue(body))
    ROS_WARN_STREAM("scene_moves: " << printable(body) << ": " << report_.last_refusal);
}

MoveReport MoveReceiver::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  MoveReport report = report_;
  report_.taken = report_.refused = 0;
  return report;
}

}  // namespace concave_distance

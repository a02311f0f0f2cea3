#include "answer_query.h"

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <new>
#include <optional>

#include "base/short_text.h"
#include "concave_distance/base/error.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "kinematics/frame_name.h"
#include "request_conversions.h"
#include "ros/messages/contact_conversions.h"
#include "ros/messages/conversions.h"
#include "ros/tf/cloud_age.h"
#include "ros/tf/tf_locate.h"
#include "scene/cloud_bodies.h"
#include "scene/scene_edits.h"

namespace concave_distance {
namespace {

/// Says where a body is: rigidly at `frame_from_body` in a tf frame.
struct BodyPlace {
  std::string frame;
  Eigen::Isometry3d frame_from_body = Eigen::Isometry3d::Identity();
};

BodyPlace placeOf(const SceneBody& body, bool use_pose, const geometry_msgs::PoseStamped& pose,
                  const std::optional<BodyPlace>& by_joints, const std::string& reference_frame,
                  const std::string& where) {
  if (!use_pose) {
    return by_joints ? *by_joints : BodyPlace{body.frame, body.frame_from_body};
  }
  const std::string& frame = pose.header.frame_id;
  return {frame.empty() ? reference_frame : requireFrameName(frame, where + ".header.frame_id"),
          poseFromMessage(pose.pose, where)};
}

using BodyPlaces = std::array<std::optional<BodyPlace>, 2>;

// Where the joint positions of a query put its bodies; nothing for a body on no robot that is named.
BodyPlaces placesByJoints(const DistanceQuery& query, const QueryContext& context, std::size_t index_a,
                          std::size_t index_b) {
  BodyPlaces places;
  if (query.joints.name.empty() && query.joints.position.empty()) return places;
  const std::shared_ptr<const SceneKinematics> joints = context.joints();
  const auto positions = joints->positionsOfRobots(query.joints.name, query.joints.position);
  const std::array<std::size_t, 2> bodies{index_a, index_b};
  bool is_used = false;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& place = joints->placeOf(bodies[side]);
    if (!place || !positions[place->robot]) continue;
    is_used = true;
    const RobotKinematics& robot = *joints->robots()[place->robot];
    RobotState state = robot.restState();
    robot.evaluate(*positions[place->robot], Eigen::Isometry3d::Identity(), state);
    places[side] = BodyPlace{robot.linkNames().front(),
                             state.world_from_link[place->link] * joints->frameFromBody(bodies[side])};
  }
  if (!is_used) {
    throw Error("joints",
                "neither '" + query.body_a + "' nor '" + query.body_b + "' is on a robot that they name",
                "leave them out, or name the joints of a robot that one of the bodies is on");
  }
  return places;
}

double secondsLeft(const QueryContext& context) {
  const auto left = context.deadline - std::chrono::steady_clock::now();
  return std::chrono::duration<double>(left).count();
}

double waitingTime(const QueryContext& context) {
  return std::clamp(secondsLeft(context), 0.0, context.transform_timeout);
}

void requireRunning(const QueryContext& context) {
  if (context.stop != nullptr && *context.stop) {
    throw Error("service", "the node is shutting down", "ask again when it is back");
  }
}

/// Says where two bodies are together.
struct LocatedPair {
  FrameTransform reference_from_a;  ///< with why there is none
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
};

LocatedPair locate(const BodyPlace& a, const BodyPlace& b, const QueryContext& context, ros::Time stamp,
                   ros::Time now) {
  waitForFrames(*context.transforms, a.frame, b.frame, stamp, waitingTime(context));
  waitForFrames(*context.transforms, context.reference_frame, a.frame, stamp, waitingTime(context));
  TfLocate locate(context.reference_frame);
  locate.setBodies({a.frame, b.frame}, {a.frame_from_body, b.frame_from_body});
  locate.update(context.transforms->current(), now, context.stale_after, stamp);
  const PairInput input = locate(0, 1);
  return {locate.placeOfA(0, 1, input.located), input.a_from_b};
}

// Says why the clouds among two bodies leave nothing to compute; nothing: they do not.
std::optional<PairStatus> statusOfClouds(const SceneBody& a, const SceneBody& b, ros::Time now) {
  for (const SceneBody* body : {&a, &b}) {
    if (!body->cloud) continue;
    if (const auto why = whyUnusable(body->name, *body->cloud, now))
      return toStatus(why->status, why->message);
  }
  if (!detail::isEmptyCloud(a) && !detail::isEmptyCloud(b)) return std::nullopt;
  PairStatus status;
  status.code = PairStatus::BEYOND_CUTOFF;
  status.message = "the cloud has no occupied voxel: there is nothing to be near";
  return status;
}

// The answer to a query for which the call had no time left.
QueryAnswer outOfTime(const DistanceQuery& query, const PairHeading& heading) {
  PairStatus status;
  status.code = PairStatus::BUDGET_EXHAUSTED;
  status.message =
      "the call's time ran out before this query began (send fewer queries in one call, or raise "
      "~limits/query_seconds)";
  QueryAnswer answer;
  answer.result = emptyNiches(heading, status);
  if (query.with_contacts != 0) {
    answer.contacts = emptyContacts(heading, status);
  }
  return answer;
}

PairContactState tooManyContacts(std::size_t count, const PairHeading& heading) {
  PairStatus status;
  status.code = PairStatus::MEMORY_EXHAUSTED;
  status.message = std::to_string(count) +
                   " regions of contact are more than this answer may have (send fewer queries in one "
                   "call, or raise ~limits/largest_niche_count)";
  return emptyContacts(heading, status);
}

// The regions of overlap at one pose, from nothing; no forces. At most `largest_count` of them.
PairContactState findContacts(const SceneBody& body_a, const SceneBody& body_b, const PairSolution& solution,
                              const PairHeading& heading, WorkLimit limit, std::size_t largest_count) {
  EffectSettings regions;
  regions.interference = true;
  PairEffects effects(body_a.mesh, body_b.mesh, regions, inContact(body_a.material, body_b.material));
  PairContacts contacts;
  effects.update(solution, RelativeTwist(), 0.0, contacts, &limit);
  if (contacts.regions.size() > largest_count) {
    return tooManyContacts(contacts.regions.size(), heading);
  }
  for (ContactRegion& region : contacts.regions) {
    region.id = 0;
  }
  return toContacts(heading, toDistance(heading, solution).status, contacts, solution.a_from_b);
}

QueryAnswer answer(const DistanceQuery& query, const Scene& scene, const QueryContext& context, ros::Time now,
                   PairHeading& heading) {
  const std::size_t index_a = requireBody(scene, query.body_a);
  const std::size_t index_b = requireBody(scene, query.body_b);
  const SceneBody& body_a = scene.bodies[index_a];
  const SceneBody& body_b = scene.bodies[index_b];
  if (&body_a == &body_b) {
    throw Error("body_b", "both bodies are '" + query.body_a + "'", "name two different bodies");
  }
  const std::optional<ScenePair> found = pairOf(scene, index_a, index_b);
  const PairSettings& settings = found ? found->settings : scene.defaults.pairs;
  heading.pair = found ? found->name : query.body_a + "/" + query.body_b;
  TrackerParameters parameters = withMargins(queryParameters(query, settings.tracker), body_a, body_b);
  if (query.with_contacts != 0 && !provesDistance(parameters.accuracy)) {
    throw Error("with_contacts",
                "it is true, but the accuracy is " + std::string(toString(parameters.accuracy)),
                "ask for ACCURACY_CERTIFIED: its proof shows whether bodies touch");
  }
  heading.accuracy = parameters.accuracy;
  heading.with_niches = parameters.niches_wanted;

  const BodyPlaces by_joints = placesByJoints(query, context, index_a, index_b);
  const BodyPlace place_a =
      placeOf(body_a, query.use_pose_a != 0, query.pose_a, by_joints[0], context.reference_frame, "pose_a");
  const BodyPlace place_b =
      placeOf(body_b, query.use_pose_b != 0, query.pose_b, by_joints[1], context.reference_frame, "pose_b");
  const LocatedPair located = locate(place_a, place_b, context, query.stamp, now);
  const FrameTransform& place = located.reference_from_a;
  heading.stamp = place.status == TransformStatus::Missing ? now : place.stamp;
  heading.reference_from_a = place.target_from_source;
  QueryAnswer answer;
  if (place.status != TransformStatus::Ok) {
    const PairStatus status = toStatus(place.status, place.message);
    answer.result = emptyNiches(heading, status);
    if (query.with_contacts != 0) {
      answer.contacts = emptyContacts(heading, status);
    }
    return answer;
  }
  if (const auto status = statusOfClouds(body_a, body_b, now)) {
    answer.result = emptyNiches(heading, *status);
    if (status->code == PairStatus::BEYOND_CUTOFF) {
      answer.result.nearest.has_lower_bound = 1;
      answer.result.nearest.lower_bound = std::numeric_limits<double>::infinity();
    }
    if (query.with_contacts != 0) answer.contacts = emptyContacts(heading, *status);
    return answer;
  }
  requireRunning(context);
  const double left = secondsLeft(context);
  if (left <= 0.0) {
    return outOfTime(query, heading);
  }
  parameters.time_budget = std::min(parameters.time_budget, left);
  parameters.largest_niche_count =
      std::min(parameters.largest_niche_count, std::max(1U, context.largest_niche_count));
  parameters.stop = context.stop;
  const PairSolution solution =
      solveOnce(heading.pair, body_a.mesh, body_b.mesh, parameters, located.a_from_b);
  if (settings.warning_distance && solution.distance < *settings.warning_distance) {
    heading.warning = true;
  }
  answer.result = toNiches(heading, solution);
  if (query.with_contacts != 0) {
    const std::size_t taken = answer.result.niches.size();
    const std::size_t most = context.largest_niche_count;
    answer.contacts =
        findContacts(body_a, body_b, solution, heading, remainingWork(parameters, solution.solve_seconds),
                     most - std::min(taken, most));
  }
  return answer;
}

// Needs memory for what it says of a failure too.
QueryAnswer answerOrExplain(const DistanceQuery& query, const Scene& scene, const QueryContext& context,
                            ros::Time now) {
  PairHeading heading;
  heading.body_a = query.body_a;
  heading.body_b = query.body_b;
  heading.reference_frame = context.reference_frame;
  heading.stamp = now;
  PairStatus status;
  status.code = PairStatus::INVALID_REQUEST;
  try {
    requireRunning(context);
    QueryAnswer answered = answer(query, scene, context, now, heading);
    forgetIds(answered.result);
    return answered;
  } catch (const Error& problem) {
    status.message = shortText(problem.what());
  } catch (const std::bad_alloc&) {
    status.message = "there is not enough memory for this query (request less in one call)";
  } catch (const std::exception& problem) {
    status.message = shortText(problem.what());
  }
  return {emptyNiches(heading, status), PairContactState()};
}

}  // namespace

void forgetIds(PairNiches& answer) {
  answer.nearest.nearest_niche_id = 0;
  answer.changes.clear();
  for (Niche& niche : answer.niches) {
    niche.id = 0;
  }
}

bool isAnswered(const PairNiches& answer) {
  return answer.nearest.has_distance != 0;
}

QueryAnswer answerQuery(const DistanceQuery& query, const Scene& scene, const QueryContext& context,
                        ros::Time now) noexcept {
  try {
    return answerOrExplain(query, scene, context, now);
  } catch (...) {
    // The texts are short enough to need no memory.
    PairStatus status;
    status.code = PairStatus::INVALID_REQUEST;
    status.message = "out of memory";
    return {emptyNiches(PairHeading(), status), PairContactState()};
  }
}

}  // namespace concave_distance

#include "scene_services.h"

#include <ros/console.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

#include "base/short_text.h"
#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"
#include "concave_distance/search/prepare_search.h"
#include "loading/set_effects.h"
#include "loading/wording.h"
#include "request_conversions.h"
#include "ros/messages/conversions.h"
#include "ros/tf/frame_report.h"
#include "ros/tf/tf_poses.h"
#include "scene/scene_edits.h"
#include "scene/set_warning_distance.h"

namespace concave_distance {
namespace {

// Runs a request; an exception becomes the response's message.
template <typename Response, typename Act>
bool respond(Response& response, Act&& act) {
  try {
    act();
    response.success = 1;
  } catch (const std::exception& problem) {
    response.success = 0;
    response.message = shortText(problem.what());
  }
  return true;
}

void requireWarningLengths(const AddBody::Request& request) {
  if (request.has_warning_distance != 0 &&
      (!(request.warning_distance >= 0.0) || !(request.warning_hysteresis >= 0.0))) {
    throw Error("warning_distance", "a length is negative or not a number", "give metres, 0 or more");
  }
}

PairSettings pairSettings(const AddBody::Request& request, PairSettings settings) {
  if (request.has_warning_distance != 0) {
    settings.warning_distance = request.warning_distance;
    settings.warning_hysteresis = request.warning_hysteresis;
  }
  return settings;
}

constexpr double kRemarkPeriod = 1.0;  // s between two remarks in the log; every response has its own

// Pairs besides the named ones that list_bodies has.
constexpr std::size_t kMostPairsListed = 1000;

// Bodies named in a remark.
constexpr std::size_t kMostNamed = 8;

// Returns whether only static transforms connect the two frames.
bool areFixed(const tf2::BufferCore& buffer, const std::string& frame_a, const std::string& frame_b) {
  const FrameTransform transform = lookUpFrame(buffer, frame_a, frame_b, ros::Time(0));
  return transform.status == TransformStatus::Ok && transform.stamp.isZero();
}

bool isOnTf(const tf2::BufferCore& buffer, const std::string& frame) {
  return buffer._frameExists(frame);
}

// Remarks for the caller about an added body; empty: none.
std::string remarksOn(const AddedPairs& added, const std::string& frame, bool frame_is_known) {
  std::string text;
  const auto add = [&](const std::string& remark) { text += (text.empty() ? "" : "; ") + remark; };
  if (!frame_is_known) {
    add("the frame '" + frame +
        "' is not on tf: the body's pairs have no distance until something publishes it");
  }
  if (!added.unknown.empty()) {
    add("touch_links names no body of the scene: " + detail::listed(added.unknown, kMostNamed));
  }
  if (!added.rigid_neighbours.empty()) {
    add("not watched against bodies rigidly connected with '" + frame + "': " +
        detail::listed(added.rigid_neighbours, kMostNamed) + " (name them in pair_with to watch them)");
  }
  return text;
}

Eigen::Vector4d toColour(const std_msgs::ColorRGBA& color, const Eigen::Vector4d& fallback) {
  const Eigen::Vector4d given(color.r, color.g, color.b, color.a);
  return given.isZero(0.0) ? fallback : given;
}

}  // namespace

SceneServices::SceneServices(ServiceQueues& queues, SceneStore& keeper, RestartRequests& restarts,
                             const TransformBuffer& transforms, std::string reference_frame,
                             PackageLocator package_locator, MeshAccess mesh_access)
    : light_(queues.light()),
      heavy_(queues.heavy()),
      gate_(queues.gate()),
      keeper_(keeper),
      restarts_(restarts),
      transforms_(transforms),
      reference_frame_(std::move(reference_frame)),
      package_locator_(std::move(package_locator)),
      mesh_access_(std::move(mesh_access)),
      list_bodies_(light_.advertiseService("list_bodies", &SceneServices::listBodies, this)),
      add_body_(heavy_.advertiseService("add_body", &SceneServices::addBody, this)),
      remove_body_(light_.advertiseService("remove_body", &SceneServices::removeBody, this)),
      set_pair_enabled_(light_.advertiseService("set_pair_enabled", &SceneServices::setPairEnabled, this)),
      set_effects_(light_.advertiseService("set_effects", &SceneServices::setEffects, this)),
      set_warning_distance_(
          light_.advertiseService("set_warning_distance", &SceneServices::setWarningDistance, this)),
      reset_tracking_(light_.advertiseService("reset_tracking", &SceneServices::resetTracking, this)) {}

void SceneServices::requireScene() {
  const std::string waiting = keeper_.waitingFor();
  if (!waiting.empty()) {
    throw Error("scene", "it is not loaded yet: " + waiting, "ask again later");
  }
}

bool SceneServices::listBodies(ListBodies::Request& /*request*/, ListBodies::Response& response) {
  const std::shared_ptr<const Scene> scene = keeper_.served()->scene;
  response.message = keeper_.waitingFor();
  response.ready = static_cast<std::uint8_t>(response.message.empty());
  if (response.message.empty()) {
    response.message = missingClock();
  }
  response.reference_frame = reference_frame_;
  for (const SceneBody& body : scene->bodies) {
    response.bodies.push_back(toBodyInfo(body));
  }
  for (const ScenePair& pair : allPairs(*scene, scene->pairs.size() + kMostPairsListed)) {
    response.pairs.push_back(toPairInfo(*scene, pair));
  }
  for (const SceneProblem& problem : scene->problems) {
    Problem message;
    message.where = problem.where;
    message.message = problem.message;
    response.problems.push_back(message);
  }
  response.notes = scene->warnings;
  response.notes.insert(response.notes.end(), scene->notes.begin(), scene->notes.end());
  if (response.pairs.size() >= scene->pairs.size() + kMostPairsListed) {
    response.notes.push_back("pairs has those that are named and " + std::to_string(kMostPairsListed) +
                             " others; " + std::to_string(countRuledPairs(*scene)) +
                             " are enabled besides the named ones");
  }
  for (const SceneBody& body : scene->bodies) {
    const SearchPreparation prepared = searchPreparationOf(body.mesh->asSolved());
    if (prepared.is_complete && !prepared.has_matrices) {
      response.notes.push_back(body.name +
                               ": mesh distances are computed on demand, because its matrices exceed "
                               "metric_memory_limit_mb or 4096 nodes");
    }
  }
  return true;
}

bool SceneServices::addBody(AddBody::Request& request, AddBody::Response& response) {
  return respond(response, [&] {
    const RequestGate::Place place = gate_.enter();
    requireScene();
    requireWarningLengths(request);
    const std::shared_ptr<const Scene> scene = keeper_.served()->scene;
    requireRoomForBody(*scene);
    // Reading the mesh may take seconds: outside the edit.
    BodyDescription description = toBodyDescription(request, scene->defaults);
    description.mesh_access = mesh_access_;
    description.mesh_access.limits.stop = &gate_.stopped();
    SceneBody body = loadBody(description, "", package_locator_, scene->pool,
                              request.primitive.empty() ? scene->cache : nullptr, scene->limits);
    body.colour = toColour(request.color, body.colour);
    body.material = scene->defaults.material;
    body.margin = request.margin;
    requireMargin("add_body", body.margin, *body.mesh);
    const std::shared_ptr<const tf2::BufferCore> buffer = transforms_.current();
    const PairPartners partners{request.pair_with, request.without_pairs != 0, request.touch_links,
                                [&](const std::string& frame_a, const std::string& frame_b) {
                                  return areFixed(*buffer, frame_a, frame_b);
                                }};
    AddedPairs added;
    keeper_.edit([&](Scene& edited) {
      added = concave_distance::addBody(edited, body, partners, pairSettings(request, edited.defaults.pairs));
    });
    response.message = shortText(remarksOn(added, body.frame, isOnTf(*buffer, body.frame)));
    if (!response.message.empty()) {
      ROS_WARN_STREAM_THROTTLE(kRemarkPeriod, "add_body '" << body.name << "': " << response.message);
    }
    response.pairs = std::move(added.names);
  });
}

bool SceneServices::removeBody(RemoveBody::Request& request, RemoveBody::Response& response) {
  return respond(response, [&] {
    requireScene();
    keeper_.edit([&](Scene& scene) {
      response.pairs = concave_distance::removeBody(scene, request.name, request.allow_robot_link != 0);
    });
  });
}

bool SceneServices::setPairEnabled(SetPairEnabled::Request& request, SetPairEnabled::Response& response) {
  return respond(response, [&] {
    requireScene();
    keeper_.edit([&](Scene& scene) {
      response.pairs = concave_distance::setPairEnabled(scene, {request.pair, request.body_a, request.body_b},
                                                        request.enabled != 0, scene.defaults.pairs);
    });
    response.pair = response.pairs.front();
  });
}

bool SceneServices::setEffects(SetEffects::Request& request, SetEffects::Response& response) {
  return respond(response, [&] {
    requireScene();
    keeper_.editSettings([&](Scene& scene) {
      response.pairs = concave_distance::setEffects(scene, request.pair, request.effects);
    });
  });
}

bool SceneServices::setWarningDistance(SetWarningDistance::Request& request,
                                       SetWarningDistance::Response& response) {
  return respond(response, [&] {
    requireScene();
    const auto distance =
        request.remove != 0 ? std::nullopt : std::optional<double>(request.warning_distance);
    keeper_.editSettings([&](Scene& scene) {
      response.pairs =
          concave_distance::setWarningDistance(scene, request.pair, distance, request.warning_hysteresis);
    });
  });
}

bool SceneServices::resetTracking(ResetTracking::Request& request, ResetTracking::Response& response) {
  return respond(response, [&] {
    const std::shared_ptr<const Scene> scene = keeper_.served()->scene;
    if (request.pair.empty()) {
      restarts_.requestAll();
      response.count = static_cast<std::uint32_t>(scene->pairs.size() + countRuledPairs(*scene));
      return;
    }
    requirePair(*scene, request.pair);
    restarts_.request(request.pair);
    response.count = 1;
  });
}

}  // namespace concave_distance

#include "scene_services.h"

#include <utility>

#include "concave_distance/search/prepare_search.h"
#include "loading/set_effects.h"
#include "respond.h"
#include "ros/messages/conversions.h"
#include "ros/tf/frame_report.h"
#include "scene/apply_operations.h"
#include "scene/scene_edits.h"

namespace concave_distance {
namespace {

using detail::OperationKind;

// Pairs besides the named ones that list_bodies has.
constexpr std::size_t kMostPairsListed = 1000;

}  // namespace

SceneServices::SceneServices(ServiceQueues& queues, SceneStore& keeper, RestartRequests& restarts,
                             std::string reference_frame)
    : light_(queues.light()),
      keeper_(keeper),
      restarts_(restarts),
      reference_frame_(std::move(reference_frame)),
      list_bodies_(light_.advertiseService("list_bodies", &SceneServices::listBodies, this)),
      set_pair_enabled_(light_.advertiseService("set_pair_enabled", &SceneServices::setPairEnabled, this)),
      set_effects_(light_.advertiseService("set_effects", &SceneServices::setEffects, this)),
      set_warning_distance_(
          light_.advertiseService("set_warning_distance", &SceneServices::setWarningDistance, this)),
      reset_tracking_(light_.advertiseService("reset_tracking", &SceneServices::resetTracking, this)) {}

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
                             " others; " + std::to_string(countPairsByRule(*scene)) +
                             " are enabled besides the named ones");
  }
  for (const SceneBody& body : scene->bodies) {
    const SearchPreparation prepared = searchPreparationOf(body.mesh->asSolved());
    if (prepared.is_metric_thinned) {
      response.notes.push_back(body.name +
                               ": the search measures along its mesh between evenly spread nodes only, "
                               "because those of all would exceed metric_memory_limit_mb or 4096 nodes");
    }
  }
  return true;
}

bool SceneServices::setPairEnabled(SetPairEnabled::Request& request, SetPairEnabled::Response& response) {
  return respond(response, [&] {
    requireScene(keeper_);
    const bool enabled = request.enabled != 0;
    detail::SceneOperation operation;
    if (request.pair.empty()) {
      operation.kind = enabled ? OperationKind::DisallowContact : OperationKind::AllowContact;
      operation.body = request.body_a;
      operation.other = request.body_b;
    } else {
      operation.kind = enabled ? OperationKind::EnablePairs : OperationKind::DisablePairs;
      operation.pair = request.pair;
    }
    keeper_.edit([&](Scene& scene) { response.pairs = applyOperation(scene, operation, {}); });
    response.pair = response.pairs.front();
  });
}

bool SceneServices::setEffects(SetEffects::Request& request, SetEffects::Response& response) {
  return respond(response, [&] {
    requireScene(keeper_);
    keeper_.editSettings([&](Scene& scene) {
      response.pairs = concave_distance::setEffects(scene, request.pair, request.effects);
    });
  });
}

bool SceneServices::setWarningDistance(SetWarningDistance::Request& request,
                                       SetWarningDistance::Response& response) {
  return respond(response, [&] {
    requireScene(keeper_);
    detail::SceneOperation operation;
    operation.kind = OperationKind::SetWarningDistance;
    operation.pair = request.pair;
    if (request.remove == 0) operation.warning_distance = request.warning_distance;
    operation.warning_hysteresis = request.warning_hysteresis;
    keeper_.editSettings([&](Scene& scene) { response.pairs = applyOperation(scene, operation, {}); });
  });
}

bool SceneServices::resetTracking(ResetTracking::Request& request, ResetTracking::Response& response) {
  return respond(response, [&] {
    const std::shared_ptr<const Scene> scene = keeper_.served()->scene;
    if (request.pair.empty()) {
      restarts_.requestAll();
      response.count = static_cast<std::uint32_t>(scene->pairs.size() + countPairsByRule(*scene));
      return;
    }
    requirePair(*scene, request.pair);
    restarts_.request(request.pair);
    response.count = 1;
  });
}

}  // namespace concave_distance

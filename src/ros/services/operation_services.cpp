#include "operation_services.h"

#include <ros/console.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "concave_distance/loading/load_scene.h"
#include "kinematics/wording.h"
#include "operation_conversions.h"
#include "request_conversions.h"
#include "respond.h"
#include "ros/tf/tf_locate.h"
#include "scene/scene_edits.h"

namespace concave_distance {
namespace {

using detail::AppliedOperations;
using detail::OperationKind;

constexpr double kRemarkPeriod = 1.0;  // s between two remarks in the log; every response has its own

// Bodies named in a remark, and faults in a response.
constexpr std::size_t kMostNamed = 8;
constexpr std::size_t kMostFaults = 1000;

void append(std::string& text, const std::string& remark) {
  if (!remark.empty()) text += (text.empty() ? "" : "; ") + remark;
}

// Remarks for the caller about one operation; empty: none.
std::string remarkOn(const detail::SceneOperation& operation, const detail::OperationRemark& remark,
                     const tf2::BufferCore& buffer) {
  std::string text;
  std::vector<std::string> unknown = remark.unknown;
  unknown.insert(unknown.end(), remark.added.unknown.begin(), remark.added.unknown.end());
  if (operation.added && !buffer._frameExists(operation.added->frame)) {
    append(text, "the frame '" + operation.added->frame +
                     "' is not on tf: the body's pairs have no distance until something publishes it");
  }
  if (!unknown.empty()) {
    append(text, "touch_links names no body of the scene: " + detail::listed(unknown, kMostNamed));
  }
  if (!remark.added.rigid_neighbours.empty()) {
    append(text, "not watched against bodies rigidly connected with '" + operation.added->frame +
                     "': " + detail::listed(remark.added.rigid_neighbours, kMostNamed) +
                     " (name them in pair_with to watch them)");
  }
  return text;
}

std::vector<OperationFault> toFaults(const AppliedOperations& applied) {
  std::vector<OperationFault> faults;
  for (const detail::OperationFault& fault : applied.faults) {
    if (faults.size() >= kMostFaults) break;
    OperationFault message;
    message.operation = static_cast<std::uint32_t>(fault.operation);
    message.body = fault.body;
    message.message = shortText(fault.error.what());
    faults.push_back(std::move(message));
  }
  return faults;
}

// Ends an edit of which nothing is to be served.
struct Refused {};

}  // namespace

OperationServices::OperationServices(ServiceQueues& queues, SceneStore& keeper,
                                     const TransformBuffer& transforms, std::string reference_frame,
                                     PackageLocator package_locator, MeshAccess mesh_access)
    : light_(queues.light()),
      heavy_(queues.heavy()),
      gate_(queues.gate()),
      keeper_(keeper),
      transforms_(transforms),
      reference_frame_(std::move(reference_frame)),
      package_locator_(std::move(package_locator)),
      mesh_access_(std::move(mesh_access)),
      apply_scene_(heavy_.advertiseService("apply_scene", &OperationServices::applyScene, this)),
      add_body_(heavy_.advertiseService("add_body", &OperationServices::addBody, this)),
      remove_body_(light_.advertiseService("remove_body", &OperationServices::removeBody, this)) {
  mesh_access_.limits.stop = &gate_.stopped();
}

bool OperationServices::applyScene(ApplyScene::Request& request, ApplyScene::Response& response) {
  return respond(response, [&] {
    response.revision = keeper_.served()->revision;
    const bool adds =
        std::any_of(request.operations.begin(), request.operations.end(),
                    [](const auto& message) { return message.operation == SceneOperation::ADD; });
    if (adds) {
      const RequestGate::Place place = gate_.enter();
      applyAll(request.operations, response);
    } else {
      applyAll(request.operations, response);
    }
  });
}

void OperationServices::applyAll(const std::vector<SceneOperation>& messages,
                                 ApplyScene::Response& response) {
  requireScene(keeper_);
  detail::requireBatchSize(messages.size());
  const std::vector<detail::SceneOperation> operations = load(messages);
  const Outcome outcome = apply(operations);
  response.faults = toFaults(outcome.applied);
  if (!response.faults.empty()) {
    const OperationFault& first = response.faults.front();
    throw Error("operations[" + std::to_string(first.operation) + "]", first.message,
                std::to_string(outcome.applied.faults.size()) + " of " + std::to_string(operations.size()) +
                    " operations are wrong, nothing was changed");
  }
  response.revision = outcome.revision;
  response.message = shortText(remarksOn(operations, outcome.applied));
}

std::vector<detail::SceneOperation> OperationServices::load(const std::vector<SceneOperation>& messages) {
  std::vector<detail::SceneOperation> operations;
  operations.reserve(messages.size());
  for (const SceneOperation& message : messages) operations.push_back(toOperation(message));
  loadBodies(messages, operations);
  return operations;
}

// Reading meshes may take seconds: outside the edit.
void OperationServices::loadBodies(const std::vector<SceneOperation>& messages,
                                   std::vector<detail::SceneOperation>& operations) {
  const std::shared_ptr<const Scene> scene = keeper_.served()->scene;
  for (const bool has_files : {false, true}) {
    std::vector<BodyDescription> descriptions;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < messages.size(); ++i) {
      detail::SceneOperation& operation = operations[i];
      if (operation.kind != OperationKind::Add || operation.problem) continue;
      if (messages[i].mesh_resources.empty() == has_files) continue;
      try {
        descriptions.push_back(bodyOf(messages[i], scene->defaults, scene->limits.triangles));
        descriptions.back().mesh_access = mesh_access_;
        places.push_back(i);
      } catch (const Error& error) {
        operation.problem = error;
      }
    }
    // On this thread alone: a worker that reads meshes would be missing in the cycle.
    std::vector<LoadedBody> loaded;
    tbb::task_arena(1).execute([&] {
      loaded = concave_distance::loadBodies(descriptions, "", package_locator_, scene->pool, scene->limits);
    });
    for (std::size_t k = 0; k < loaded.size(); ++k) {
      detail::SceneOperation& operation = operations[places[k]];
      operation.problem = loaded[k].problem;
      if (operation.problem) continue;
      try {
        finishBody(messages[places[k]], scene->defaults, *loaded[k].body);
        operation.added = std::move(loaded[k].body);
      } catch (const Error& error) {
        operation.problem = error;
      }
    }
  }
}

OperationServices::Outcome OperationServices::apply(const std::vector<detail::SceneOperation>& operations,
                                                    const std::function<void(Scene&)>& last) {
  const detail::FramesNow frames = framesNow(transforms_.current(), reference_frame_);
  Outcome outcome;
  try {
    outcome.revision = keeper_.edit([&](Scene& scene) {
      outcome.applied = detail::applyOperations(scene, operations, frames);
      if (!outcome.applied.faults.empty()) throw Refused();
      if (last) last(scene);
    });
  } catch (const Refused&) {
    // The faults say why.
  }
  return outcome;
}

std::string OperationServices::remarksOn(const std::vector<detail::SceneOperation>& operations,
                                         const AppliedOperations& applied) const {
  const std::shared_ptr<const tf2::BufferCore> buffer = transforms_.current();
  std::string text;
  for (const detail::OperationRemark& remark : applied.remarks) {
    const detail::SceneOperation& operation = operations[remark.operation];
    const std::string said = remarkOn(operation, remark, *buffer);
    if (!said.empty()) append(text, operations.size() == 1 ? said : "'" + operation.body + "': " + said);
  }
  if (!text.empty()) {
    ROS_WARN_STREAM_THROTTLE(kRemarkPeriod, "edit of the scene, body '"
                                                << operations[applied.remarks.front().operation].body
                                                << "': " << shortText(text));
  }
  return text;
}

bool OperationServices::addBody(AddBody::Request& request, AddBody::Response& response) {
  return respond(response, [&] {
    const RequestGate::Place place = gate_.enter();
    requireScene(keeper_);
    detail::SceneOperation operation;
    operation.kind = OperationKind::Add;
    operation.body = request.name;
    operation.partners = {request.pair_with, request.without_pairs != 0, request.touch_links, {}};
    operation.warning_distance = warningDistanceOf(request);
    operation.warning_hysteresis = request.warning_hysteresis;
    const std::shared_ptr<const Scene> scene = keeper_.served()->scene;
    requireRoomForBody(*scene);
    BodyDescription description = toBodyDescription(request, scene->defaults);
    description.mesh_access = mesh_access_;
    operation.added = loadBody(description, "", package_locator_, scene->pool, scene->limits);
    operation.added->colour = toColour(request.color, operation.added->colour);
    operation.added->material = scene->defaults.material;
    operation.added->margin = request.margin;
    requireMargin("add_body", request.margin, *operation.added->mesh);
    const Outcome outcome = apply(
        {operation}, [&](Scene& edited) { response.pairs = pairNamesOf(edited, edited.bodies.size() - 1); });
    if (!outcome.applied.faults.empty()) throw Error(outcome.applied.faults.front().error);
    response.message = shortText(remarksOn({operation}, outcome.applied));
  });
}

bool OperationServices::removeBody(RemoveBody::Request& request, RemoveBody::Response& response) {
  return respond(response, [&] {
    requireScene(keeper_);
    detail::SceneOperation operation;
    operation.kind = OperationKind::Remove;
    operation.body = request.name;
    operation.allow_robot_link = request.allow_robot_link != 0;
    keeper_.edit([&](Scene& scene) {
      response.pairs = pairNamesOf(scene, requireBody(scene, request.name));
      applyOperation(scene, operation, {});
    });
  });
}

}  // namespace concave_distance

#include "apply_operations.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "base/number_text.h"
#include "body_placement.h"
#include "cloud_bodies.h"
#include "matching_bodies.h"
#include "scene_edits.h"
#include "set_warning_distance.h"

namespace concave_distance::detail {
namespace {

OperationRemark add(Scene& scene, const SceneOperation& operation, const FramesNow& frames) {
  PairSettings settings = scene.defaults.pairs;
  if (operation.warning_distance) {
    settings.warning_distance = operation.warning_distance;
    settings.warning_hysteresis = operation.warning_hysteresis;
    requireWarningWithinCutoff(settings, "body '" + operation.body + "'");
  }
  PairPartners partners = operation.partners;
  partners.is_rigid = [&](const std::string& a, const std::string& b) {
    const auto relation = frames.relation ? frames.relation(a, b) : std::nullopt;
    return relation && relation->is_fixed;
  };
  return {0, appendBody(scene, operation.added.value(), partners, settings), {}};
}

void setMargin(Scene& scene, const SceneOperation& operation) {
  const std::vector<std::size_t> bodies = matchingBodies(scene, operation.body, "body").bodies;
  if (!(operation.margin >= 0.0) || !std::isfinite(operation.margin)) {
    throw Error("margin", "the value is " + numberText(operation.margin), "give metres, 0 or more");
  }
  for (const std::size_t index : bodies) {
    const SceneBody& body = scene.bodies[index];
    if (limitsMargin(body) && body.mesh)
      requireMargin("body '" + body.name + "'", operation.margin, *body.mesh);
  }
  for (const std::size_t index : bodies) scene.bodies.edit(index).margin = operation.margin;
}

void apply(Scene& scene, const SceneOperation& operation, const FramesNow& frames,
           std::vector<OperationRemark>& remarks) {
  if (operation.problem) throw Error(*operation.problem);
  switch (operation.kind) {
    case OperationKind::Add:
      remarks.push_back(add(scene, operation, frames));
      break;
    case OperationKind::Move:
      moveBody(scene, operation.body, operation.frame, operation.frame_from_body, frames);
      break;
    case OperationKind::Remove:
      takeOutBody(scene, operation.body, operation.allow_robot_link);
      break;
    case OperationKind::Attach:
      remarks.push_back(
          {0, {}, attachBody(scene, operation.body, operation.other, operation.touch_links, frames)});
      break;
    case OperationKind::Detach:
      detachBody(scene, operation.body, operation.frame, frames);
      break;
    case OperationKind::AllowContact:
    case OperationKind::DisallowContact:
      setPairEnabled(scene, {"", operation.body, operation.other},
                     operation.kind == OperationKind::DisallowContact, scene.defaults.pairs);
      break;
    case OperationKind::SetMargin:
      setMargin(scene, operation);
      break;
  }
}

bool isNamed(const std::unordered_set<std::string>& names, const SceneOperation& operation) {
  const auto is_one = [&](const std::string& name) { return names.count(name) != 0; };
  const std::vector<std::string>& partners = operation.partners.names;
  return is_one(operation.body) || is_one(operation.other) ||
         std::any_of(partners.begin(), partners.end(), is_one);
}

}  // namespace

void requireBatchSize(std::size_t operations) {
  if (operations <= kMostOperations) return;
  throw Error("operations", std::to_string(operations) + " operations",
              "send at most " + std::to_string(kMostOperations) + " in one batch");
}

AppliedOperations applyOperations(Scene& scene, const std::vector<SceneOperation>& operations,
                                  const FramesNow& frames) {
  requireBatchSize(operations.size());
  AppliedOperations applied;
  std::unordered_set<std::string> failed;  // bodies whose Add was refused
  for (std::size_t i = 0; i < operations.size(); ++i) {
    const SceneOperation& operation = operations[i];
    if (!operation.problem && isNamed(failed, operation)) continue;
    const std::size_t remarks = applied.remarks.size();
    try {
      apply(scene, operation, frames, applied.remarks);
    } catch (const Error& error) {
      applied.faults.push_back({i, operation.body, error});
      if (operation.kind == OperationKind::Add && !scene.findBody(operation.body))
        failed.insert(operation.body);
    }
    if (applied.remarks.size() > remarks) applied.remarks.back().operation = i;
  }
  return applied;
}

}  // namespace concave_distance::detail

#include "apply_operations.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <unordered_set>
#include <utility>

#include "base/number_text.h"
#include "body_placement.h"
#include "cloud_bodies.h"
#include "journal.h"
#include "matching_bodies.h"
#include "name_pattern.h"
#include "rule_edits.h"
#include "scene_edits.h"
#include "set_warning_distance.h"

namespace concave_distance::detail {
namespace {

AddedPairs add(Scene& scene, const SceneOperation& operation, const FramesNow& frames) {
  PairSettings settings = scene.defaults.pairs;
  if (operation.warning_distance) {
    settings.warning_distance = operation.warning_distance;
    settings.warning_hysteresis = operation.warning_hysteresis;
    requireWarningWithinCutoff(settings, "body '" + operation.body + "'");
  }
  PairPartners partners = operation.partners;
  partners.may_be_gone = operation.is_recorded;
  partners.is_rigid = [&](const std::string& a, const std::string& b) {
    const std::vector<std::string>& known = operation.rigid_frames;
    if (operation.is_recorded) return std::find(known.begin(), known.end(), a) != known.end();
    const auto relation = frames.relation ? frames.relation(a, b) : std::nullopt;
    return relation && relation->is_fixed;
  };
  return appendBody(scene, operation.added.value(), partners, settings);
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

std::vector<std::string> layEffects(Scene& scene, const SceneOperation& operation) {
  return changeMatchingPairs(scene, operation.pair,
                             [&](const std::string& where, bool& /*enabled*/, PairSettings& settings) {
                               if (operation.effects_after) {
                                 settings.effects = *operation.effects_after;
                               } else {
                                 operation.lay_effects(where, settings);
                               }
                             });
}

void place(Scene& scene, const SceneOperation& operation, const FramesNow& frames) {
  const std::string& body = operation.body;
  const Eigen::Isometry3d& pose = operation.frame_from_body;
  const bool is_moved = operation.kind == OperationKind::Move;
  if (operation.is_recorded) {
    placeBody(scene, body, operation.frame, pose, is_moved);
    for (const std::string& pair : operation.switched_on) {
      if (const auto listed = scene.pairs.find(pair)) scene.pairs.edit(*listed).enabled = true;
    }
  } else if (is_moved) {
    moveBody(scene, body, operation.frame, pose, frames);
  } else {
    detachBody(scene, body, operation.frame, frames);
  }
}

/// What applying an operation comes to.
struct Outcome {
  OperationRemark remark;
  std::vector<std::string> pairs;
};

Outcome apply(Scene& scene, const SceneOperation& operation, const FramesNow& frames) {
  if (operation.problem) throw Error(*operation.problem);
  Outcome outcome;
  switch (operation.kind) {
    case OperationKind::Add:
      outcome.remark.added = add(scene, operation, frames);
      break;
    case OperationKind::Move:
    case OperationKind::Detach:
      place(scene, operation, frames);
      break;
    case OperationKind::Remove:
      takeOutBody(scene, operation.body, operation.allow_robot_link);
      break;
    case OperationKind::Attach:
      outcome.remark.unknown =
          operation.is_recorded
              ? attachBodyAt(scene, operation.body, operation.other, operation.frame,
                             operation.frame_from_body, operation.touch_links)
              : attachBody(scene, operation.body, operation.other, operation.touch_links, frames);
      break;
    case OperationKind::AllowContact:
    case OperationKind::DisallowContact:
      outcome.pairs = setPairEnabled(scene, {"", operation.body, operation.other},
                                     operation.kind == OperationKind::DisallowContact, scene.defaults.pairs);
      break;
    case OperationKind::EnablePairs:
    case OperationKind::DisablePairs:
      outcome.pairs = setPairEnabled(scene, {operation.pair, "", ""},
                                     operation.kind == OperationKind::EnablePairs, scene.defaults.pairs);
      break;
    case OperationKind::SetMargin:
      setMargin(scene, operation);
      break;
    case OperationKind::SetEffects:
      outcome.pairs = layEffects(scene, operation);
      break;
    case OperationKind::SetWarningDistance:
      outcome.pairs =
          setWarningDistance(scene, operation.pair, operation.warning_distance, operation.warning_hysteresis);
      break;
  }
  return outcome;
}

std::optional<EffectSettings> commonEffects(const Scene& scene, const std::vector<std::string>& pairs) {
  std::optional<EffectSettings> common;
  for (const std::string& name : pairs) {
    const std::optional<ScenePair> pair = findPairNamed(scene, name);
    if (!pair || (common && !(*common == pair->settings.effects))) return std::nullopt;
    common = pair->settings.effects;
  }
  return pairs.size() < kMostPairsNamed ? common : std::nullopt;
}

/// @param before what a body that was detached was attached to
SceneOperation asRecorded(SceneOperation operation, const Scene& scene, const Outcome& outcome,
                          const Attachment* before) {
  operation.is_recorded = true;
  if (operation.kind == OperationKind::Add) operation.rigid_frames = outcome.remark.added.rigid_frames;
  const std::optional<std::size_t> place = scene.findBody(operation.body);
  if (operation.kind == OperationKind::Attach) {
    const Attachment& attachment = *scene.bodies[*place].attachment;
    operation.frame = attachment.parent_serial == 0 ? attachment.parent : "";
    operation.frame_from_body = attachment.parent_from_body;
  }
  if (operation.kind == OperationKind::Move || operation.kind == OperationKind::Detach) {
    operation.frame = scene.bodies[*place].frame;
    operation.frame_from_body = scene.bodies[*place].frame_from_body;
    if (before != nullptr) operation.switched_on = before->switched_off;
  }
  if (operation.kind == OperationKind::SetEffects)
    operation.effects_after = commonEffects(scene, outcome.pairs);
  if (!operation.pair.empty() && !isPattern(operation.pair)) {
    if (const std::optional<ScenePair> pair = findPairNamed(scene, operation.pair)) {
      operation.body = scene.bodies[pair->body_a].name;
      operation.other = scene.bodies[pair->body_b].name;
    }
  }
  return operation;
}

Outcome applyAndRecord(Scene& scene, const SceneOperation& operation, const FramesNow& frames) {
  const std::optional<std::size_t> place =
      operation.kind == OperationKind::Detach ? scene.findBody(operation.body) : std::nullopt;
  const std::shared_ptr<const Attachment> before = place ? scene.bodies[*place].attachment : nullptr;
  Outcome outcome = apply(scene, operation, frames);
  record(asRecorded(operation, scene, outcome, before.get()), scene.operations);
  return outcome;
}

bool selectsNothing(const Scene& scene, const SceneOperation& operation, const Error& error) {
  const auto is_set = [&](const std::string& text) {
    return isPattern(text) || scene.groups.count(text) != 0;
  };
  const std::string& where = error.where();
  if (where == "pair") return is_set(operation.pair) || is_set(operation.body) || is_set(operation.other);
  if (where == "body_b") return is_set(operation.other);
  return (where == "body_a" || where == "body") && is_set(operation.body);
}

bool isNamed(const std::unordered_set<std::string>& names, const SceneOperation& operation) {
  const auto is_one = [&](const std::string& name) { return names.count(name) != 0; };
  const std::vector<std::string>& partners = operation.partners.names;
  return is_one(operation.body) || is_one(operation.other) ||
         (!operation.is_recorded && std::any_of(partners.begin(), partners.end(), is_one));
}

}  // namespace

void requireBatchSize(std::size_t operations) {
  if (operations <= kMostOperations) return;
  throw Error("operations", std::to_string(operations) + " operations",
              "send at most " + std::to_string(kMostOperations) + " in one batch");
}

std::vector<std::string> applyOperation(Scene& scene, const SceneOperation& operation,
                                        const FramesNow& frames) {
  return applyAndRecord(scene, operation, frames).pairs;
}

AppliedOperations applyOperations(Scene& scene, const std::vector<SceneOperation>& operations,
                                  const FramesNow& frames) {
  AppliedOperations applied;
  std::unordered_set<std::string> failed;  // bodies whose Add was refused
  for (std::size_t i = 0; i < operations.size(); ++i) {
    const SceneOperation& operation = operations[i];
    if (!operation.problem && isNamed(failed, operation)) continue;
    const bool changes_in_part =
        operation.kind == OperationKind::SetEffects || operation.kind == OperationKind::SetWarningDistance;
    const std::optional<Scene> before = changes_in_part ? std::optional<Scene>(scene) : std::nullopt;
    try {
      OperationRemark remark = applyAndRecord(scene, operation, frames).remark;
      remark.operation = i;
      if (operation.kind == OperationKind::Add || operation.kind == OperationKind::Attach)
        applied.remarks.push_back(std::move(remark));
    } catch (const Error& error) {
      if (before) scene = *before;
      applied.faults.push_back({i, operation.body, error, selectsNothing(scene, operation, error)});
      if (operation.kind == OperationKind::Add && !scene.findBody(operation.body))
        failed.insert(operation.body);
    }
  }
  return applied;
}

}  // namespace concave_distance::detail

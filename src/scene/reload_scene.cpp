#include "reload_scene.h"

#include <optional>
#include <unordered_set>
#include <utility>

#include "apply_operations.h"
#include "body_serials.h"
#include "cloud_bodies.h"
#include "concave_distance/base/error.h"

namespace concave_distance::detail {
namespace {

using Names = std::unordered_set<std::string>;

Names bodiesOf(const SceneJournal& journal, OperationKind kind) {
  Names names;
  for (const auto& operation : journal) {
    if (operation->kind == kind) names.insert(operation->body);
  }
  return names;
}

const SceneBody* bodyNamed(const Scene& scene, const std::string& name) {
  const std::optional<std::size_t> place = scene.findBody(name);
  return place ? &scene.bodies[*place] : nullptr;
}

bool areOneCloud(const SceneBody& l, const SceneBody& r) {
  return l.cloud && r.cloud && *l.cloud->settings == *r.cloud->settings && l.frame == r.frame;
}

bool isSame(const SceneBody& before, const SceneBody& now) {
  return (before.mesh == now.mesh || areOneCloud(before, now)) && before.is_robot_link == now.is_robot_link;
}

// What is said of the files' bodies; a sensor goes on seeing.
void compareFiles(const Scene& current, bool drop_edits, Scene& fresh, ReloadReport& report) {
  const Names added = bodiesOf(current.operations, OperationKind::Add);
  const Names removed = bodiesOf(current.operations, OperationKind::Remove);
  for (std::size_t i = 0; i < fresh.bodies.size(); ++i) {
    const SceneBody& body = fresh.bodies[i];
    const SceneBody* before = bodyNamed(current, body.name);
    if (before == nullptr || added.count(body.name) != 0) {
      if (removed.count(body.name) == 0 || drop_edits) report.added.push_back(body.name);
      continue;
    }
    (isSame(*before, body) ? report.kept : report.replaced).push_back(body.name);
    if (areOneCloud(*before, body))
      takeCloud(fresh.bodies.edit(i), *before->cloud, before->mesh, before->frame_from_body);
  }
  for (const SceneBody& body : current.bodies) {
    if (added.count(body.name) == 0 && !fresh.findBody(body.name)) report.removed.push_back(body.name);
  }
}

void replay(const SceneJournal& journal, Scene& scene, ReloadReport& report) {
  std::vector<SceneOperation> operations;
  for (const auto& operation : journal) operations.push_back(*operation);
  const AppliedOperations applied = applyOperations(scene, operations, {});
  for (const OperationFault& fault : applied.faults)
    report.dropped.push_back(nameOf(operations[fault.operation]) + ": " + fault.error.what());
  for (const auto& operation : scene.operations) {
    if (operation->kind == OperationKind::Add || operation->kind == OperationKind::Remove)
      report.kept_edits.push_back(operation->body);
  }
}

void shareSerials(const Scene& current, Scene& scene) {
  Serials serials;
  for (const SceneBody& body : scene.bodies) {
    const SceneBody* before = bodyNamed(current, body.name);
    if (before != nullptr && isSame(*before, body)) serials.emplace(body.serial, before->serial);
  }
  renumber(scene, serials);
}

}  // namespace

Scene reloadedScene(const Scene& current, Scene fresh, bool drop_edits, ReloadReport& report) {
  compareFiles(current, drop_edits, fresh, report);
  if (!drop_edits) replay(current.operations, fresh, report);
  for (const auto& operation : current.operations) {
    if (drop_edits && operation->kind == OperationKind::Add)
      report.dropped.push_back(nameOf(*operation) + ": a service had added it");
  }
  shareSerials(current, fresh);
  return fresh;
}

}  // namespace concave_distance::detail

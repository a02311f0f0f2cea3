#include "state_services.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "concave_distance/loading/load_scene.h"
#include "kinematics/wording.h"
#include "loading/saved_scene.h"
#include "loading/scene_files.h"
#include "respond.h"
#include "ros/tf/tf_locate.h"
#include "scene/reload_scene.h"
#include "state_conversions.h"

namespace concave_distance {
namespace {

std::size_t countOf(const Reload::Response& response) {
  return response.replaced.size() + response.added.size() + response.removed.size();
}

}  // namespace

StateServices::StateServices(ServiceQueues& queues, SceneStore& keeper, const TransformBuffer& transforms,
                             std::string reference_frame, std::string save_folder, SceneSource source)
    : heavy_(queues.heavy()),
      gate_(queues.gate()),
      keeper_(keeper),
      transforms_(transforms),
      reference_frame_(std::move(reference_frame)),
      save_folder_(std::move(save_folder)),
      source_(std::move(source)),
      get_scene_(heavy_.advertiseService("get_scene", &StateServices::getScene, this)),
      save_scene_(heavy_.advertiseService("save_scene", &StateServices::saveScene, this)),
      reload_(heavy_.advertiseService("reload", &StateServices::reload, this)) {}

bool StateServices::getScene(GetScene::Request& request, GetScene::Response& response) {
  return respond(response, [&] {
    const RequestGate::Place place = gate_.enter();
    requireScene(keeper_);
    const std::shared_ptr<const ServedScene> served = keeper_.served();
    const bool with_meshes = request.with_meshes != 0;
    response.revision = served->revision;
    fillState(*served->scene, framesNow(transforms_.current(), reference_frame_), with_meshes, response);
    for (detail::SavedFile& file : detail::savedScene(*served->scene, "scene", with_meshes)) {
      SceneFile& message = response.files.emplace_back();
      message.name = std::move(file.name);
      message.text = std::move(file.text);
    }
  });
}

bool StateServices::saveScene(SaveScene::Request& request, SaveScene::Response& response) {
  return respond(response, [&] {
    const RequestGate::Place place = gate_.enter();
    requireScene(keeper_);
    const std::string path = detail::pathBelow(save_folder_, request.path);
    const std::shared_ptr<const ServedScene> served = keeper_.served();
    response.files = detail::writeScene(path, detail::savedScene(*served->scene, detail::stemOf(path)),
                                        request.overwrite != 0);
    response.revision = served->revision;
    ROS_INFO_STREAM("Saved the scene as " << path);
  });
}

void StateServices::requireNoNewProblem(const Scene& fresh, const Scene& now,
                                        Reload::Response& response) const {
  const auto is_known = [&](const SceneProblem& problem) {
    // The line of a file at which it stands may have changed.
    return std::any_of(now.problems.begin(), now.problems.end(),
                       [&](const SceneProblem& known) { return known.message == problem.message; });
  };
  for (const SceneProblem& problem : fresh.problems) {
    if (is_known(problem)) continue;
    Problem& message = response.problems.emplace_back();
    message.where = problem.where;
    message.message = problem.message;
  }
  if (response.problems.empty()) return;
  throw Error("reload",
              detail::counted(response.problems.size(), "part") + " cannot be loaded, the first: " +
                  response.problems.front().where + ": " + response.problems.front().message,
              "mend them and call again; nothing was changed");
}

bool StateServices::reload(Reload::Request& request, Reload::Response& response) {
  return respond(response, [&] {
    const RequestGate::Place place = gate_.enter();
    const std::lock_guard<std::mutex> lock(reload_mutex_);
    requireScene(keeper_);
    const std::shared_ptr<const ServedScene> served = keeper_.served();
    response.revision = served->revision;
    Scene fresh = source_.load(served->scene->pool);
    requireNoNewProblem(fresh, *served->scene, response);
    const Scene loaded = fresh;  // shares all with it
    detail::ReloadReport report;
    response.revision = keeper_.editSettings([&](Scene& scene) {
      scene = detail::reloadedScene(scene, std::move(fresh), request.drop_edits != 0, report);
    });
    fillReport(std::move(report), response);
    source_.on_served(loaded);
    ROS_INFO(
        "Reloaded the scene: %zu bodies go on, %zu are new, changed or gone, %zu operations were dropped.",
        response.kept.size(), countOf(response), response.dropped.size());
    for (const std::string& dropped : response.dropped) ROS_WARN_STREAM("Reload has dropped: " << dropped);
  });
}

}  // namespace concave_distance

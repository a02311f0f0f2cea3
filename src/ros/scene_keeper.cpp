#include "scene_keeper.h"

#include <utility>

namespace concave_distance {

SceneKeeper::SceneKeeper(TopicPublishers& publishers, const PairSettings& defaults, const MarkerStyle& style)
    : publishers_(publishers), style_(style) {
  Scene empty;
  empty.defaults.pairs = defaults;
  serve(std::move(empty), true);
}

std::shared_ptr<const ServedScene> SceneKeeper::served() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return served_;
}

void SceneKeeper::replace(Scene scene) {
  const std::lock_guard<std::mutex> edit_lock(edit_mutex_);
  serve(std::move(scene), true);
}

void SceneKeeper::edit(const std::function<void(Scene&)>& change) {
  apply(change, false);
}

void SceneKeeper::editSettings(const std::function<void(Scene&)>& change) {
  apply(change, true);
}

void SceneKeeper::apply(const std::function<void(Scene&)>& change, bool settings_changed) {
  const std::lock_guard<std::mutex> edit_lock(edit_mutex_);
  Scene edited = *served()->scene;
  change(edited);
  serve(std::move(edited), settings_changed);
}

void SceneKeeper::changeSettings(const std::function<void(PairSettings&)>& change) {
  const std::lock_guard<std::mutex> edit_lock(edit_mutex_);
  Scene edited = *served()->scene;
  for (std::size_t i = 0; i < edited.pairs.size(); ++i) {
    change(edited.pairs.edit(i).settings);
  }
  change(edited.defaults.pairs);
  serve(std::move(edited), true);
}

std::string SceneKeeper::waitingFor() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return waiting_for_;
}

void SceneKeeper::setWaitingFor(const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_for_ = what;
}

void SceneKeeper::serve(Scene scene, bool settings_changed) {
  const std::shared_ptr<const ServedScene> before = served();
  const std::uint64_t revision = (before ? before->settings_revision : 0) + (settings_changed ? 1 : 0);
  std::shared_ptr<const ServedScene> next =
      publishers_.serve(std::make_shared<const Scene>(std::move(scene)), before.get(), style_, revision);
  const std::lock_guard<std::mutex> lock(mutex_);
  served_ = std::move(next);
}

}  // namespace concave_distance

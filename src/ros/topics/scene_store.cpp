#include "scene_store.h"

#include <utility>

namespace concave_distance {

SceneStore::SceneStore(TopicPublishers& publishers, const PairSettings& defaults, const MarkerStyle& style)
    : publishers_(publishers), style_(style) {
  Scene empty;
  empty.defaults.pairs = defaults;
  serve(std::move(empty), true);
}

std::shared_ptr<const ServedScene> SceneStore::served() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return served_;
}

void SceneStore::replace(Scene scene) {
  const std::lock_guard<std::mutex> edit_lock(edit_mutex_);
  serve(std::move(scene), true);
}

std::uint64_t SceneStore::edit(const std::function<void(Scene&)>& change) {
  return apply(change, false);
}

std::uint64_t SceneStore::editSettings(const std::function<void(Scene&)>& change) {
  return apply(change, true);
}

std::uint64_t SceneStore::apply(const std::function<void(Scene&)>& change, bool settings_changed) {
  const std::lock_guard<std::mutex> edit_lock(edit_mutex_);
  Scene edited = *served()->scene;
  change(edited);
  return serve(std::move(edited), settings_changed);
}

void SceneStore::changeSettings(const std::function<void(PairSettings&)>& change) {
  const std::lock_guard<std::mutex> edit_lock(edit_mutex_);
  Scene edited = *served()->scene;
  for (std::size_t i = 0; i < edited.pairs.size(); ++i) {
    change(edited.pairs.edit(i).settings);
  }
  for (PairSettings& settings : edited.rules.settings) change(settings);
  change(edited.defaults.pairs);
  serve(std::move(edited), true);
}

std::string SceneStore::waitingFor() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return waiting_for_;
}

void SceneStore::setWaitingFor(const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_for_ = what;
}

std::uint64_t SceneStore::serve(Scene scene, bool settings_changed) {
  const std::shared_ptr<const ServedScene> before = served();
  std::shared_ptr<const ServedScene> next =
      publishers_.serve(std::move(scene), before.get(), style_, settings_changed);
  const std::uint64_t revision = next->revision;
  const std::lock_guard<std::mutex> lock(mutex_);
  served_ = std::move(next);
  return revision;
}

}  // namespace concave_distance

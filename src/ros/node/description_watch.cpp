#include "description_watch.h"

#include <functional>
#include <optional>

namespace concave_distance {
namespace {

std::size_t hashOf(const std::string& text) {
  return std::hash<std::string>{}(text);
}

}  // namespace

void DescriptionWatch::remember(const SceneRequest& request) {
  const std::lock_guard<std::mutex> lock(mutex_);
  loaded_.clear();
  reported_.clear();
  for (const auto& [name, text] : request.parameters) loaded_[name] = hashOf(text);
}

std::string DescriptionWatch::findNews() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string news;
  for (const auto& [name, hash] : loaded_) {
    const std::optional<FoundDescription> found = findDescription(node_, name, true);
    // One that was deleted does not change the robot.
    const std::size_t now = found ? hashOf(found->text) : hash;
    if (now == hash) {
      reported_.erase(name);
      continue;
    }
    const auto [place, is_new] = reported_.emplace(name, now);
    if (is_new || place->second != now) news = name;
    place->second = now;
  }
  return news;
}

std::string DescriptionWatch::changed() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return reported_.empty() ? "" : reported_.begin()->first;
}

}  // namespace concave_distance

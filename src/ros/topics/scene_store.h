#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "concave_distance/scene/scene.h"
#include "ros/markers/marker_style.h"
#include "topic_publishers.h"

namespace concave_distance {

/// The scene that the cycle and the services read and that services change. A reader takes a snapshot and
/// keeps it as long as it likes; an edit makes a new one (meshes are shared, so that is cheap). Thread-safe;
/// readers never wait for an edit.
class SceneStore {
 public:
  SceneStore(TopicPublishers& publishers, const PairSettings& defaults, const MarkerStyle& style);

  std::shared_ptr<const ServedScene> served();
  void replace(Scene scene);
  /// Applies `change` to a copy and serves that; when `change` throws, nothing has happened. It leaves the
  /// settings of pairs that are there as they are: such pairs are tracked on, untouched. Pairs that it
  /// creates get the defaults of the scene that it is given; those read before the edit may be old by now.
  /// @return the revision of the scene that is served then
  std::uint64_t edit(const std::function<void(Scene&)>& change);
  /// The same for a change of pairs' settings.
  std::uint64_t editSettings(const std::function<void(Scene&)>& change);
  /// Applies `change` to every pair and to the scene's defaults.
  void changeSettings(const std::function<void(PairSettings&)>& change);

  /// Returns what the scene still waits for; empty once it is loaded.
  std::string waitingFor();
  void setWaitingFor(const std::string& what);

 private:
  std::uint64_t apply(const std::function<void(Scene&)>& change, bool settings_changed);
  std::uint64_t serve(Scene scene, bool settings_changed);

  TopicPublishers& publishers_;
  MarkerStyle style_;
  std::mutex edit_mutex_;  ///< one edit at a time; it may talk to the master
  std::mutex mutex_;       ///< guards what follows, held for a copy only
  std::shared_ptr<const ServedScene> served_;
  std::string waiting_for_ = "loading";  ///< services may be called before the first attempt to load
};

}  // namespace concave_distance

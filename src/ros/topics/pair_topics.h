#pragma once

#include <ros/node_handle.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "watched_topic.h"

namespace concave_distance {

/// The topics of one pair.
struct PairTopics {
  WatchedTopic distance;
  WatchedTopic niches;
  WatchedTopic contacts;
};

/// One entry per listed pair of a scene, in the scene's order; nullptr: the pair has no topics.
using PairTopicList = std::vector<std::shared_ptr<const PairTopics>>;

/// Decides which pairs have their own topics, and advertises these. Advertising three topics takes the master
/// milliseconds; so with thousands of pairs only those of the patterns have topics.
class PairTopicKeeper {
 public:
  /// Without patterns, pairs have topics while the scene has at most this many.
  static constexpr std::size_t kMostUnnamed = 16;

  /// @param patterns of pairs' names, with * and ?; nothing: every pair of a small scene
  PairTopicKeeper(const ros::NodeHandle& node, std::optional<std::vector<std::string>> patterns);

  /// Lists the pairs of a scene that have topics: a pair by rule has none.
  void listPairs(Scene& scene) const;
  /// @param before the previous scene with its topics, which are kept for pairs that stay; nullptr: none
  PairTopicList topicsOf(const Scene& scene, const Scene* before, const PairTopicList& topics_before);

 private:
  bool isWanted(const std::string& pair, std::size_t pair_count) const;
  std::shared_ptr<const PairTopics> advertise(const std::string& pair);
  void reportUnnamed(std::size_t pair_count);

  ros::NodeHandle node_;
  std::optional<std::vector<std::string>> patterns_;
  bool reported_ = false;
};

}  // namespace concave_distance

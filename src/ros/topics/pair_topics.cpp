#include "pair_topics.h"

#include <concave_distance/PairContactState.h>
#include <concave_distance/PairDistance.h>
#include <concave_distance/PairNiches.h>
#include <ros/console.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "scene/name_pattern.h"
#include "scene/rule_edits.h"
#include "topic_name.h"

namespace concave_distance {
PairTopicKeeper::PairTopicKeeper(const ros::NodeHandle& node,
                                 std::optional<std::vector<std::string>> patterns)
    : node_(node), patterns_(std::move(patterns)) {}

void PairTopicKeeper::listPairs(Scene& scene) const {
  if (patterns_) {
    detail::listMatchingPairs(scene, *patterns_);
  } else if (scene.pairs.size() + countPairsByRule(scene) <= kMostUnnamed) {
    scene.pairs = allPairs(scene);
  }
}

PairTopicList PairTopicKeeper::topicsOf(const Scene& scene, const Scene* before,
                                        const PairTopicList& topics_before) {
  PairTopicList topics(scene.pairs.size());
  // Usually an edit leaves most pairs unchanged and at the same index.
  std::unordered_map<std::string, std::shared_ptr<const PairTopics>> moved;
  const auto is_unchanged = [&](std::size_t index) {
    return before != nullptr && index < before->pairs.size() && index < scene.pairs.size() &&
           &before->pairs[index] == &scene.pairs[index];
  };
  for (std::size_t index = 0; index < topics_before.size(); ++index) {
    if (is_unchanged(index)) {
      topics[index] = topics_before[index];
    } else if (topics_before[index]) {
      moved.emplace(before->pairs[index].name, topics_before[index]);
    }
  }
  const std::size_t pair_count = scene.pairs.size() + countPairsByRule(scene);
  bool is_left_out = pair_count > scene.pairs.size();
  for (std::size_t index = 0; index < topics.size(); ++index) {
    if (is_unchanged(index)) continue;
    const std::string& pair = scene.pairs[index].name;
    if (const auto found = moved.find(pair); found != moved.end()) {
      topics[index] = found->second;
    } else if (isWanted(pair, pair_count)) {
      topics[index] = advertise(pair);
    } else {
      is_left_out = true;
    }
  }
  if (is_left_out && !patterns_) {
    reportUnnamed(pair_count);
  }
  return topics;
}

bool PairTopicKeeper::isWanted(const std::string& pair, std::size_t pair_count) const {
  if (!patterns_) {
    return pair_count <= kMostUnnamed;
  }
  return std::any_of(patterns_->begin(), patterns_->end(), [&](const std::string& pattern) {
    return pattern == pair || detail::matchesPattern(pattern, pair);
  });
}

std::shared_ptr<const PairTopics> PairTopicKeeper::advertise(const std::string& pair) {
  const std::string name = "pairs/" + topicName(pair);
  auto topics = std::make_shared<PairTopics>();
  topics->distance = WatchedTopic::advertise<PairDistance>(node_, name + "/distance", kQueueLength);
  topics->niches = WatchedTopic::advertise<PairNiches>(node_, name + "/niches", kQueueLength);
  topics->contacts = WatchedTopic::advertise<PairContactState>(node_, name + "/contacts", kQueueLength);
  return topics;
}

void PairTopicKeeper::reportUnnamed(std::size_t pair_count) {
  if (std::exchange(reported_, true)) {
    return;
  }
  ROS_INFO(
      "The scene has %zu pairs, more than %zu: they have no topics of their own. Name those that you want "
      "in ~pair_topics, e.g. ['gripper/*', 'arm/table']; the topics distances, niches and nearest have "
      "all pairs.",
      pair_count, kMostUnnamed);
}

}  // namespace concave_distance

#include "group_topics.h"

#include <concave_distance/Nearest.h>
#include <ros/console.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <utility>

#include "alerts.h"
#include "base/constants.h"
#include "nearest.h"
#include "topic_name.h"

namespace concave_distance {
namespace {

using Mask = detail::GroupMembers::Mask;

bool isOf(Mask mask, std::size_t group) {
  return (mask >> group & 1U) != 0;
}

Mask facing(const ServedGroups& groups, const ScenePair& pair) {
  return groups.members.facing(pair.body_a, pair.body_b);
}

std::shared_ptr<GroupTopics> advertise(const ros::NodeHandle& node, const std::string& group) {
  const std::string name = "groups/" + topicName(group);
  auto topics = std::make_shared<GroupTopics>();
  topics->name = group;
  topics->nearest = WatchedTopic::advertise<Nearest>(node, name + "/nearest", kQueueLength);
  topics->alerts = WatchedTopic::advertise<Alert>(
      node, name + "/alerts", kAlertQueueLength, [weak = std::weak_ptr<GroupTopics>(topics)] {
        if (const std::shared_ptr<GroupTopics> known = weak.lock()) known->repeat = true;
      });
  return topics;
}

// How many pairs by rule lack a transform or are cut is known for the whole scene alone. They count for a
// group as far as it has so many pairs without a tracker.
OtherPairs othersOf(std::size_t count, const OtherPairs& all) {
  OtherPairs others;
  others.missing = std::min<std::uint64_t>(count, all.missing);
  others.cut = std::min<std::uint64_t>(count - others.missing, all.cut);
  others.beyond = count - others.missing - others.cut;
  if (others.beyond + others.cut > 0) others.lower_bound = all.lower_bound;
  return others;
}

// The more urgent, the less.
std::pair<int, double> urgencyOf(const TrackedPair& pair) {
  const WarningState state = pair.warning.state();
  const int order = state == WarningState::Warning ? 0 : state == WarningState::Unknown ? 1 : 2;
  const bool has_distance = pair.solved() && !std::isnan(pair.solution.distance);
  return {order, has_distance ? pair.solution.distance : pair.box_bound.value_or(kInfinity)};
}

}  // namespace

ServedGroups GroupPublishers::serve(const Scene& scene, const ServedGroups* before) {
  ServedGroups groups;
  groups.members = detail::GroupMembers(scene);
  for (const std::string& name : groups.members.names()) {
    std::shared_ptr<GroupTopics> topics;
    for (std::size_t i = 0; before != nullptr && i < before->topics.size() && !topics; ++i) {
      if (before->topics[i]->name == name) topics = before->topics[i];
    }
    groups.topics.push_back(topics ? std::move(topics) : advertise(node_, name));
  }
  if (scene.groups.size() > groups.topics.size() && !std::exchange(reported_, true)) {
    ROS_WARN("The scene has %zu groups: the first %zu by name have topics, the others none.",
             scene.groups.size(), groups.topics.size());
  }
  return groups;
}

void GroupPublishers::readDemand(const ServedGroups& groups) {
  nearest_wanted_ = alerts_wanted_ = 0;
  for (std::size_t i = 0; i < groups.topics.size(); ++i) {
    if (groups.topics[i]->nearest.isWatched()) nearest_wanted_ |= Mask{1} << i;
    if (groups.topics[i]->alerts.isWatched()) {
      alerts_wanted_ |= Mask{1} << i;
    } else {
      groups.topics[i]->state = WarningState::Clear;
    }
  }
}

bool GroupPublishers::wants(const ServedGroups& groups, const TrackedPair& pair) const {
  if (isIdle()) return false;
  const Mask mask = facing(groups, *pair.origin);
  return (mask & nearest_wanted_) != 0 || ((mask & alerts_wanted_) != 0 && pair.settings.warning_distance);
}

void GroupPublishers::publish(const Scene& scene, std::uint64_t revision, const ServedGroups& groups,
                              const PublishedPairs& pairs, const OtherPairs& others, ros::Time now) {
  if (isIdle()) return;
  for (std::size_t i = 0; i < groups.topics.size(); ++i) {
    if (isOf(nearest_wanted_, i)) {
      GroupTopics& topics = *groups.topics[i];
      if (std::exchange(topics.counted_revision, revision) != revision) {
        topics.ruled_pairs = groups.members.countFacing(scene, i);
      }
      publishNearest(groups, i, scene.pairs.size(), pairs, others, now);
    }
    if (isOf(alerts_wanted_, i)) publishAlert(groups, i, pairs, others, now);
  }
}

void GroupPublishers::publishNearest(const ServedGroups& groups, std::size_t group, std::size_t listed,
                                     const PublishedPairs& pairs, const OtherPairs& others, ros::Time now) {
  const GroupTopics& topics = *groups.topics[group];
  const auto counts = [&](const PublishedPair& pair) {
    return isOf(facing(groups, *pair.tracked->origin), group);
  };
  std::size_t tracked = 0;
  for (std::size_t i = listed; i < pairs.size(); ++i) tracked += counts(*pairs[i]) ? 1 : 0;
  const OtherPairs others_here = othersOf(topics.ruled_pairs - std::min(tracked, topics.ruled_pairs), others);
  topics.nearest.publish(
      boost::make_shared<Nearest>(nearestOf(pairs, others_here, reference_frame_, now, counts)));
}

// The group is in warning while one of its pairs is; the alert has the nearest of these.
void GroupPublishers::publishAlert(const ServedGroups& groups, std::size_t group, const PublishedPairs& pairs,
                                   const OtherPairs& others, ros::Time now) {
  GroupTopics& topics = *groups.topics[group];
  const PublishedPair* told = nullptr;
  for (const auto& pair : pairs) {
    if (!pair->demand().due || !pair->tracked->settings.warning_distance ||
        !isOf(facing(groups, *pair->tracked->origin), group))
      continue;
    if (told == nullptr || urgencyOf(*pair->tracked) < urgencyOf(*told->tracked)) told = pair.get();
  }
  const WarningState state = told == nullptr ? WarningState::Clear : told->tracked->warning.state();
  const bool repeat = topics.repeat.exchange(false) && state != WarningState::Clear;
  if (std::exchange(topics.state, state) == state && !repeat) return;
  Alert alert;
  if (told != nullptr) {
    alert = toAlert(*told);
    topics.last = told->heading;
  } else {  // the pair of the last alert is not tracked any more
    topics.last.stamp = now;
    topics.last.warning = false;
    alert = clearedAlert(topics.last, others);
  }
  alert.group = topics.name;
  topics.alerts.publish(boost::make_shared<Alert>(std::move(alert)));
}

}  // namespace concave_distance

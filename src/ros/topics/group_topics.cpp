#include "group_topics.h"

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>

#include "alerts.h"
#include "base/constants.h"
#include "nearest.h"
#include "scene/matching_bodies.h"
#include "topic_name.h"

namespace concave_distance {
namespace {

// The more urgent, the less: pairs in warning, those without a distance, the others, each the nearest first.
std::pair<int, double> urgencyOf(const TrackedPair& pair) {
  const WarningState state = pair.warning.state();
  const int order = state == WarningState::Warning ? 0 : state == WarningState::Unknown ? 1 : 2;
  return {order,
          std::isnan(pair.solution.distance) ? pair.box_bound.value_or(kInfinity) : pair.solution.distance};
}

// The group is in warning while one of its pairs is; the alert has the nearest of these.
// @param told the most urgent of its pairs; nullptr: that of the last alert is not tracked any more
void publishAlert(const std::string& group, const PublishedPair* told, const OtherPairs& others,
                  ros::Time now, GroupTopics& topics) {
  const WarningState state = told == nullptr ? WarningState::Clear : told->tracked->warning.state();
  const bool repeat = topics.alerts.takeNew() && state != WarningState::Clear;
  if (std::exchange(topics.state, state) == state && !repeat) return;
  if (told != nullptr) topics.last = told->heading;
  if (told == nullptr) topics.last.stamp = now;
  topics.last.warning = state == WarningState::Warning;
  auto alert =
      boost::make_shared<Alert>(told == nullptr ? clearedAlert(topics.last, others) : toAlert(*told));
  alert->group = group;
  topics.alerts.publish(alert);
}

}  // namespace

ServedGroups serveGroups(const ros::NodeHandle& node, const Scene& scene, const ServedGroups& before) {
  ServedGroups groups;
  for (const auto& [name, members] : scene.groups) {
    ServedGroup& group = groups[name];
    group.stands = detail::standingFor(scene, name);
    const auto known = before.find(name);
    group.topics = known != before.end() ? known->second.topics : std::make_shared<GroupTopics>();
    if (known != before.end()) continue;
    const std::string topic = "groups/" + topicName(name);
    group.topics->nearest = WatchedTopic::advertise<Nearest>(node, topic + "/nearest", kQueueLength);
    group.topics->alerts = WatchedTopic::advertise<Alert>(node, topic + "/alerts", kAlertQueueLength);
  }
  return groups;
}

bool readGroupDemand(const ServedGroups& groups) {
  bool is_any = false;
  for (const auto& each : groups) {
    GroupTopics& topics = *each.second.topics;
    topics.nearest_wanted = topics.nearest.isWatched();
    topics.alerts_wanted = topics.alerts.isWatched();
    if (!topics.alerts_wanted) topics.state = WarningState::Clear;
    is_any = is_any || topics.nearest_wanted || topics.alerts_wanted;
  }
  return is_any;
}

bool isWantedOfGroups(const ServedGroups& groups, const TrackedPair& pair) {
  return std::any_of(groups.begin(), groups.end(), [&](const auto& each) {
    const GroupTopics& topics = *each.second.topics;
    const bool is_wanted = topics.nearest_wanted || (topics.alerts_wanted && pair.settings.warning_distance);
    return is_wanted && each.second.faces(pair);
  });
}

void publishGroups(const Scene& scene, const ServedGroups& groups, const PublishedPairs& pairs,
                   const OtherPairs& others, const std::string& reference_frame, ros::Time now) {
  for (const auto& [name, group] : groups) {
    if (!group.topics->nearest_wanted && !group.topics->alerts_wanted) continue;
    const auto faces = [&group = group](const PublishedPair& pair) { return group.faces(*pair.tracked); };
    std::size_t tracked = 0;  // by rule
    const PublishedPair* told = nullptr;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!faces(*pairs[i])) continue;
      tracked += i < scene.pairs.size() ? 0 : 1;
      if (!pairs[i]->demand().due || !pairs[i]->tracked->settings.warning_distance) continue;
      if (told == nullptr || urgencyOf(*pairs[i]->tracked) < urgencyOf(*told->tracked)) told = pairs[i].get();
    }
    if (group.topics->alerts_wanted) publishAlert(name, told, others, now, *group.topics);
    if (!group.topics->nearest_wanted) continue;
    if (!group.ruled_pairs) group.ruled_pairs = detail::countFacing(scene, group.stands);
    // How many pairs by rule lack a transform or are cut is known for the whole scene alone. They count for a
    // group as far as it has so many pairs without a tracker.
    const std::uint64_t count = *group.ruled_pairs - std::min(tracked, *group.ruled_pairs);
    OtherPairs rest;
    rest.missing = std::min(count, others.missing);
    rest.cut = std::min(count - rest.missing, others.cut);
    rest.beyond = count - rest.missing - rest.cut;
    if (rest.beyond + rest.cut > 0) rest.lower_bound = others.lower_bound;
    group.topics->nearest.publish(
        boost::make_shared<Nearest>(nearestOf(pairs, rest, reference_frame, now, faces)));
  }
}

}  // namespace concave_distance

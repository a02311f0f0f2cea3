#pragma once

#include <ros/node_handle.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/scene/cycle_counts.h"
#include "ros/messages/published_pair.h"
#include "watched_topic.h"

namespace concave_distance {

/// The topics of a group, with what the cycle's thread knows of them.
struct GroupTopics {
  WatchedTopic nearest;
  WatchedTopic alerts;
  bool nearest_wanted = false;  ///< in this cycle, as the next
  bool alerts_wanted = false;
  WarningState state = WarningState::Clear;  ///< in the last alert, as the next
  PairHeading last;
};

/// A group against everything else: pairs of which one body stands for it and the other does not.
struct ServedGroup {
  std::vector<bool> stands;                        ///< by body, detail::standingFor()
  mutable std::optional<std::size_t> ruled_pairs;  ///< detail::countFacing(), for the cycle's thread
  std::shared_ptr<GroupTopics> topics;

  bool faces(const TrackedPair& pair) const {
    return stands[pair.origin->body_a] != stands[pair.origin->body_b];
  }
};
using ServedGroups = std::map<std::string, ServedGroup>;

/// Returns the groups of a scene and advertises the topics of those that `before` does not
/// have. Not from the cycle's thread.
ServedGroups serveGroups(const ros::NodeHandle& node, const Scene& scene, const ServedGroups& before);
/// Reads who listens, for the cycle that follows. Returns whether anybody does.
bool readGroupDemand(const ServedGroups& groups);
/// Returns whether the distance of a pair is needed.
bool isWantedOfGroups(const ServedGroups& groups, const TrackedPair& pair);
/// Publishes the nearest pair and the alerts of the groups in which somebody is interested.
/// @param pairs of the cycle; @param others pairs by rule that `pairs` does not have
void publishGroups(const Scene& scene, const ServedGroups& groups, const PublishedPairs& pairs,
                   const OtherPairs& others, const std::string& reference_frame, ros::Time now);

}  // namespace concave_distance

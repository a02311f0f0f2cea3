#pragma once

#include <ros/node_handle.h>
#include <ros/time.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/scene/body_poses.h"
#include "concave_distance/scene/warning_monitor.h"
#include "ros/messages/published_pair.h"
#include "scene/group_members.h"
#include "watched_topic.h"

namespace concave_distance {

/// The topics of one group, and what its last alert said, which only the cycle's thread reads.
struct GroupTopics {
  std::string name;
  WatchedTopic nearest;
  WatchedTopic alerts;
  std::atomic<bool> repeat{false};  ///< somebody has subscribed to the alerts
  WarningState state = WarningState::Clear;
  PairHeading last;                                    ///< of the pair in the last alert
  std::size_t ruled_pairs = 0;                         ///< GroupMembers::countFacing() of the next
  std::uint64_t counted_revision = ~std::uint64_t{0};  ///< ServedScene::revision
};

/// The groups of a scene, each with its topics.
struct ServedGroups {
  detail::GroupMembers members;
  std::vector<std::shared_ptr<GroupTopics>> topics;  ///< one for each of members.names()
};

/// Publishes the nearest pair and the alerts of each group against everything else: pairs with one body that
/// stands for the group and one that does not.
class GroupPublishers {
 public:
  GroupPublishers(const ros::NodeHandle& node, std::string reference_frame)
      : node_(node), reference_frame_(std::move(reference_frame)) {}

  /// Advertises the topics of groups that have none yet. Not from the cycle's thread.
  /// @param before the groups of the previous scene; nullptr: none
  ServedGroups serve(const Scene& scene, const ServedGroups* before);

  /// Reads who listens, for the cycle that follows.
  void readDemand(const ServedGroups& groups);
  bool isIdle() const { return (nearest_wanted_ | alerts_wanted_) == 0; }
  /// Returns whether the distance of a pair is needed.
  bool wants(const ServedGroups& groups, const TrackedPair& pair) const;

  /// @param pairs of the cycle; @param others pairs by rule that `pairs` does not have
  /// @param revision of the scene
  void publish(const Scene& scene, std::uint64_t revision, const ServedGroups& groups,
               const PublishedPairs& pairs, const OtherPairs& others, ros::Time now);

 private:
  void publishNearest(const ServedGroups& groups, std::size_t group, std::size_t listed,
                      const PublishedPairs& pairs, const OtherPairs& others, ros::Time now);
  void publishAlert(const ServedGroups& groups, std::size_t group, const PublishedPairs& pairs,
                    const OtherPairs& others, ros::Time now);

  ros::NodeHandle node_;
  std::string reference_frame_;
  bool reported_ = false;  ///< that there are too many groups
  // readDemand found these for this cycle.
  detail::GroupMembers::Mask nearest_wanted_ = 0;
  detail::GroupMembers::Mask alerts_wanted_ = 0;
};

}  // namespace concave_distance

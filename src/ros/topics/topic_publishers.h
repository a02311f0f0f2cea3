#pragma once

#include <concave_distance/PairContactState.h>
#include <concave_distance/PairNiches.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/made_once.h"
#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/scene/scene.h"
#include "constraint_topic.h"
#include "group_topics.h"
#include "pair_topics.h"
#include "ros/markers/marker_style.h"
#include "ros/messages/published_pair.h"
#include "scene/cycle_statistics.h"
#include "watched_topic.h"

namespace concave_distance {

class SceneMarkers;

/// A scene together with the topics of its pairs: what one cycle works on.
struct ServedScene {
  std::shared_ptr<const Scene> scene;
  PairTopicList topics;  ///< one per scene->pairs: only listed pairs have topics
  ServedGroups groups;
  MarkerStyle marker_style;             ///< as configured
  std::uint64_t settings_revision = 0;  ///< another one: the settings of pairs that were there have changed
  std::uint64_t revision = 0;           ///< another one: another scene
  MadeOnce<std::shared_ptr<const SceneKinematics>> joints;  ///< see jointsOf()
};

/// The joints of its robots, made when they are first asked for. @throws Error as SceneKinematics
std::shared_ptr<const SceneKinematics> jointsOf(const ServedScene& served);

/// Counts what was built and sent in one cycle.
struct PublishReport {
  Series latency;  ///< s, from the transforms' time to the end of publishing, of each pair newly solved
  std::uint32_t messages = 0;  ///< pairs turned into messages
  std::uint32_t markers = 0;   ///< drawn or deleted
};

/// Holds what the parameters say of the markers, and the cycle.
struct MarkerOptions {
  bool publish = true;
  bool contacts = true;  ///< beside the niches
  bool due = true;       ///< they are sent in this cycle when somebody listens
};

/// Every topic of the cycle: who listens to what, and one cycle's messages.
class TopicPublishers {
 public:
  /// @param pair_topics patterns of the pairs with their own topics, see PairTopicKeeper
  TopicPublishers(const ros::NodeHandle& node, std::string reference_frame,
                  std::optional<std::vector<std::string>> pair_topics,
                  const ConstraintOptions& constraints = {});
  ~TopicPublishers();

  /// Advertises the topics of pairs that have none yet; those of pairs that are gone end with the last
  /// ServedScene that names them. Not from the cycle's thread: it talks to the master.
  /// Pairs that have topics of their own are listed in the scene.
  /// @param settings_changed as ServedScene::settings_revision
  std::shared_ptr<const ServedScene> serve(Scene scene, const ServedScene* before, const MarkerStyle& style,
                                           bool settings_changed);

  /// Reads who listens, for the cycle that follows.
  void readDemand(const ServedScene& served, const MarkerOptions& markers);
  /// Returns what is wanted of the pair at this place in the cycle's pairs.
  PairDemand demandOf(const ServedScene& served, std::size_t place, const TrackedPair& tracked) const;

  /// Returns whether no topic has a subscriber that needs anything computed or published.
  bool isIdle() const;

  /// Publishes the pairs that are due. A message is built once and not touched after it was published.
  /// @param others the pairs by rule that `pairs` does not have
  /// @param marker_lifetime seconds
  PublishReport publish(const ServedScene& served, const PublishedPairs& pairs, const OtherPairs& others,
                        double marker_lifetime, ros::Time now);

  /// Publishes the rows of constraints, where they are wanted.
  void publishConstraints(const ConstraintInput& input, ros::Time now) { constraints_.publish(input, now); }
  /// The clock has jumped back: rows begin anew.
  void restart() { constraints_.reset(); }

  /// The alerts of pairs that left the scene (DistanceCycle::takeRetired).
  void publishRetired(const PublishedPairs& pairs);

 private:
  void takeJoints(const ServedScene& served);
  void publishAlerts(const PublishedPairs& pairs);
  /// @return how many markers
  std::size_t publishMarkers(const ServedScene& served, const PublishedPairs& pairs, double lifetime,
                             ros::Time now);
  void publishLists(const ServedScene& served, const PublishedPairs& pairs, const OtherPairs& others,
                    ros::Time now);
  void publishNearest(const PublishedPairs& pairs, const OtherPairs& others, ros::Time now);
  void publishContacts(const ServedScene& served, const PublishedPairs& pairs, ros::Time now);

  ros::NodeHandle node_;
  std::string reference_frame_;
  PairTopicKeeper pair_topics_;
  WatchedTopic nearest_;
  WatchedTopic nearest_distance_;
  WatchedTopic distances_;
  WatchedTopic niches_;
  WatchedTopic contacts_;
  WatchedTopic markers_;
  WatchedTopic alerts_;
  ConstraintTopic constraints_;
  // readDemand found these for this cycle.
  bool nearest_wanted_ = false;
  bool distances_wanted_ = false;
  bool niches_wanted_ = false;
  bool contacts_wanted_ = false;
  bool markers_wanted_ = false;
  bool contact_markers_wanted_ = false;
  bool alerts_wanted_ = false;
  bool groups_wanted_ = false;
  bool own_wanted_ = false;       ///< a pair's own topics
  bool are_markers_due_ = false;  ///< in this cycle, when somebody listens
  bool markers_due_ = false;
  std::unique_ptr<SceneMarkers> drawing_;
  std::vector<PairNiches> messages_;                ///< of the pairs in lists
  std::vector<PairContactState> contact_messages_;  ///< of those whose effects are wanted
};

}  // namespace concave_distance

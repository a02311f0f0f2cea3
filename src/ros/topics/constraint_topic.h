#pragma once

#include <ros/node_handle.h>
#include <ros/time.h>

#include <memory>
#include <string>

#include "concave_distance/kinematics/constraint_rows.h"
#include "ros/tf/scene_states.h"
#include "watched_topic.h"

namespace concave_distance {

/// Holds what the parameters say of rows.
struct ConstraintOptions {
  ConstraintSettings settings;
  bool always = false;  ///< they are followed without subscribers too
};

/// Holds what rows need of one cycle.
struct ConstraintInput {
  const SceneTracker::Pairs& pairs;
  TfLocate& locate;
  const OtherPairs& others;
};

/// The topic `constraints`: rows of the joints of all robots, while somebody listens or `always`.
class ConstraintTopic {
 public:
  ConstraintTopic(ros::NodeHandle& node, std::string reference_frame, ConstraintOptions options);

  /// Reads whether rows are wanted in the cycle that follows.
  void readDemand();
  bool isWanted() const { return is_wanted_; }
  /// Takes the joints of the scene of the cycle; not called while rows are not wanted.
  /// @param problem why there are none; empty: there are
  void setScene(std::shared_ptr<const SceneKinematics> joints, const std::string& problem);
  /// Returns whether a joint moves a body of the pair, and rows are wanted.
  bool concerns(const TrackedPair& pair) const;
  void publish(const ConstraintInput& input, ros::Time now);
  /// Frees all slots: the clock has jumped back.
  void reset();

 private:
  ros::Time oldestTransform(const ConstraintInput& input, ros::Time now) const;

  WatchedTopic topic_;
  std::string reference_frame_;
  ConstraintOptions options_;
  bool is_wanted_ = false;
  std::shared_ptr<const SceneKinematics> joints_;
  std::string problem_;
  std::unique_ptr<ConstraintRows> rows_;  ///< nullptr while they are not wanted
  SceneStates states_;
};

}  // namespace concave_distance

#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "bag_transforms.h"
#include "ros/tf/transform_buffer.h"

namespace concave_distance {

/// One stamp at which transforms of a bag move.
struct BagMoment {
  ros::Time stamp;
  ros::Time recorded;                      ///< when the first transform of that stamp was
  std::unordered_set<std::string> frames;  ///< that have a transform of it
};

/// Holds what of a bag the node's rules refuse.
struct BagRefusals {
  static constexpr std::size_t kMostReasons = 10;
  std::uint64_t count = 0;  ///< of transforms, and of messages that are none
  /// The first reason for each frame and sender, up to kMostReasons.
  std::map<std::string, std::string> reasons;
};

/// Puts the transforms of a bag into the node's buffer, one stamp after the other. A stamp waits for others
/// until transforms are newer than it by the time after which they are stale (or half of the cache), so that
/// slower publishers are interpolated.
class BagMoments {
 public:
  /// @param stale_after s
  BagMoments(const TransformLimits& limits, double stale_after);
  BagMoments(const BagMoments&) = delete;
  BagMoments& operator=(const BagMoments&) = delete;

  /// Takes messages in the order of their times.
  void take(const BagMessage& message);
  /// Gives the buffer the transforms of the next stamp, and returns that; empty: it waits for later ones.
  /// @param is_end none will come
  std::optional<BagMoment> next(bool is_end);

  const TransformBuffer& buffer() const { return buffer_; }
  const BagRefusals& refusals() const { return refusals_; }

 private:
  struct Held {
    geometry_msgs::TransformStamped transform;
    std::string sender;
  };
  using Frames = std::unordered_set<std::string>;
  /// Holds what happens at one stamp.
  struct Waiting {
    ros::Time recorded;
    Frames frames;
    std::vector<Held> changes;  ///< of static transforms, to be made first
  };
  /// The moving transforms of one frame. The buffer gets one at its stamp; before that only where an earlier
  /// stamp needs it to be interpolated, because tf rounds where it has newer ones.
  struct Track {
    std::map<ros::Time, Held> waiting;
    ros::Time newest;         ///< that the buffer has; zero: none
    ros::Time newest_of_bag;  ///< that has come
    std::string sender;       ///< of that
  };

  void takeTransform(const geometry_msgs::TransformStamped& transform, const BagMessage& message);
  void takeFixed(const geometry_msgs::TransformStamped& transform, const BagMessage& message);
  bool insert(const Held& held, bool fixed);
  Waiting& waitingAt(ros::Time stamp, ros::Time recorded);
  void note(const geometry_msgs::TransformStamped& transform, const std::string& sender,
            const TransformProblem& problem);
  void forgetOldAnswers();
  void fillBuffer(ros::Time stamp, Frames& frames);
  bool insertNext(Track& track);

  const TransformLimits limits_;
  const double stale_after_;  ///< s
  const double lag_;          ///< s
  ros::Time now_;             ///< of the last message
  ros::Time buffer_now_;      ///< the buffer's clock: when what it is given was recorded
  TransformBuffer buffer_;
  std::map<std::string, Track> tracks_;  ///< by frame
  std::map<ros::Time, Waiting> waiting_;
  std::map<ros::Time, Frames> answered_;  ///< as far back as the buffer takes transforms
  ros::Time newest_;                      ///< stamp of a moving transform
  std::unordered_map<std::string, geometry_msgs::TransformStamped> fixed_;
  BagRefusals refusals_;
};

}  // namespace concave_distance

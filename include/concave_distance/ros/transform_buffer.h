#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "concave_distance/ros/transform_checks.h"

namespace concave_distance {

/// tf2's buffer behind a check: what cannot be right does not enter it, so that it recovers by itself as soon
/// as right transforms come. Thread-safe.
class TransformBuffer {
 public:
  using Clock = std::function<ros::Time()>;

  explicit TransformBuffer(
      const TransformLimits& limits, Clock clock = [] { return ros::Time::now(); });

  /// @param sender node that published it, for messages
  /// @param fixed it came on /tf_static
  /// @return why it was refused; empty: it was taken
  std::optional<TransformProblem> insert(geometry_msgs::TransformStamped transform, const std::string& sender,
                                         bool fixed);

  /// A clock that jumped back (a bag that starts over, a simulation that is reset) invalidates every
  /// transform that moves. insert() looks at the clock, too.
  void checkClock();

  /// For lookups. Later transforms come into it as well, until a frame changes its kind or the clock jumps
  /// back: ask again for each cycle or query.
  std::shared_ptr<const tf2::BufferCore> current() const;

  std::size_t frameCount() const;

 private:
  struct Frame {
    geometry_msgs::TransformStamped latest;
    std::string sender;
    bool fixed = false;
    ros::Time taken;  ///< when `latest` came
  };

  void noteClock(ros::Time now);
  std::optional<TransformProblem> admitFrame(const geometry_msgs::TransformStamped& transform, bool fixed,
                                             ros::Time now);
  std::optional<TransformProblem> changeKind(Frame& frame, bool fixed, ros::Time now);
  bool makesLoop(const std::string& child, const std::string& parent) const;
  bool hasSpace(ros::Time now);
  void rebuild() const;

  const TransformLimits limits_;
  const Clock clock_;
  mutable std::mutex mutex_;
  std::unordered_map<std::string, Frame> frames_;  ///< by the child's name
  // tf2 forgets neither a name nor a frame's kind: then the buffer is made anew, when it is next asked for.
  mutable std::shared_ptr<tf2::BufferCore> buffer_;
  mutable bool outdated_ = false;
  mutable std::unordered_set<std::string> names_;  ///< that buffer_ has met
  ros::Time last_now_;
  ros::Time last_clearance_;  ///< of names
  std::size_t refused_for_space_ = 0;
};

}  // namespace concave_distance

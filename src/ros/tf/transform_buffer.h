#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "transform_checks.h"

namespace concave_distance {

/// tf2's buffer behind a check: transforms that cannot be right do not enter it, so that one wrong transform
/// does not block the correct ones that follow. Thread-safe.
class TransformBuffer {
 public:
  using Clock = std::function<ros::Time()>;

  explicit TransformBuffer(
      const TransformLimits& limits, Clock clock = [] { return ros::Time::now(); });

  /// @param sender node that published it, for messages
  /// @param fixed it came on /tf_static
  /// @return why it was refused; empty: it was accepted
  std::optional<TransformProblem> insert(geometry_msgs::TransformStamped transform, const std::string& sender,
                                         bool fixed);

  /// Clears moving transforms if the clock has jumped back (a bag or simulation that restarts). insert() does
  /// the same.
  void checkClock();

  /// The buffer for lookups. It is replaced when a frame changes between static and moving or the clock jumps
  /// back; so get it anew for each cycle or query.
  std::shared_ptr<const tf2::BufferCore> current() const;

  std::size_t frameCount() const;

 private:
  struct Frame {
    geometry_msgs::TransformStamped latest;
    std::string sender;
    bool fixed = false;
    ros::Time taken;  ///< when `latest` came
    /// Lists the times of the moving transforms taken, ascending, as far back as tf2 keeps them.
    std::deque<ros::Time> stamps;
  };

  void noteClock(ros::Time now);
  std::optional<TransformProblem> admitFrame(const geometry_msgs::TransformStamped& transform, bool fixed,
                                             ros::Time now);
  std::optional<TransformProblem> changeKind(Frame& frame, bool fixed, ros::Time now);
  bool noteStamp(Frame& frame, ros::Time stamp) const;
  bool makesLoop(const std::string& child, const std::string& parent) const;
  bool hasSpace(ros::Time now);
  void rebuild() const;

  const TransformLimits limits_;
  const Clock clock_;
  mutable std::mutex mutex_;
  std::unordered_map<std::string, Frame> frames_;  ///< by the child's name
  // tf2 never forgets a name or whether a frame is static: then a new buffer is made at the next request.
  mutable std::shared_ptr<tf2::BufferCore> buffer_;
  mutable bool outdated_ = false;
  mutable std::unordered_set<std::string> names_;  ///< all names in buffer_
  ros::Time last_now_;
  ros::Time last_clearance_;  ///< of names
  std::size_t refused_for_space_ = 0;
};

}  // namespace concave_distance

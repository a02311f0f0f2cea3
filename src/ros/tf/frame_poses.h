#pragma once

#include <ros/time.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "concave_distance/scene/body_poses.h"
#include "tf_poses.h"

namespace concave_distance {

/// Where a body's frame is in one cycle.
struct FramePlace {
  TransformStatus status = TransformStatus::Missing;
  std::string message;  ///< why it is Missing, and why a hidden body is Stale
  ros::Time stamp;      ///< the newest time at which it is known in the reference frame; zero: fixed
};

/// Finds the poses of many frames in a reference frame, each once a cycle: every edge of the tf tree between
/// them is looked up at its newest time, and at the newest times of other frames before that. A pair of
/// frames has the earlier of their two newest times, as from lookUpPair(). Where the frames have more newest
/// times than the constructor was given, they are grouped, and each counts as the earliest of its group.
class FramePoses {
 public:
  static constexpr std::size_t kMostTimes = 4;  ///< in a cycle that has an end

  explicit FramePoses(std::size_t most_times = kMostTimes) : most_times_(most_times) {}

  /// The bodies then are at the origins of their frames.
  /// @param frames of the bodies, in their order
  /// @param epoch that poses() counts its seconds from; zero: less than a day before the first update()
  void setFrames(const std::string& reference, const std::vector<std::string>& frames, ros::Time epoch);
  ros::Time epoch() const { return epoch_; }
  /// Returns whether these are the frames; setFrames() need not be called again then.
  bool hasFrames(const std::string& reference, const std::vector<std::string>& frames) const;
  /// Says where the bodies are in their frames, from the next update() on: frame_from_body, in their order.
  void setPlaces(std::vector<Eigen::Isometry3d> places) { frame_from_body_ = std::move(places); }
  /// A frame whose newest time is older than `stale_after` seconds is Stale, and unknown to poses(). One that
  /// is ahead of `now` is taken at `now`, where tf has that.
  void update(const tf2::BufferCore& buffer, ros::Time now, double stale_after);
  /// Makes a body unknown until the next update(). @param why with a status other than Ok
  void hide(std::size_t body, FramePlace why);

  /// Returns the poses of the last update(). Its times are seconds since epoch().
  const BodyPoses& poses() const { return poses_; }
  const FramePlace& place(std::size_t body) const {
    for (const auto& [hidden, why] : hidden_) {
      if (hidden == body) return why;
    }
    return places_[place_of_body_[body]];
  }
  /// Returns whether the place of a body in the reference frame depends on the transform of one of these
  /// frames to its parent.
  bool dependsOn(std::size_t body, const std::unordered_set<std::string>& frames) const;
  /// Returns the time at which two bodies are known together; zero: both are fixed.
  ros::Time commonStamp(std::size_t body_a, std::size_t body_b) const;
  /// Returns reference_from_body at the time that it has together with another body.
  Eigen::Isometry3d referenceFrom(std::size_t body, std::size_t other) const;

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  /// A frame with the transform to its parent.
  struct Node {
    std::string name;
    std::size_t parent = kNone;
    std::size_t depth = 0;
    FrameTransform edge;                              ///< at its newest time
    std::vector<Eigen::Isometry3d> parent_from_node;  ///< at stamps_, as the next
    std::vector<char> is_known;
  };
  void buildTree(const tf2::BufferCore& buffer);
  std::size_t nodeOf(const tf2::BufferCore& buffer, const std::string& frame, std::size_t length);
  void lookUpEdges(const tf2::BufferCore& buffer, ros::Time now);
  void findPlaces(const tf2::BufferCore& buffer, ros::Time now, double stale_after);
  void chooseTimes();
  void lookUpTimes(const tf2::BufferCore& buffer);
  void fillPoses(ros::Time now);
  bool isKnownAt(std::size_t node, std::size_t time) const;
  std::size_t ancestorOf(std::size_t a, std::size_t b) const;
  Eigen::Isometry3d fromAncestor(std::size_t ancestor, std::size_t node, std::size_t time) const;
  Eigen::Isometry3d between(std::size_t target, std::size_t source, std::size_t time) const;
  std::size_t timeOf(ros::Time stamp) const;

  std::size_t most_times_;
  std::string reference_;
  std::vector<std::string> frames_;         ///< each once
  std::vector<std::size_t> place_of_body_;  ///< in frames_
  std::vector<Eigen::Isometry3d> frame_from_body_;
  std::vector<Node> nodes_;
  std::unordered_map<std::string, std::size_t> node_of_;
  std::size_t reference_node_ = kNone;
  std::vector<std::size_t> node_of_frame_;
  bool is_whole_ = false;           ///< every frame is connected with the reference frame
  std::vector<FramePlace> places_;  ///< of frames_
  std::vector<std::pair<std::size_t, FramePlace>> hidden_;  ///< bodies, few
  std::vector<ros::Time> stamps_;                           ///< ascending, at most most_times_
  std::vector<ros::Time> all_stamps_;
  BodyPoses poses_;
  ros::Time epoch_;
};

}  // namespace concave_distance

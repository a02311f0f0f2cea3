#pragma once

#include <ros/time.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "concave_distance/scene/scene_tracker.h"
#include "ros/time_difference.h"
#include "scene/frames_now.h"
#include "tf_poses.h"

namespace concave_distance {

/// Finds bodies by tf in one cycle: each alone at the newest time of its frame, and two together, as
/// SceneTracker::Locate does, at the earlier of their two newest times. Transforms are composed through the
/// nearest frame that both ends descend from: tf2 composes them through the root, and two frames of a robot
/// 1e9 m from it would lose seven digits. Each is looked up once a cycle. One thread at a time.
class TfLocate {
 public:
  explicit TfLocate(std::string reference_frame) : reference_(std::move(reference_frame)) {}

  /// Follows these bodies from the next update() on. Allocates nothing. @param frames in their order
  /// @param frame_from_body for each where it is in its frame
  void setBodies(std::vector<std::string> frames, std::vector<Eigen::Isometry3d> frame_from_body) {
    frames_ = std::move(frames);
    frame_from_body_ = std::move(frame_from_body);
  }
  /// Begins a cycle. A frame whose newest time is older than `stale_after` seconds is Stale; one that is
  /// ahead of `now` is taken at `now`, where tf has that.
  /// @param at time at which all frames are taken instead, whatever their age; zero: the newest one of each
  void update(std::shared_ptr<const tf2::BufferCore> buffer, ros::Time now,
              double stale_after = std::numeric_limits<double>::infinity(), ros::Time at = ros::Time());
  /// Makes a body unknown in this cycle. @param why with a status other than Ok
  void hide(std::size_t body, FrameTransform why);

  /// reference_from_body at the newest times; empty where a body is not known.
  const SceneTracker::Poses& poses() const { return poses_; }
  /// Returns where a body's frame is in the reference frame, with its newest time.
  const FrameTransform& place(std::size_t body) const { return *nodes_[node_of_body_[body]].place; }
  /// Returns B in A. Its time has the beginning of seconds().
  PairInput operator()(std::size_t body_a, std::size_t body_b);
  /// Returns reference_from_a at the time of the operator (`now` if both are fixed), or why there is none.
  /// @param is_located as the operator has answered
  FrameTransform placeOfA(std::size_t body_a, std::size_t body_b, bool is_located);
  /// Returns one frame seen from another. @param stamp zero: the newest time common to both
  FrameTransform find(const std::string& target, const std::string& source, ros::Time stamp);
  /// Seconds of a time, from a beginning that stays.
  double seconds(ros::Time time) const { return secondsBetween(epoch_, time); }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  struct Node {
    const std::string* name;  ///< in node_of_
    std::size_t parent = kNone;
    std::uint64_t visit = 0;
    std::optional<FrameTransform> place{};  ///< in the reference frame, of the frame of a body
  };
  std::size_t nodeOf(const std::string& frame);
  void findPlace(std::size_t node, ros::Time at);
  std::size_t ancestorOf(std::size_t a, std::size_t b);
  const FrameTransform& lookUp(std::size_t target, std::size_t source, ros::Time stamp);
  FrameTransform between(std::size_t target, std::size_t source, ros::Time stamp);
  ros::Time commonStamp(std::size_t body_a, std::size_t body_b) const;

  std::string reference_;
  std::vector<std::string> frames_;  ///< of the bodies, as the next
  std::vector<Eigen::Isometry3d> frame_from_body_;
  ros::Time epoch_;

  // Of one cycle.
  std::shared_ptr<const tf2::BufferCore> buffer_;
  ros::Time now_;
  double stale_after_ = 0.0;
  std::vector<Node> nodes_;  ///< frames of bodies and those above; the first is the reference frame
  std::unordered_map<std::string, std::size_t> node_of_;
  std::vector<std::size_t> node_of_body_;
  std::uint64_t visits_ = 0;
  std::map<std::tuple<std::size_t, std::size_t, ros::Time>, FrameTransform> known_;
  SceneTracker::Poses poses_;
};

/// Returns what tf knows of frames, for edits of a scene.
detail::FramesNow framesNow(std::shared_ptr<const tf2::BufferCore> buffer,
                            const std::string& reference_frame);

}  // namespace concave_distance

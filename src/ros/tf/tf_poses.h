#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "transform_buffer.h"

namespace concave_distance {

enum class TransformStatus : std::uint8_t { Ok, Missing, Stale };

/// The poses one pair is solved at, all of one time; and where the reference frame is.
struct PairTransforms {
  TransformStatus status = TransformStatus::Missing;
  std::string message;  ///< why the status is not Ok
  ros::Time stamp;      ///< of the transforms; the time asked at when all of them are static
  bool fixed = false;   ///< all of them are static
  Eigen::Isometry3d reference_from_a = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
};

/// One frame seen from another.
struct FrameTransform {
  TransformStatus status = TransformStatus::Missing;
  std::string message;
  ros::Time stamp;  ///< zero: static
  Eigen::Isometry3d target_from_source = Eigen::Isometry3d::Identity();
};

/// The only place that catches tf2's exceptions: they become a status with tf2's message. The transform of a
/// frame to itself is static, also for frames unknown to tf.
/// @param stamp zero: the newest time common to both frames
FrameTransform lookUpFrame(const tf2::BufferCore& buffer, const std::string& target,
                           const std::string& source, ros::Time stamp);

/// The frames a pair is located in.
struct PairFrames {
  std::string reference;
  std::string frame_a;
  std::string frame_b;
};

/// Common ancestors through which the transforms of a pair are composed. The caller keeps them between calls;
/// empty ones are looked up.
struct PairAncestors {
  std::string of_bodies;
  std::string of_reference;  ///< of the reference frame and frame_a
};

/// The nearest frame that both descend from (one of the two, if the other descends from it); empty when tf
/// does not connect them. tf2 composes every transform through the root of the tree, so that two frames of a
/// robot 1e9 m from the root would lose seven digits; from an ancestor it does not.
std::string commonAncestor(const tf2::BufferCore& buffer, const std::string& frame_a,
                           const std::string& frame_b);

/// Returns the message of a pair whose newest transforms are `age` seconds old.
std::string describeAge(const PairFrames& frames, double age, double stale_after);

/// All transforms of a pair at the newest time common to the two bodies' frames and the reference frame, each
/// composed through a common ancestor. Stale when that time is older than `stale_after` seconds (static
/// transforms never are). When it is ahead of `now`, the transforms at `now` are taken instead, if available.
PairTransforms lookUpPair(const tf2::BufferCore& buffer, const PairFrames& frames, ros::Time now,
                          double stale_after, PairAncestors& ancestors);

/// The same at a given time; for services. Never Stale.
PairTransforms lookUpPairAt(const tf2::BufferCore& buffer, const PairFrames& frames, ros::Time stamp);

/// Waits, at most `timeout` seconds of wall time (a paused clock does not hang a service), until both frames
/// are connected at `stamp`; zero: at any common time.
void waitForFrames(const TransformBuffer& buffer, const std::string& target, const std::string& source,
                   ros::Time stamp, double timeout);

}  // namespace concave_distance

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

/// Waits, at most `timeout` seconds of wall time (a paused clock does not hang a service), until both frames
/// are connected at `stamp`; zero: at any common time.
void waitForFrames(const TransformBuffer& buffer, const std::string& target, const std::string& source,
                   ros::Time stamp, double timeout);

}  // namespace concave_distance

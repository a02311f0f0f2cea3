#include "concave_distance/ros/tf_poses.h"

#include <ros/duration.h>
#include <tf2/exceptions.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

namespace concave_distance {
namespace {

// Wall seconds between two looks at the buffer of a service that waits for a transform.
constexpr double kWaitSlice = 0.002;
// Frames above one another; more is a loop.
constexpr std::size_t kLongestChain = 1000;

ros::Time olderOf(ros::Time left, ros::Time right) {
  if (left.isZero()) {
    return right;
  }
  return right.isZero() ? left : std::min(left, right);
}

PairTransforms failed(const FrameTransform& frame) {
  PairTransforms transforms;
  transforms.status = frame.status;
  transforms.message = frame.message;
  return transforms;
}

std::vector<std::string> frameAndAncestors(const tf2::BufferCore& buffer, const std::string& frame) {
  std::vector<std::string> chain = {frame};
  std::string parent;
  // tf2 refuses loops, but two threads may see a tree in between two changes.
  while (chain.size() < kLongestChain && buffer._getParent(chain.back(), ros::Time(0), parent)) {
    chain.push_back(parent);
  }
  return chain;
}

// @param stamp zero: the newest common time
PairTransforms locate(const tf2::BufferCore& buffer, const PairFrames& frames, ros::Time stamp,
                      std::string& ancestor) {
  if (ancestor.empty()) {
    ancestor = commonAncestor(buffer, frames.frame_a, frames.frame_b);
  }
  if (ancestor.empty()) {
    return failed(lookUpFrame(buffer, frames.frame_a, frames.frame_b, stamp));
  }
  struct Sight {
    const std::string& target;
    const std::string& source;
    FrameTransform seen;
  };
  std::array<Sight, 3> sights{{{ancestor, frames.frame_a, {}},
                               {ancestor, frames.frame_b, {}},
                               {frames.reference, frames.frame_a, {}}}};
  ros::Time common;
  for (Sight& sight : sights) {
    sight.seen = lookUpFrame(buffer, sight.target, sight.source, stamp);
    common = olderOf(common, sight.seen.stamp);
  }
  for (Sight& sight : sights) {
    // Usually one message brings every frame of a robot and nothing has to be looked up again.
    if (sight.seen.status == TransformStatus::Ok && !sight.seen.stamp.isZero() &&
        sight.seen.stamp != common) {
      sight.seen = lookUpFrame(buffer, sight.target, sight.source, common);
    }
    if (sight.seen.status != TransformStatus::Ok) {
      const PairTransforms failure = failed(sight.seen);
      ancestor.clear();  // the tree may have changed
      return failure;
    }
  }
  PairTransforms transforms;
  transforms.status = TransformStatus::Ok;
  transforms.stamp = common;
  transforms.fixed = common.isZero();
  transforms.a_from_b = sights[0].seen.target_from_source.inverse() * sights[1].seen.target_from_source;
  transforms.reference_from_a = sights[2].seen.target_from_source;
  return transforms;
}

}  // namespace

std::string withoutLeadingSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

FrameTransform lookUpFrame(const tf2::BufferCore& buffer, const std::string& target,
                           const std::string& source, ros::Time stamp) {
  FrameTransform result;
  try {
    const geometry_msgs::TransformStamped found = buffer.lookupTransform(target, source, stamp);
    result.status = TransformStatus::Ok;
    result.stamp = found.header.stamp;
    result.target_from_source = tf2::transformToEigen(found.transform);
  } catch (const tf2::TransformException& problem) {
    result.message = problem.what();
  }
  return result;
}

std::string commonAncestor(const tf2::BufferCore& buffer, const std::string& frame_a,
                           const std::string& frame_b) {
  const std::vector<std::string> above_a = frameAndAncestors(buffer, frame_a);
  for (const std::string& frame : frameAndAncestors(buffer, frame_b)) {
    if (std::find(above_a.begin(), above_a.end(), frame) != above_a.end()) {
      return frame;
    }
  }
  return "";
}

PairTransforms lookUpPair(const tf2::BufferCore& buffer, const PairFrames& frames, ros::Time now,
                          double stale_after, std::string& ancestor) {
  PairTransforms transforms = locate(buffer, frames, ros::Time(0), ancestor);
  if (transforms.status != TransformStatus::Ok) {
    return transforms;
  }
  if (transforms.fixed) {
    transforms.stamp = now;
  }
  const double age = (now - transforms.stamp).toSec();
  if (age > stale_after) {
    std::ostringstream message;
    message << "the newest transform between '" << frames.frame_a << "', '" << frames.frame_b << "' and '"
            << frames.reference << "' is " << age << " s old; ~stale_after is " << stale_after << " s";
    transforms.status = TransformStatus::Stale;
    transforms.message = message.str();
  }
  return transforms;
}

PairTransforms lookUpPairAt(const tf2::BufferCore& buffer, const PairFrames& frames, ros::Time stamp) {
  std::string ancestor;
  PairTransforms transforms = locate(buffer, frames, stamp, ancestor);
  transforms.stamp = stamp;
  return transforms;
}

void waitForFrames(const tf2::BufferCore& buffer, const std::string& target, const std::string& source,
                   ros::Time stamp, double timeout) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(timeout);
  while (!buffer.canTransform(target, source, stamp) && ros::WallTime::now() < deadline) {
    ros::WallDuration(kWaitSlice).sleep();
  }
}

}  // namespace concave_distance

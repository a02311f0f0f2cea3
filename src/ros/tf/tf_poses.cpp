#include "tf_poses.h"

#include <ros/duration.h>
#include <tf2/exceptions.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <unordered_set>
#include <vector>

#include "base/number_text.h"
#include "ros/seconds_text.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

// Wall seconds between two looks at the buffer of a service that waits for a transform.
constexpr double kWaitSlice = 0.002;
// Longest chain of frames; a longer one is a loop.
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
  // Between two changes the tree may have a loop for a moment.
  while (chain.size() < kLongestChain && buffer._getParent(chain.back(), ros::Time(0), parent)) {
    chain.push_back(parent);
  }
  return chain;
}

struct Lookup {
  const std::string& target;
  const std::string& source;
  FrameTransform seen;
};

// All transforms at the same time. @param stamp zero: the newest common time. @return the first failure
const Lookup* lookUpAll(const tf2::BufferCore& buffer, ros::Time stamp, std::array<Lookup, 4>& lookups,
                        ros::Time& common) {
  for (Lookup& lookup : lookups) {
    lookup.seen = lookUpFrame(buffer, lookup.target, lookup.source, stamp);
    common = olderOf(common, lookup.seen.stamp);
  }
  for (Lookup& lookup : lookups) {
    // Usually one message brings every frame of a robot and nothing has to be looked up again.
    if (lookup.seen.status == TransformStatus::Ok && !lookup.seen.stamp.isZero() &&
        lookup.seen.stamp != common) {
      lookup.seen = lookUpFrame(buffer, lookup.target, lookup.source, common);
    }
    if (lookup.seen.status != TransformStatus::Ok) {
      return &lookup;
    }
  }
  return nullptr;
}

// @param stamp zero: the newest common time
PairTransforms locate(const tf2::BufferCore& buffer, const PairFrames& frames, ros::Time stamp,
                      PairAncestors& ancestors) {
  if (ancestors.of_bodies.empty()) {
    ancestors.of_bodies = commonAncestor(buffer, frames.frame_a, frames.frame_b);
  }
  if (ancestors.of_bodies.empty()) {
    return failed(lookUpFrame(buffer, frames.frame_a, frames.frame_b, stamp));
  }
  if (ancestors.of_reference.empty()) {
    ancestors.of_reference = commonAncestor(buffer, frames.reference, frames.frame_a);
  }
  if (ancestors.of_reference.empty()) {
    return failed(lookUpFrame(buffer, frames.reference, frames.frame_a, stamp));
  }
  std::array<Lookup, 4> lookups{{{ancestors.of_bodies, frames.frame_a, {}},
                                 {ancestors.of_bodies, frames.frame_b, {}},
                                 {ancestors.of_reference, frames.frame_a, {}},
                                 {ancestors.of_reference, frames.reference, {}}}};
  ros::Time common;
  if (const Lookup* failure = lookUpAll(buffer, stamp, lookups, common)) {
    const PairTransforms transforms = failed(failure->seen);
    ancestors = {};  // the tree may have changed
    return transforms;
  }
  PairTransforms transforms;
  transforms.status = TransformStatus::Ok;
  transforms.stamp = common;
  transforms.fixed = common.isZero();
  transforms.a_from_b = lookups[0].seen.target_from_source.inverse() * lookups[1].seen.target_from_source;
  transforms.reference_from_a =
      lookups[3].seen.target_from_source.inverse() * lookups[2].seen.target_from_source;
  return transforms;
}

}  // namespace

FrameTransform lookUpFrame(const tf2::BufferCore& buffer, const std::string& target,
                           const std::string& source, ros::Time stamp) {
  FrameTransform result;
  if (target == source) {
    // tf2 would use the stamp of the transform from its parent, however old.
    result.status = TransformStatus::Ok;
    return result;
  }
  try {
    const geometry_msgs::TransformStamped found = buffer.lookupTransform(target, source, stamp);
    result.status = TransformStatus::Ok;
    result.stamp = found.header.stamp;
    result.target_from_source = tf2::transformToEigen(found.transform);
  } catch (const tf2::TransformException& problem) {
    result.message = problem.what();
  } catch (const std::runtime_error& problem) {
    // tf2's own messages subtract stamps, which fails when they are more than 2^31 s apart.
    result.message = "no transform from '" + source + "' to '" + target + "' at " +
                     std::to_string(stamp.sec) + " s: " + problem.what();
  }
  return result;
}

std::string commonAncestor(const tf2::BufferCore& buffer, const std::string& frame_a,
                           const std::string& frame_b) {
  const std::vector<std::string> chain = frameAndAncestors(buffer, frame_a);
  const std::unordered_set<std::string> above_a(chain.begin(), chain.end());
  for (const std::string& frame : frameAndAncestors(buffer, frame_b)) {
    if (above_a.count(frame) > 0) {
      return frame;
    }
  }
  return "";
}

std::string describeAge(const PairFrames& frames, double age, double stale_after) {
  TextStream message;
  message << "the newest transform between '" << frames.frame_a << "', '" << frames.frame_b << "' and '"
          << frames.reference << "' is " << secondsText(age) << " s old; ~stale_after is " << stale_after
          << " s";
  return message.str();
}

PairTransforms lookUpPair(const tf2::BufferCore& buffer, const PairFrames& frames, ros::Time now,
                          double stale_after, PairAncestors& ancestors) {
  PairTransforms transforms = locate(buffer, frames, ros::Time(0), ancestors);
  if (transforms.status != TransformStatus::Ok) {
    return transforms;
  }
  if (transforms.fixed) {
    transforms.stamp = now;
  }
  if (transforms.stamp > now) {
    // Otherwise one transform ahead of the clock would stop the pair until the clock reaches it.
    PairTransforms present = locate(buffer, frames, now, ancestors);
    if (present.status == TransformStatus::Ok) {
      present.stamp = now;
      return present;
    }
  }
  const double age = secondsBetween(transforms.stamp, now);
  if (age > stale_after) {
    transforms.status = TransformStatus::Stale;
    transforms.message = describeAge(frames, age, stale_after);
  }
  return transforms;
}

PairTransforms lookUpPairAt(const tf2::BufferCore& buffer, const PairFrames& frames, ros::Time stamp) {
  PairAncestors ancestors;
  PairTransforms transforms = locate(buffer, frames, stamp, ancestors);
  transforms.stamp = stamp;
  return transforms;
}

void waitForFrames(const TransformBuffer& buffer, const std::string& target, const std::string& source,
                   ros::Time stamp, double timeout) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(timeout);
  while (target != source && !buffer.current()->canTransform(target, source, stamp) &&
         ros::WallTime::now() < deadline) {
    ros::WallDuration(kWaitSlice).sleep();
  }
}

}  // namespace concave_distance

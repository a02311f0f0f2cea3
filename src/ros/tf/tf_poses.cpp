#include "tf_poses.h"

#include <ros/duration.h>
#include <tf2/exceptions.h>
#include <tf2_eigen/tf2_eigen.h>

#include <stdexcept>

namespace concave_distance {
namespace {

// Wall seconds between two looks at the buffer of a service that waits for a transform.
constexpr double kWaitSlice = 0.002;

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

void waitForFrames(const TransformBuffer& buffer, const std::string& target, const std::string& source,
                   ros::Time stamp, double timeout) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(timeout);
  while (target != source && !buffer.current()->canTransform(target, source, stamp) &&
         ros::WallTime::now() < deadline) {
    ros::WallDuration(kWaitSlice).sleep();
  }
}

}  // namespace concave_distance

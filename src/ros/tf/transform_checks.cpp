#include "transform_checks.h"

#include <cmath>
#include <limits>

#include "base/constants.h"
#include "base/number_text.h"
#include "kinematics/frame_name.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

// tf2's own tolerance on the squared norm.
constexpr double kQuaternionTolerance = 1e-2;
constexpr std::uint32_t kNanosecondsPerSecond = 1'000'000'000;

std::optional<TransformProblem> findFrameProblem(const geometry_msgs::TransformStamped& transform) {
  for (const auto& [name, frame] :
       {std::pair<const char*, const std::string&>{"frame_id", transform.header.frame_id},
        {"child_frame_id", transform.child_frame_id}}) {
    const std::string problem = tfFrameProblem(frame);
    if (!problem.empty()) {
      return TransformProblem{std::string(name) + " is not a valid frame name: " + problem,
                              "correct the publisher"};
    }
  }
  if (transform.header.frame_id == transform.child_frame_id) {
    return TransformProblem{"the frame is its own parent", "correct the publisher"};
  }
  return std::nullopt;
}

std::optional<TransformProblem> findPoseProblem(const geometry_msgs::Transform& transform) {
  const auto& offset = transform.translation;
  for (const double value : {offset.x, offset.y, offset.z}) {
    if (!(std::abs(value) <= kLargestCoordinate)) {
      return TransformProblem{"its translation is (" + numberText(offset.x) + ", " + numberText(offset.y) +
                                  ", " + numberText(offset.z) + ") m",
                              "publish finite metres, at most " + numberText(kLargestCoordinate)};
    }
  }
  const auto& q = transform.rotation;
  const double squared_norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(std::abs(squared_norm - 1.0) <= kQuaternionTolerance)) {
    return TransformProblem{"the norm of its quaternion is " + numberText(std::sqrt(squared_norm)),
                            "publish unit quaternions; no rotation is w: 1"};
  }
  return std::nullopt;
}

std::optional<TransformProblem> findStampProblem(ros::Time stamp, ros::Time now,
                                                 const TransformLimits& limits) {
  if (now.isZero()) {
    return TransformProblem{"simulated time has not begun",
                            "start what publishes /clock, or set /use_sim_time to false"};
  }
  if (stamp.nsec >= kNanosecondsPerSecond) {
    return TransformProblem{"its stamp has " + std::to_string(stamp.nsec) + " nanoseconds",
                            "correct the publisher"};
  }
  if (stamp.isZero()) {
    return TransformProblem{"its stamp is zero",
                            "stamp it with the time of the pose; what never moves belongs on /tf_static"};
  }
  const double ahead = secondsBetween(now, stamp);
  if (ahead > limits.future_tolerance) {
    return TransformProblem{
        "its stamp is " + numberText(ahead) + " s ahead of the clock",
        "check that the clocks of the machines agree, or raise ~tf_future_tolerance, which is " +
            numberText(limits.future_tolerance) + " s"};
  }
  // tf2 adds the length of its cache to stamps.
  if (stamp.toSec() + limits.cache >= std::numeric_limits<std::uint32_t>::max()) {
    return TransformProblem{"its stamp " + std::to_string(stamp.sec) + " s is beyond the range of ROS time",
                            "check the clock"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<TransformProblem> findTransformProblem(const geometry_msgs::TransformStamped& transform,
                                                     bool fixed, ros::Time now,
                                                     const TransformLimits& limits) {
  std::optional<TransformProblem> problem = findFrameProblem(transform);
  if (!problem) problem = findPoseProblem(transform.transform);
  if (!problem && !fixed) problem = findStampProblem(transform.header.stamp, now, limits);
  return problem;
}

std::optional<TransformProblem> findOrderProblem(ros::Time stamp, ros::Time newest, const std::string& sender,
                                                 const TransformLimits& limits) {
  const double behind = secondsBetween(stamp, newest);
  if (!(behind > limits.cache)) return std::nullopt;
  return TransformProblem{
      "its stamp is " + numberText(behind) + " s older than the newest one, from " + sender,
      "stop one of the two publishers, or correct the clock of its machine"};
}

}  // namespace concave_distance

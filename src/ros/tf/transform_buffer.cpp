#include "transform_buffer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/number_text.h"
#include "kinematics/frame_name.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

// The largest robots have hundreds of frames; invented names must not fill the memory.
constexpr std::size_t kMostFrames = 10'000;
// Looking for frames to forget visits all of them.
constexpr double kBetweenClearances = 1.0;  // s
constexpr std::size_t kRefusalsBetweenClearances = 1000;
// A frame that came on one topic within this time is not accepted on the other one.
constexpr double kBetweenKinds = 1.0;  // s

// tf2 accepts norms that are off by half a percent, and then scales by them.
void normalize(geometry_msgs::Quaternion& q) {
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (std::abs(norm - 1.0) <= 4.0 * std::numeric_limits<double>::epsilon()) return;
  for (double* part : {&q.x, &q.y, &q.z, &q.w}) *part /= norm;
}

}  // namespace

TransformBuffer::TransformBuffer(const TransformLimits& limits, Clock clock)
    : limits_(limits),
      clock_(std::move(clock)),
      buffer_(std::make_shared<tf2::BufferCore>(ros::Duration(limits.cache))) {}

std::optional<TransformProblem> TransformBuffer::insert(geometry_msgs::TransformStamped transform,
                                                        const std::string& sender, bool fixed) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::Time now = clock_();
  noteClock(now);
  transform.header.frame_id = withoutLeadingSlash(transform.header.frame_id);
  transform.child_frame_id = withoutLeadingSlash(transform.child_frame_id);
  std::optional<TransformProblem> problem = findTransformProblem(transform, fixed, now, limits_);
  if (!problem) problem = admitFrame(transform, fixed, now);
  if (problem) return problem;
  normalize(transform.transform.rotation);
  if (fixed) transform.header.stamp = ros::Time();
  Frame& frame = frames_[transform.child_frame_id];
  if (!fixed && !noteStamp(frame, transform.header.stamp)) {
    return std::nullopt;  // tf2 keeps the first and logs each of the others
  }
  if (!outdated_) buffer_->setTransform(transform, sender, fixed);
  names_.insert(transform.child_frame_id);
  names_.insert(transform.header.frame_id);
  if (fixed || frame.latest.header.stamp <= transform.header.stamp) {
    frame.latest = std::move(transform);
    frame.sender = sender;
    frame.taken = now;
  }
  return std::nullopt;
}

// False when the frame has a transform of that stamp already, not only as its newest one.
bool TransformBuffer::noteStamp(Frame& frame, ros::Time stamp) const {
  const auto place = std::lower_bound(frame.stamps.begin(), frame.stamps.end(), stamp);
  if (place != frame.stamps.end() && *place == stamp) return false;
  frame.stamps.insert(place, stamp);
  while (secondsBetween(frame.stamps.front(), frame.stamps.back()) > limits_.cache) frame.stamps.pop_front();
  return true;
}

// Checks the transform against the known ones.
std::optional<TransformProblem> TransformBuffer::admitFrame(const geometry_msgs::TransformStamped& transform,
                                                            bool fixed, ros::Time now) {
  const std::string& child = transform.child_frame_id;
  const std::string& parent = transform.header.frame_id;
  const auto known = frames_.find(child);
  const bool other_parent = known == frames_.end() || known->second.latest.header.frame_id != parent;
  if (other_parent && makesLoop(child, parent)) {
    return TransformProblem{"its parent '" + parent + "' is below the frame itself: a loop",
                            "give each frame one parent that is not below it"};
  }
  if (other_parent && !hasSpace(now)) {
    return TransformProblem{"there are " + std::to_string(kMostFrames) + " frames already",
                            "find the publisher that keeps inventing frame names"};
  }
  const auto frame = frames_.find(child);
  if (frame == frames_.end()) {
    frames_[child].fixed = fixed;
    return std::nullopt;
  }
  if (!fixed && !frame->second.fixed) {
    auto problem = findOrderProblem(transform.header.stamp, frame->second.latest.header.stamp,
                                    frame->second.sender, limits_);
    if (problem) return problem;
  }
  return changeKind(frame->second, fixed, now);
}

// tf2 never changes the kind of a frame: one that was static once would never be stale again.
std::optional<TransformProblem> TransformBuffer::changeKind(Frame& frame, bool fixed, ros::Time now) {
  if (frame.fixed == fixed) return std::nullopt;
  const double since = secondsBetween(frame.taken, now);
  if (since >= 0.0 && since < kBetweenKinds) {
    return TransformProblem{
        "the frame is published on both /tf and /tf_static; the other sender is " + frame.sender,
        "stop one of the two publishers"};
  }
  frame.fixed = fixed;
  frame.latest = geometry_msgs::TransformStamped();  // its earlier transforms are ignored
  frame.stamps.clear();
  outdated_ = true;
  return std::nullopt;
}

bool TransformBuffer::makesLoop(const std::string& child, const std::string& parent) const {
  const std::string* frame = &parent;
  for (std::size_t height = 0; height <= frames_.size(); ++height) {
    if (*frame == child) return true;
    const auto above = frames_.find(*frame);
    if (above == frames_.end()) return false;
    frame = &above->second.latest.header.frame_id;
  }
  return true;
}

// Makes space for two more names by forgetting frames that were not published for long.
bool TransformBuffer::hasSpace(ros::Time now) {
  const bool full = names_.size() + 2 > kMostFrames;
  const bool tried = std::abs(secondsBetween(last_clearance_, now)) < kBetweenClearances;
  if (full && (!tried || ++refused_for_space_ >= kRefusalsBetweenClearances)) {
    last_clearance_ = now;
    refused_for_space_ = 0;
    for (auto frame = frames_.begin(); frame != frames_.end();) {
      const bool gone =
          !frame->second.fixed && secondsBetween(frame->second.latest.header.stamp, now) > limits_.cache;
      frame = gone ? frames_.erase(frame) : std::next(frame);
    }
    if (2 * frames_.size() < kMostFrames / 2) rebuild();
  }
  return names_.size() + 2 <= kMostFrames;
}

void TransformBuffer::rebuild() const {
  outdated_ = false;
  buffer_ = std::make_shared<tf2::BufferCore>(ros::Duration(limits_.cache));
  names_.clear();
  for (const auto& [child, frame] : frames_) {
    names_.insert(child);
    if (frame.latest.child_frame_id.empty()) continue;
    names_.insert(frame.latest.header.frame_id);
    buffer_->setTransform(frame.latest, frame.sender, frame.fixed);
  }
}

void TransformBuffer::noteClock(ros::Time now) {
  const bool jumped_back = now < last_now_;
  last_now_ = now;
  if (!jumped_back) return;
  for (auto frame = frames_.begin(); frame != frames_.end();) {
    frame = frame->second.fixed ? std::next(frame) : frames_.erase(frame);
  }
  rebuild();
}

void TransformBuffer::checkClock() {
  const std::lock_guard<std::mutex> lock(mutex_);
  noteClock(clock_());
}

std::shared_ptr<const tf2::BufferCore> TransformBuffer::current() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (outdated_) rebuild();
  return buffer_;
}

std::size_t TransformBuffer::frameCount() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return frames_.size();
}

}  // namespace concave_distance

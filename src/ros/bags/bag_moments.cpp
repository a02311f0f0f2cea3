#include "bag_moments.h"

#include <algorithm>
#include <utility>

#include "base/log_throttle.h"
#include "kinematics/frame_name.h"
#include "ros/tf/transform_checks.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

constexpr double kAnyTime = 1e9;  // s ahead of its clock that the buffer takes: they were checked before

bool isEqual(const geometry_msgs::TransformStamped& l, const geometry_msgs::TransformStamped& r) {
  const auto& a = l.transform;
  const auto& b = r.transform;
  return l.header.frame_id == r.header.frame_id && a.translation.x == b.translation.x &&
         a.translation.y == b.translation.y && a.translation.z == b.translation.z &&
         a.rotation.x == b.rotation.x && a.rotation.y == b.rotation.y && a.rotation.z == b.rotation.z &&
         a.rotation.w == b.rotation.w;
}

}  // namespace

BagMoments::BagMoments(const TransformLimits& limits, double stale_after)
    : limits_(limits),
      stale_after_(stale_after),
      lag_(std::min(stale_after, 0.5 * limits.cache)),
      buffer_({limits.cache, kAnyTime}, [this] { return buffer_now_; }) {}

void BagMoments::take(const BagMessage& message) {
  now_ = message.time;
  if (buffer_now_.isZero()) buffer_now_ = now_;
  if (!message.problem.empty()) {
    ++refusals_.count;
    if (refusals_.reasons.size() < BagRefusals::kMostReasons) {
      refusals_.reasons.emplace("message of " + message.sender,
                                "a message from " + message.sender + " is none of tf: " + message.problem);
    }
  }
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    takeTransform(transform, message);
  }
}

void BagMoments::takeTransform(const geometry_msgs::TransformStamped& transform, const BagMessage& message) {
  if (message.fixed) {
    takeFixed(transform, message);
    return;
  }
  geometry_msgs::TransformStamped named = transform;
  named.header.frame_id = withoutLeadingSlash(transform.header.frame_id);
  named.child_frame_id = withoutLeadingSlash(transform.child_frame_id);
  const ros::Time stamp = named.header.stamp;
  const std::string frame = named.child_frame_id;
  auto problem = findTransformProblem(named, false, now_, limits_);
  const auto track = tracks_.find(frame);
  if (!problem && track != tracks_.end()) {
    problem = findOrderProblem(stamp, track->second.newest_of_bag, track->second.sender, limits_);
  }
  if (problem) {
    note(transform, message.sender, *problem);
    return;
  }
  const auto answered = answered_.find(stamp);
  // tf keeps the first of a stamp.
  if (answered != answered_.end() && answered->second.count(frame) != 0) return;
  newest_ = std::max(newest_, stamp);
  if (!waitingAt(stamp, message.time).frames.insert(frame).second) return;
  Track& found = tracks_[frame];
  found.waiting.emplace(stamp, Held{std::move(named), message.sender});
  if (stamp < found.newest_of_bag) return;
  found.newest_of_bag = stamp;
  found.sender = message.sender;
}

void BagMoments::takeFixed(const geometry_msgs::TransformStamped& transform, const BagMessage& message) {
  const std::string frame = withoutLeadingSlash(transform.child_frame_id);
  const auto known = fixed_.find(frame);
  if (known != fixed_.end()) {
    // Stamps before a change have yet to be answered.
    if (!isEqual(known->second, transform)) {
      waitingAt(message.time, message.time).changes.push_back({transform, message.sender});
    }
    return;
  }
  if (!insert({transform, message.sender}, true)) return;
  fixed_.emplace(frame, transform);
  waitingAt(message.time, message.time);
}

// False when it is refused.
bool BagMoments::insert(const Held& held, bool fixed) {
  const auto problem = buffer_.insert(held.transform, held.sender, fixed);
  if (problem) note(held.transform, held.sender, *problem);
  return !problem;
}

BagMoments::Waiting& BagMoments::waitingAt(ros::Time stamp, ros::Time recorded) {
  const auto [place, is_new] = waiting_.try_emplace(stamp);
  if (is_new) place->second.recorded = recorded;
  return place->second;
}

void BagMoments::note(const geometry_msgs::TransformStamped& transform, const std::string& sender,
                      const TransformProblem& problem) {
  ++refusals_.count;
  const std::string name = "the transform of frame '" + printable(transform.child_frame_id) + "' in '" +
                           printable(transform.header.frame_id) + "' from " + sender;
  if (refusals_.reasons.size() >= BagRefusals::kMostReasons || refusals_.reasons.count(name) != 0) return;
  refusals_.reasons[name] = name + " is refused: " + problem.what + " (" + problem.remedy + ")";
}

std::optional<BagMoment> BagMoments::next(bool is_end) {
  forgetOldAnswers();
  if (waiting_.empty()) return std::nullopt;
  const ros::Time stamp = waiting_.begin()->first;
  const bool is_past = secondsBetween(stamp, now_) >= lag_ && secondsBetween(stamp, newest_) >= lag_;
  if (!is_end && !is_past) return std::nullopt;
  Waiting waiting = std::move(waiting_.begin()->second);
  waiting_.erase(waiting_.begin());
  buffer_now_ = std::max(buffer_now_, waiting.recorded);
  for (const Held& change : waiting.changes) {
    if (insert(change, true)) fixed_[withoutLeadingSlash(change.transform.child_frame_id)] = change.transform;
  }
  fillBuffer(stamp, waiting.frames);
  answered_[stamp].insert(waiting.frames.begin(), waiting.frames.end());
  return BagMoment{stamp, waiting.recorded, std::move(waiting.frames)};
}

void BagMoments::forgetOldAnswers() {
  while (!answered_.empty() && secondsBetween(answered_.begin()->first, newest_) > limits_.cache) {
    answered_.erase(answered_.begin());
  }
}

// A frame without a transform of this stamp gets its next one, unless the gap is one in which it is stale.
void BagMoments::fillBuffer(ros::Time stamp, Frames& frames) {
  for (auto& [frame, track] : tracks_) {
    auto& waiting = track.waiting;
    while (!waiting.empty() && waiting.begin()->first <= stamp) {
      const bool is_of_moment = waiting.begin()->first == stamp;
      if (!insertNext(track) && is_of_moment) frames.erase(frame);
    }
    if (waiting.empty() || track.newest.isZero() || track.newest >= stamp) continue;
    if (secondsBetween(track.newest, waiting.begin()->first) <= stale_after_) insertNext(track);
  }
}

// False when it is refused.
bool BagMoments::insertNext(Track& track) {
  const ros::Time stamp = track.waiting.begin()->first;
  const Held held = std::move(track.waiting.begin()->second);
  track.waiting.erase(track.waiting.begin());
  if (!insert(held, false)) return false;
  track.newest = std::max(track.newest, stamp);
  return true;
}

}  // namespace concave_distance

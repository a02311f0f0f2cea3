#include "bag_replay.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/log_throttle.h"
#include "base/number_text.h"
#include "kinematics/frame_name.h"
#include "ros/tf/transform_checks.h"
#include "ros/time_difference.h"
#include "scene/name_pattern.h"

namespace concave_distance {
namespace {

constexpr char kNotLookedUp = 2;
constexpr double kAnyTime = 1e9;  // s ahead of its clock that the buffer takes: they were checked before

CycleOptions withAllTimes(CycleOptions options) {
  options.most_times = std::numeric_limits<std::size_t>::max();
  return options;
}

// Answers would depend on the machine.
Scene withoutBudgets(Scene scene) {
  const auto change = [](PairSettings& settings) {
    settings.tracker.time_budget = std::numeric_limits<double>::infinity();
  };
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) change(scene.pairs.edit(i).settings);
  for (PairSettings& settings : scene.rules.settings) change(settings);
  change(scene.defaults.pairs);
  return scene;
}

bool isEqual(const geometry_msgs::TransformStamped& l, const geometry_msgs::TransformStamped& r) {
  const auto& a = l.transform;
  const auto& b = r.transform;
  return l.header.frame_id == r.header.frame_id && a.translation.x == b.translation.x &&
         a.translation.y == b.translation.y && a.translation.z == b.translation.z &&
         a.rotation.x == b.rotation.x && a.rotation.y == b.rotation.y && a.rotation.z == b.rotation.z &&
         a.rotation.w == b.rotation.w;
}

bool isMissing(const FramePlace& place) {
  return place.status == TransformStatus::Missing;
}

bool isFixed(const FramePlace& place) {
  return place.status == TransformStatus::Ok && place.stamp.isZero();
}

}  // namespace

BagReplay::BagReplay(Scene scene, ReplayOptions options, Sink sink)
    : options_(std::move(options)),
      lag_(std::min(options_.cycle.stale_after, 0.5 * options_.limits.cache)),
      sink_(std::move(sink)),
      buffer_({options_.limits.cache, kAnyTime}, [this] { return buffer_now_; }),
      cycle_(buffer_, withAllTimes(options_.cycle)),
      depends_(scene.bodies.size(), kNotLookedUp) {
  cycle_.setScene(withoutBudgets(std::move(scene)));
}

void BagReplay::take(const BagMessage& message) {
  ++counts_.messages;
  now_ = message.time;
  if (buffer_now_.isZero()) buffer_now_ = now_;
  if (!message.problem.empty()) {
    ++counts_.refused;
    if (counts_.reasons.size() < kMostReasons) {
      counts_.reasons.emplace("message of " + message.sender,
                              "a message from " + message.sender + " is none of tf: " + message.problem);
    }
  }
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    takeTransform(transform, message);
  }
  answerWhatIsReady(false);
}

void BagReplay::takeTransform(const geometry_msgs::TransformStamped& transform, const BagMessage& message) {
  if (message.fixed) {
    takeFixed(transform, message);
    return;
  }
  geometry_msgs::TransformStamped named = transform;
  named.header.frame_id = withoutLeadingSlash(transform.header.frame_id);
  named.child_frame_id = withoutLeadingSlash(transform.child_frame_id);
  const ros::Time stamp = named.header.stamp;
  const std::string frame = named.child_frame_id;
  auto problem = findTransformProblem(named, false, now_, options_.limits);
  const auto track = tracks_.find(frame);
  if (!problem && track != tracks_.end()) {
    problem = findOrderProblem(stamp, track->second.newest_of_bag, track->second.sender, options_.limits);
  }
  if (problem) {
    note(transform, message.sender, *problem);
    return;
  }
  const auto answered = answered_.find(stamp);
  // tf keeps the first of a stamp.
  if (answered != answered_.end() && answered->second.count(frame) != 0) return;
  newest_ = std::max(newest_, stamp);
  if (!momentAt(stamp, message.time).frames.insert(frame).second) return;
  Track& found = tracks_[frame];
  found.waiting.emplace(stamp, Held{std::move(named), message.sender});
  if (stamp < found.newest_of_bag) return;
  found.newest_of_bag = stamp;
  found.sender = message.sender;
}

void BagReplay::takeFixed(const geometry_msgs::TransformStamped& transform, const BagMessage& message) {
  const std::string frame = withoutLeadingSlash(transform.child_frame_id);
  const auto known = fixed_.find(frame);
  if (known != fixed_.end()) {
    // Stamps before a change have yet to be answered.
    if (!isEqual(known->second, transform)) {
      momentAt(message.time, message.time).changes.push_back({transform, message.sender});
    }
    return;
  }
  if (!insert(transform, message.sender, true)) return;
  fixed_.emplace(frame, transform);
  momentAt(message.time, message.time);
  ++counts_.transforms;
}

// False when it is refused.
bool BagReplay::insert(const geometry_msgs::TransformStamped& transform, const std::string& sender,
                       bool fixed) {
  const auto problem = buffer_.insert(transform, sender, fixed);
  if (problem) note(transform, sender, *problem);
  return !problem;
}

BagReplay::Moment& BagReplay::momentAt(ros::Time stamp, ros::Time recorded) {
  const auto [place, is_new] = waiting_.try_emplace(stamp);
  if (is_new) place->second.recorded = recorded;
  return place->second;
}

void BagReplay::note(const geometry_msgs::TransformStamped& transform, const std::string& sender,
                     const TransformProblem& problem) {
  ++counts_.refused;
  const std::string name = "the transform of frame '" + printable(transform.child_frame_id) + "' in '" +
                           printable(transform.header.frame_id) + "' from " + sender;
  if (counts_.reasons.size() >= kMostReasons || counts_.reasons.count(name) != 0) return;
  counts_.reasons[name] = name + " is refused: " + problem.what + " (" + problem.remedy + ")";
}

void BagReplay::finish() {
  answerWhatIsReady(true);
}

void BagReplay::answerWhatIsReady(bool is_end) {
  while (!waiting_.empty() && !isStopped()) {
    const ros::Time stamp = waiting_.begin()->first;
    const bool is_past = secondsBetween(stamp, now_) >= lag_ && secondsBetween(stamp, newest_) >= lag_;
    if (!is_end && !is_past) break;
    Moment moment = std::move(waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
    answer(stamp, moment);
    answered_[stamp].merge(moment.frames);
  }
  while (!answered_.empty() && secondsBetween(answered_.begin()->first, newest_) > options_.limits.cache) {
    answered_.erase(answered_.begin());
  }
}

void BagReplay::answer(ros::Time stamp, Moment& moment) {
  buffer_now_ = std::max(buffer_now_, moment.recorded);
  for (const Held& change : moment.changes) {
    if (!insert(change.transform, change.sender, true)) continue;
    fixed_[withoutLeadingSlash(change.transform.child_frame_id)] = change.transform;
    ++counts_.transforms;
  }
  fillBuffer(stamp, moment);
  ++counts_.stamps;
  std::fill(depends_.begin(), depends_.end(), kNotLookedUp);
  cycle_.run([&](std::size_t, const TrackedPair& pair) { return demandOf(pair, moment); }, stamp);
  if (isStopped()) return;
  was_beyond_ = was_beyond_ || (options_.patterns.empty() && cycle_.others().beyond > 0);
  for (const auto& pair : cycle_.pairs()) {
    if (pair->demand().due) report(*pair, moment);
  }
}

// A frame without a transform of this stamp gets its next one, unless the gap is one in which it is stale.
void BagReplay::fillBuffer(ros::Time stamp, Moment& moment) {
  for (auto& [frame, track] : tracks_) {
    auto& waiting = track.waiting;
    while (!waiting.empty() && waiting.begin()->first <= stamp) {
      const bool is_of_moment = waiting.begin()->first == stamp;
      if (!insertNext(track) && is_of_moment) moment.frames.erase(frame);
    }
    if (waiting.empty() || track.newest.isZero() || track.newest >= stamp) continue;
    if (secondsBetween(track.newest, waiting.begin()->first) <= options_.cycle.stale_after) insertNext(track);
  }
}

// False when it is refused.
bool BagReplay::insertNext(Track& track) {
  const ros::Time stamp = track.waiting.begin()->first;
  const Held held = std::move(track.waiting.begin()->second);
  track.waiting.erase(track.waiting.begin());
  if (!insert(held.transform, held.sender, false)) return false;
  track.newest = std::max(track.newest, stamp);
  ++counts_.transforms;
  return true;
}

PairDemand BagReplay::demandOf(const TrackedPair& pair, const Moment& moment) {
  if (!rowOf(pair.origin->name).is_wanted) return {};
  const auto moves = [&](std::size_t body) {
    if (depends_[body] == kNotLookedUp) {
      depends_[body] = static_cast<char>(cycle_.frames().dependsOn(body, moment.frames));
    }
    return depends_[body] != 0;
  };
  const std::size_t a = pair.origin->body_a;
  const std::size_t b = pair.origin->body_b;
  const FramePlace& place_a = cycle_.frames().place(a);
  const FramePlace& place_b = cycle_.frames().place(b);
  PairDemand demand{true, false, options_.niches, false};
  demand.due = isMissing(place_a) || isMissing(place_b) || (isFixed(place_a) && isFixed(place_b)) ||
               moves(a) || moves(b);
  return demand;
}

BagReplay::Row& BagReplay::rowOf(const std::string& pair) {
  const auto [place, is_new] = rows_.try_emplace(pair);
  if (is_new) {
    place->second.is_wanted =
        options_.patterns.empty() ||
        std::any_of(options_.patterns.begin(), options_.patterns.end(), [&](const std::string& pattern) {
          return pattern == pair || detail::matchesPattern(pattern, pair);
        });
  }
  return place->second;
}

// A pair without a distance, or that stands still, has a row when that begins and no more.
void BagReplay::report(const PublishedPair& pair, const Moment& moment) {
  const PairNiches message = toNiches(pair);
  const std::uint8_t code = message.nearest.status.code;
  if (code == PairStatus::DISABLED) return;
  const PairInput& input = pair.tracked->input;
  Row& last = rowOf(pair.heading.pair);
  bool is_new = !last.has_row || code != last.code;
  if (!is_new && message.nearest.has_distance != 0) {
    is_new = input.fixed ? input.a_from_b.matrix() != last.a_from_b.matrix()
                         : message.nearest.header.stamp != last.stamp;
  }
  if (!is_new) return;
  const bool has_answer = message.nearest.has_distance != 0 || code == PairStatus::BEYOND_CUTOFF;
  last.has_row = true;
  last.has_answer = last.has_answer || has_answer;
  last.code = code;
  last.stamp = message.nearest.header.stamp;
  last.a_from_b = input.a_from_b;
  last.problem = message.nearest.status.message;
  ++counts_.rows;
  counts_.answers += message.nearest.has_distance;
  sink_({moment.recorded, message});
}

bool BagReplay::hasAnswer() const {
  return was_beyond_ ||
         std::any_of(rows_.begin(), rows_.end(), [](const auto& row) { return row.second.has_answer; });
}

std::map<std::string, std::string> BagReplay::unanswered() const {
  std::map<std::string, std::string> found;
  for (const auto& [name, row] : rows_) {
    if (row.has_row && !row.has_answer) found.emplace(name, row.problem);
  }
  return found;
}

}  // namespace concave_distance

#include "frame_poses.h"

#include <algorithm>
#include <utility>

#include "ros/time_difference.h"

namespace concave_distance {
namespace {

constexpr std::size_t kMostFramesUp = 1000;  // of frames; a longer one is a loop

/// Two nodes of about one age count from one instant, so that seconds between poses are the same to the last
/// bit. Zero would mean that there is none yet.
ros::Time epochFor(ros::Time now) {
  constexpr std::uint32_t kSeconds = 65536;
  const std::uint32_t begin = now.sec - now.sec % kSeconds;
  return {begin, begin == 0 ? 1U : 0U};
}

ros::Time earlierOf(ros::Time l, ros::Time r) {
  if (l.isZero()) return r;
  return r.isZero() ? l : std::min(l, r);
}

}  // namespace

void FramePoses::setFrames(const std::string& reference, const std::vector<std::string>& frames,
                           ros::Time epoch) {
  reference_ = reference;
  epoch_ = epoch;
  frames_.clear();
  place_of_body_.clear();
  std::unordered_map<std::string, std::size_t> place;
  for (const std::string& frame : frames) {
    const auto [at, is_new] = place.emplace(frame, frames_.size());
    if (is_new) frames_.push_back(frame);
    place_of_body_.push_back(at->second);
  }
  frame_from_body_.assign(frames.size(), Eigen::Isometry3d::Identity());
  places_.assign(frames_.size(), FramePlace());
  is_whole_ = false;
}

bool FramePoses::hasFrames(const std::string& reference, const std::vector<std::string>& frames) const {
  return reference == reference_ && frames.size() == place_of_body_.size() &&
         std::equal(frames.begin(), frames.end(), place_of_body_.begin(),
                    [&](const std::string& frame, std::size_t place) { return frame == frames_[place]; });
}

void FramePoses::update(const tf2::BufferCore& buffer, ros::Time now, double stale_after) {
  hidden_.clear();
  if (epoch_.isZero()) epoch_ = epochFor(now);
  if (!is_whole_) buildTree(buffer);
  lookUpEdges(buffer, now);
  findPlaces(buffer, now, stale_after);
  chooseTimes();
  lookUpTimes(buffer);
  fillPoses(now);
}

void FramePoses::hide(std::size_t body, FramePlace why) {
  poses_.newest[body] = BodyPoses::kUnknown;
  hidden_.emplace_back(body, std::move(why));
}

void FramePoses::buildTree(const tf2::BufferCore& buffer) {
  nodes_.clear();
  node_of_.clear();
  node_of_frame_.clear();
  reference_node_ = nodeOf(buffer, reference_, 0);
  for (const std::string& frame : frames_) node_of_frame_.push_back(nodeOf(buffer, frame, 0));
}

// Appends the frame and those above it that are not there yet.
std::size_t FramePoses::nodeOf(const tf2::BufferCore& buffer, const std::string& frame, std::size_t length) {
  if (const auto found = node_of_.find(frame); found != node_of_.end()) return found->second;
  Node node;
  node.name = frame;
  node.parent_from_node.reserve(kMostTimes);
  node.is_known.reserve(kMostTimes);
  std::string parent;
  // Between two changes the tree may have a loop for a moment.
  if (length < kMostFramesUp && buffer._getParent(frame, ros::Time(0), parent)) {
    node.parent = nodeOf(buffer, parent, length + 1);
    node.depth = nodes_[node.parent].depth + 1;
  }
  nodes_.push_back(std::move(node));
  return node_of_[frame] = nodes_.size() - 1;
}

void FramePoses::lookUpEdges(const tf2::BufferCore& buffer, ros::Time now) {
  for (Node& node : nodes_) {
    if (node.parent == kNone) continue;
    const std::string& parent = nodes_[node.parent].name;
    node.edge = lookUpFrame(buffer, parent, node.name, ros::Time(0));
    if (node.edge.status != TransformStatus::Ok || node.edge.stamp <= now) continue;
    FrameTransform present = lookUpFrame(buffer, parent, node.name, now);
    if (present.status == TransformStatus::Ok) node.edge = std::move(present);
  }
}

void FramePoses::findPlaces(const tf2::BufferCore& buffer, ros::Time now, double stale_after) {
  is_whole_ = true;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    FramePlace& place = places_[i];
    place.status = TransformStatus::Ok;
    place.message.clear();
    place.stamp = ros::Time();
    const std::size_t ancestor = ancestorOf(node_of_frame_[i], reference_node_);
    bool is_known = ancestor != kNone;
    for (const std::size_t end : {node_of_frame_[i], reference_node_}) {
      for (std::size_t node = end; is_known && node != ancestor; node = nodes_[node].parent) {
        is_known = nodes_[node].edge.status == TransformStatus::Ok;
        place.stamp = earlierOf(place.stamp, nodes_[node].edge.stamp);
      }
    }
    if (!is_known) {
      is_whole_ = false;
      place.status = TransformStatus::Missing;
      place.message = lookUpFrame(buffer, reference_, frames_[i], ros::Time(0)).message;
      if (place.message.empty())
        place.message = "no transform from '" + frames_[i] + "' to '" + reference_ + "'";
    } else if (!place.stamp.isZero() && secondsBetween(place.stamp, now) > stale_after) {
      place.status = TransformStatus::Stale;
    }
  }
}

// Groups of newest times, each no longer than it must be for so few groups; the earliest of each is chosen.
void FramePoses::chooseTimes() {
  all_stamps_.clear();
  for (const FramePlace& place : places_) {
    if (place.status == TransformStatus::Ok && !place.stamp.isZero()) all_stamps_.push_back(place.stamp);
  }
  std::sort(all_stamps_.begin(), all_stamps_.end());
  all_stamps_.erase(std::unique(all_stamps_.begin(), all_stamps_.end()), all_stamps_.end());
  const auto choose = [&](double length) {
    stamps_.clear();
    for (const ros::Time stamp : all_stamps_) {
      if (stamps_.empty() || secondsBetween(stamps_.back(), stamp) > length) stamps_.push_back(stamp);
      if (stamps_.size() > most_times_) return false;
    }
    return true;
  };
  if (choose(0.0)) return;
  double too_short = 0.0;
  double enough = secondsBetween(all_stamps_.front(), all_stamps_.back());
  for (int halving = 0; halving < 30; ++halving) {
    const double middle = 0.5 * (too_short + enough);
    (choose(middle) ? enough : too_short) = middle;
  }
  choose(enough);
}

// Where a group's later member is asked at the group's beginning, tf interpolates.
void FramePoses::lookUpTimes(const tf2::BufferCore& buffer) {
  for (Node& node : nodes_) {
    node.parent_from_node.resize(std::max<std::size_t>(1, stamps_.size()));
    node.is_known.assign(node.parent_from_node.size(), 0);
    if (node.parent == kNone || node.edge.status != TransformStatus::Ok) continue;
    for (std::size_t time = 0; time < stamps_.size(); ++time) {
      const bool is_newest = node.edge.stamp.isZero() || node.edge.stamp == stamps_[time];
      node.is_known[time] = static_cast<char>(is_newest || stamps_[time] < node.edge.stamp);
      if (is_newest) {
        node.parent_from_node[time] = node.edge.target_from_source;
      } else if (node.is_known[time]) {
        const FrameTransform seen = lookUpFrame(buffer, nodes_[node.parent].name, node.name, stamps_[time]);
        node.is_known[time] = static_cast<char>(seen.status == TransformStatus::Ok);
        node.parent_from_node[time] = seen.target_from_source;
      }
    }
    if (stamps_.empty()) {
      node.is_known[0] = static_cast<char>(node.edge.stamp.isZero());
      node.parent_from_node[0] = node.edge.target_from_source;
    }
  }
}

void FramePoses::fillPoses(ros::Time now) {
  poses_.times.clear();
  for (const ros::Time stamp : stamps_) poses_.times.push_back(secondsBetween(epoch_, stamp));
  poses_.now = secondsBetween(epoch_, now);
  poses_.reset(place_of_body_.size());
  for (FramePlace& place : places_) {
    const bool moves = place.status == TransformStatus::Ok && !place.stamp.isZero();
    if (moves) place.stamp = stamps_[timeOf(place.stamp)];
  }
  for (std::size_t body = 0; body < place_of_body_.size(); ++body) {
    const FramePlace& place = places_[place_of_body_[body]];
    if (place.status != TransformStatus::Ok) continue;
    const std::size_t node = node_of_frame_[place_of_body_[body]];
    const bool is_fixed = place.stamp.isZero();
    std::size_t time = is_fixed ? 0 : timeOf(place.stamp);
    poses_.newest[body] = is_fixed ? BodyPoses::kFixed : static_cast<std::int32_t>(time);
    for (;; --time) {
      if (!isKnownAt(node, time)) {
        poses_.oldest[body] = static_cast<std::int32_t>(time) + 1;
        break;
      }
      poses_.poses[body * poses_.stride() + time] =
          between(reference_node_, node, time) * frame_from_body_[body];
      if (time == 0) break;
    }
  }
  poses_.relative = [this](std::size_t a, std::size_t b, std::size_t time) {
    const Eigen::Isometry3d frame_a_from_frame_b =
        between(node_of_frame_[place_of_body_[a]], node_of_frame_[place_of_body_[b]], time);
    return frame_from_body_[a].inverse(Eigen::Isometry) * frame_a_from_frame_b * frame_from_body_[b];
  };
}

// Each edge on the way to the reference frame.
bool FramePoses::isKnownAt(std::size_t node, std::size_t time) const {
  const std::size_t ancestor = ancestorOf(node, reference_node_);
  for (const std::size_t end : {node, reference_node_}) {
    for (std::size_t at = end; at != ancestor; at = nodes_[at].parent) {
      if (nodes_[at].is_known[time] == 0) return false;
    }
  }
  return true;
}

bool FramePoses::dependsOn(std::size_t body, const std::unordered_set<std::string>& frames) const {
  const std::size_t node = node_of_frame_[place_of_body_[body]];
  const std::size_t ancestor = ancestorOf(node, reference_node_);
  if (ancestor == kNone) return false;
  for (const std::size_t end : {node, reference_node_}) {
    for (std::size_t at = end; at != ancestor; at = nodes_[at].parent) {
      if (frames.count(nodes_[at].name) != 0) return true;
    }
  }
  return false;
}

std::size_t FramePoses::ancestorOf(std::size_t a, std::size_t b) const {
  while (a != b) {
    std::size_t& deeper = nodes_[a].depth >= nodes_[b].depth ? a : b;
    deeper = nodes_[deeper].parent;
    if (deeper == kNone) return kNone;
  }
  return a;
}

Eigen::Isometry3d FramePoses::fromAncestor(std::size_t ancestor, std::size_t node, std::size_t time) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (; node != ancestor; node = nodes_[node].parent) pose = nodes_[node].parent_from_node[time] * pose;
  return pose;
}

// Through the nearest frame that both descend from: from a root far away digits would be lost.
Eigen::Isometry3d FramePoses::between(std::size_t target, std::size_t source, std::size_t time) const {
  const std::size_t ancestor = ancestorOf(target, source);
  return fromAncestor(ancestor, target, time).inverse(Eigen::Isometry) * fromAncestor(ancestor, source, time);
}

// The last of those chosen that is not after it.
std::size_t FramePoses::timeOf(ros::Time stamp) const {
  const auto after = std::upper_bound(stamps_.begin(), stamps_.end(), stamp);
  return static_cast<std::size_t>(after - stamps_.begin()) - 1;
}

ros::Time FramePoses::commonStamp(std::size_t body_a, std::size_t body_b) const {
  return earlierOf(place(body_a).stamp, place(body_b).stamp);
}

Eigen::Isometry3d FramePoses::referenceFrom(std::size_t body, std::size_t other) const {
  const ros::Time stamp = commonStamp(body, other);
  return poses_.pose(body, stamp.isZero() ? 0 : timeOf(stamp));
}

}  // namespace concave_distance

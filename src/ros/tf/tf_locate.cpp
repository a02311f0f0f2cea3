#include "tf_locate.h"

#include <algorithm>

#include "base/number_text.h"
#include "ros/seconds_text.h"

namespace concave_distance {
namespace {

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

void TfLocate::update(std::shared_ptr<const tf2::BufferCore> buffer, ros::Time now, double stale_after,
                      ros::Time at) {
  buffer_ = std::move(buffer);
  now_ = at.isZero() ? now : at;
  stale_after_ = stale_after;
  if (epoch_.isZero()) epoch_ = epochFor(now_);
  nodes_.clear();
  node_of_.clear();
  known_.clear();
  nodeOf(reference_);
  node_of_body_.clear();
  for (const std::string& frame : frames_) node_of_body_.push_back(nodeOf(frame));
  poses_.clear();
  for (std::size_t body = 0; body < frames_.size(); ++body) {
    const std::size_t node = node_of_body_[body];
    if (!nodes_[node].place) findPlace(node, at);
    poses_.emplace_back();
    const FrameTransform& place = *nodes_[node].place;
    if (place.status == TransformStatus::Ok)
      poses_.back() = place.target_from_source * frame_from_body_[body];
  }
}

// It gets a frame of its own.
void TfLocate::hide(std::size_t body, FrameTransform why) {
  poses_[body].reset();
  node_of_body_[body] = nodes_.size();
  nodes_.push_back({nullptr});
  nodes_.back().place = std::move(why);
}

// While messages come in, the parents that are read one after another may form a loop.
std::size_t TfLocate::nodeOf(const std::string& frame) {
  const auto [found, is_new] = node_of_.try_emplace(frame, nodes_.size());
  const std::size_t node = found->second;
  if (!is_new) return node;
  nodes_.push_back({&found->first});
  std::string parent;
  if (!buffer_->_getParent(frame, ros::Time(0), parent)) return node;
  nodes_[node].parent = nodeOf(parent);  // which may move nodes_, before that is looked at
  return node;
}

void TfLocate::findPlace(std::size_t node, ros::Time at) {
  FrameTransform found = between(0, node, at);
  if (found.status == TransformStatus::Ok && found.stamp > now_) {
    // Otherwise one transform ahead of the clock would stop its pairs until the clock reaches it.
    FrameTransform present = between(0, node, now_);
    if (present.status == TransformStatus::Ok) found = std::move(present);
  }
  const double age = found.stamp.isZero() ? 0.0 : secondsBetween(found.stamp, now_);
  if (found.status == TransformStatus::Ok && age > stale_after_) found.status = TransformStatus::Stale;
  nodes_[node].place = std::move(found);
}

std::size_t TfLocate::ancestorOf(std::size_t a, std::size_t b) {
  ++visits_;
  for (; a != kNone && nodes_[a].visit != visits_; a = nodes_[a].parent) nodes_[a].visit = visits_;
  for (std::size_t left = nodes_.size(); b != kNone && left > 0; b = nodes_[b].parent, --left) {
    if (nodes_[b].visit == visits_) return b;
  }
  return kNone;
}

const FrameTransform& TfLocate::lookUp(std::size_t target, std::size_t source, ros::Time stamp) {
  const auto [found, is_new] = known_.try_emplace({target, source, stamp});
  FrameTransform& transform = found->second;
  if (!is_new) return transform;
  transform = lookUpFrame(*buffer_, *nodes_[target].name, *nodes_[source].name, stamp);
  if (stamp.isZero()) known_.try_emplace({target, source, transform.stamp}, transform);
  return transform;
}

FrameTransform TfLocate::between(std::size_t target, std::size_t source, ros::Time stamp) {
  const std::size_t ancestor = ancestorOf(target, source);
  if (ancestor == kNone) return lookUpFrame(*buffer_, *nodes_[target].name, *nodes_[source].name, stamp);
  const FrameTransform& from_target = lookUp(ancestor, target, stamp);
  if (from_target.status != TransformStatus::Ok) return from_target;
  const FrameTransform& from_source = lookUp(ancestor, source, stamp);
  if (from_source.status != TransformStatus::Ok) return from_source;
  FrameTransform result;
  result.stamp = earlierOf(from_target.stamp, from_source.stamp);
  if (from_target.stamp != from_source.stamp && !from_target.stamp.isZero() && !from_source.stamp.isZero()) {
    return between(target, source, result.stamp);
  }
  result.status = TransformStatus::Ok;
  result.target_from_source =
      from_target.target_from_source.inverse(Eigen::Isometry) * from_source.target_from_source;
  return result;
}

FrameTransform TfLocate::find(const std::string& target, const std::string& source, ros::Time stamp) {
  const std::size_t target_node = nodeOf(target);
  return between(target_node, nodeOf(source), stamp);
}

ros::Time TfLocate::commonStamp(std::size_t body_a, std::size_t body_b) const {
  return earlierOf(place(body_a).stamp, place(body_b).stamp);
}

PairInput TfLocate::operator()(std::size_t body_a, std::size_t body_b) {
  PairInput input;
  input.located = poses_[body_a] && poses_[body_b];
  if (!input.located) return input;
  const ros::Time stamp = commonStamp(body_a, body_b);
  const FrameTransform found = between(node_of_body_[body_a], node_of_body_[body_b], stamp);
  input.located = found.status == TransformStatus::Ok;
  input.fixed = stamp.isZero();
  input.time = seconds(input.fixed ? now_ : stamp);
  input.a_from_b =
      frame_from_body_[body_a].inverse(Eigen::Isometry) * found.target_from_source * frame_from_body_[body_b];
  return input;
}

FrameTransform TfLocate::placeOfA(std::size_t body_a, std::size_t body_b, bool is_located) {
  const FrameTransform& place_a = place(body_a);
  const FrameTransform& place_b = place(body_b);
  const bool is_a = place_a.status == TransformStatus::Missing ||
                    (place_a.status == TransformStatus::Stale && place_b.status != TransformStatus::Missing);
  const ros::Time stamp = commonStamp(body_a, body_b);
  FrameTransform result = is_a ? place_a : place_b;
  result.stamp = stamp.isZero() || result.status == TransformStatus::Missing ? now_ : stamp;
  result.target_from_source.setIdentity();
  if (is_located) {
    result.target_from_source =
        stamp == place_a.stamp
            ? *poses_[body_a]
            : between(0, node_of_body_[body_a], stamp).target_from_source * frame_from_body_[body_a];
    return result;
  }
  TextStream message;
  message << result.message;
  if (result.status == TransformStatus::Ok) {
    result.status = TransformStatus::Missing;
    message << "the transforms of '" << frames_[body_a] << "' and '" << frames_[body_b]
            << "' have no time in common yet";
  } else if (result.message.empty()) {
    message << "the newest transform between '" << frames_[body_a] << "', '" << frames_[body_b] << "' and '"
            << reference_ << "' is " << secondsText(secondsBetween(result.stamp, now_))
            << " s old; ~stale_after is " << stale_after_ << " s";
  }
  result.message = message.str();
  return result;
}

detail::FramesNow framesNow(std::shared_ptr<const tf2::BufferCore> buffer,
                            const std::string& reference_frame) {
  const auto locate = std::make_shared<TfLocate>(reference_frame);
  locate->update(std::move(buffer), ros::Time());
  const auto relation = [locate](const std::string& target,
                                 const std::string& source) -> std::optional<detail::FrameRelation> {
    const FrameTransform found = locate->find(target, source, ros::Time(0));
    if (found.status != TransformStatus::Ok) return std::nullopt;
    return detail::FrameRelation{found.target_from_source, found.stamp.isZero()};
  };
  return {reference_frame, relation};
}

}  // namespace concave_distance

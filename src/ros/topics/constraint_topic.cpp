#include "constraint_topic.h"

#include <concave_distance/Constraints.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <utility>

#include "ros/messages/constraint_conversions.h"

namespace concave_distance {

ConstraintTopic::ConstraintTopic(ros::NodeHandle& node, std::string reference_frame,
                                 ConstraintOptions options)
    : topic_(WatchedTopic::advertise<Constraints>(node, "constraints", kQueueLength)),
      reference_frame_(std::move(reference_frame)),
      options_(options) {}

void ConstraintTopic::readDemand() {
  is_wanted_ = options_.always || topic_.isWatched();
  if (is_wanted_) return;
  rows_.reset();
  joints_.reset();
}

void ConstraintTopic::setScene(std::shared_ptr<const SceneKinematics> joints, const std::string& problem) {
  problem_ = problem;
  if (joints == joints_) return;
  joints_ = std::move(joints);
  if (!joints_) {
    rows_.reset();
    return;
  }
  states_.setScene(joints_, reference_frame_);
  if (rows_) {
    rows_->setScene(joints_);
  } else {
    rows_ = std::make_unique<ConstraintRows>(joints_, options_.settings);
  }
}

bool ConstraintTopic::concerns(const TrackedPair& pair) const {
  return is_wanted_ && rows_ &&
         (joints_->isMoved(pair.origin->body_a) || joints_->isMoved(pair.origin->body_b));
}

void ConstraintTopic::publish(const ConstraintInput& input, ros::Time now) {
  if (!is_wanted_) return;
  const auto message = boost::make_shared<Constraints>();
  message->header.stamp = now;
  message->header.frame_id = reference_frame_;
  message->transforms = now;
  message->constraint_distance = options_.settings.distance;
  if (!problem_.empty()) message->problems.push_back(problem_);
  if (rows_) {
    states_.update(input.locate);
    rows_->update(input.pairs, states_.state(), now.toSec());
    fillConstraints(*rows_, *message);
    if (input.others.cut > 0) {
      UnlistedPair& cut = message->unlisted.emplace_back();
      cut.reason = UnlistedPair::PAIRS_CUT;
      cut.lower_bound = cut.drift = kNotComputed;
    }
    if (input.others.beyond > 0 && input.others.lower_bound < options_.settings.distance) {
      UnlistedPair& beyond = message->unlisted.emplace_back();
      beyond.reason = UnlistedPair::BEYOND_CUTOFF;
      beyond.lower_bound = input.others.lower_bound;
      beyond.drift = kNotComputed;
    }
    message->transforms = oldestTransform(input, now);
    message->problems.insert(message->problems.end(), states_.problems().begin(), states_.problems().end());
  }
  if (topic_.isWatched()) topic_.publish(message);
}

ros::Time ConstraintTopic::oldestTransform(const ConstraintInput& input, ros::Time now) const {
  ros::Time oldest = now;
  for (const auto& pair : input.pairs) {
    const std::size_t a = pair->origin->body_a;
    const std::size_t b = pair->origin->body_b;
    if (!pair->demand.due || std::max(a, b) >= joints_->bodyCount() || !concerns(*pair)) continue;
    if (!pair->input.located) continue;  // said in `unlisted`
    oldest = std::min(oldest, input.locate.placeOfA(a, b, true).stamp);
  }
  return oldest;
}

void ConstraintTopic::reset() {
  if (rows_) rows_->reset();
}

}  // namespace concave_distance

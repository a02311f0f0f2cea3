#include "unlisted_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace concave_distance::detail {
namespace {

/// Two links that a joint moves alike do not come nearer by it; velocities differ by rounding alone.
constexpr double kSameField = 1e-12;

UnlistedPlaces::Ball ballOf(const SceneBody& body, double margin,
                            const std::optional<Eigen::Isometry3d>& world_from_body) {
  if (!world_from_body) return {};
  return {*world_from_body * body.bounds.centre, body.bounds.radius + margin};
}

double largestIn(const UnlistedPlaces::Ball& ball, const RelativeTwist& twist) {
  return twist.at(ball.centre).norm() + ball.radius * twist.angular.norm();
}

}  // namespace

double UnlistedSearch::Field::largestIn(const UnlistedPlaces::Ball& ball,
                                        const Eigen::Vector3d& reference) const {
  return (linear + angular.cross(ball.centre - reference)).norm() + ball.radius * angular.norm();
}

void UnlistedSearch::begin(const SceneKinematics& joints, const SceneState& state,
                           const CarrierMotion& carriers, double distance) {
  joints_ = &joints;
  state_ = &state;
  carriers_ = &carriers;
  distance_ = distance;
  found_.clear();
  has_moved_bodies_ = false;
  for (std::size_t i = 0; i < joints.bodyCount(); ++i) has_moved_bodies_ |= joints.isMoved(i);
  const auto columns = static_cast<Eigen::Index>(joints.velocityNames().size());
  if (reach_.cols() != columns) reach_.resize(reach_.rows(), columns);
}

void UnlistedSearch::addPairs(const SceneTracker::Pairs& pairs) {
  for (std::size_t i = 0; i < joints_->bodyCount() && has_moved_bodies_; ++i) {
    if (state_->world_from_body[i]) continue;
    add(nullptr, UnlistedReason::NoPose, kNotComputed);
    found_.back().body = i;
  }
  for (const auto& pair : pairs) addPair(pair);
}

void UnlistedSearch::addPair(const std::shared_ptr<const TrackedPair>& pair) {
  const std::size_t a = pair->origin->body_a;
  const std::size_t b = pair->origin->body_b;
  if (!pair->origin->enabled || !pair->demand.niches || std::max(a, b) >= joints_->bodyCount()) return;
  if (!joints_->isMoved(a) && !joints_->isMoved(b)) return;
  if (!state_->world_from_body[a] || !state_->world_from_body[b]) return;  // said of the body
  if (pair->state == PairState::BeyondCutoff) {
    if (*pair->box_bound < distance_) add(pair, UnlistedReason::BeyondCutoff, *pair->box_bound);
    return;
  }
  const PairSolution& solution = pair->solution;
  if (!pair->solved() || solution.status == SolveStatus::InvalidPose) {
    add(pair, UnlistedReason::Unsolved, kNotComputed);
    return;
  }
  const TrackerParameters& settings = pair->settings.tracker;
  if (settings.cutoff < distance_) add(pair, UnlistedReason::BeyondCutoff, settings.cutoff);
  if (!provesDistance(settings.accuracy) || solution.niches_complete) return;
  // A list that only the largest count has cut has every niche up to its last one.
  const bool is_cut_alone = solution.niches_cut && !pair->put_off &&
                            solution.status != SolveStatus::BudgetExhausted &&
                            solution.status != SolveStatus::MemoryExhausted;
  const double bound =
      is_cut_alone && !solution.niches.empty() ? solution.niches.back().distance : solution.lower_bound;
  if (!(bound >= distance_)) add(pair, UnlistedReason::Unfinished, bound);
}

void UnlistedSearch::addWithoutSlot(const std::shared_ptr<const TrackedPair>& pair, double distance) {
  const auto last = std::find_if(found_.begin(), found_.end(), [&](const UnlistedPlaces& places) {
    return places.pair == pair && places.reason == UnlistedReason::NoSlot;
  });
  if (last == found_.end()) {
    add(pair, UnlistedReason::NoSlot, distance);
  } else {
    last->lower_bound = std::min(last->lower_bound, distance);
  }
}

void UnlistedSearch::add(const std::shared_ptr<const TrackedPair>& pair, UnlistedReason reason,
                         double lower_bound) {
  UnlistedPlaces& places = found_.emplace_back();
  places.reason = reason;
  places.pair = pair;
  places.lower_bound = lower_bound;
  if (reach_.rows() < static_cast<Eigen::Index>(found_.size())) {
    reach_.conservativeResize(2 * static_cast<Eigen::Index>(found_.size()), reach_.cols());
  }
  reach_.row(static_cast<Eigen::Index>(found_.size()) - 1).setConstant(kNotComputed);
  if (pair != nullptr && !std::isnan(lower_bound)) measure(places);
}

// A joint that moves both bodies as one brings them no nearer; any other by no more than both of them move.
void UnlistedSearch::measure(UnlistedPlaces& places) {
  const std::size_t a = places.pair->origin->body_a;
  const std::size_t b = places.pair->origin->body_b;
  const TrackerParameters& settings = places.pair->settings.tracker;
  places.ball_a = ballOf(*places.pair->body_a, settings.margin_a, state_->world_from_body[a]);
  places.ball_b = ballOf(*places.pair->body_b, settings.margin_b, state_->world_from_body[b]);
  const Eigen::Vector3d& reference = places.ball_a.centre;
  readFields(a, reference, of_a_);
  readFields(b, reference, of_b_);
  auto row = reach_.row(static_cast<Eigen::Index>(found_.size()) - 1);
  for (std::size_t i = 0; i < of_a_.size(); ++i) {
    const double span =
        (places.ball_b.centre - reference).norm() + places.ball_a.radius + places.ball_b.radius;
    const double apart =
        (of_a_[i].linear - of_b_[i].linear).norm() + span * (of_a_[i].angular - of_b_[i].angular).norm();
    const double each =
        of_a_[i].largestIn(places.ball_a, reference) + of_b_[i].largestIn(places.ball_b, reference);
    row[static_cast<Eigen::Index>(i)] = apart <= kSameField * (1.0 + each) ? 0.0 : each;
  }
  const auto& with_a = carriers_->of(*joints_, a);
  const auto& with_b = carriers_->of(*joints_, b);
  if (with_a && with_b) places.drift = largestIn(places.ball_a, *with_a) + largestIn(places.ball_b, *with_b);
}

void UnlistedSearch::readFields(std::size_t body, const Eigen::Vector3d& reference,
                                std::vector<Field>& fields) {
  fields.assign(joints_->velocityNames().size(), {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  const auto& place = joints_->placeOf(body);
  if (!place) return;
  const RobotKinematics& robot = *joints_->robots()[place->robot];
  const RobotState& state = state_->robots[place->robot];
  const auto count = static_cast<Eigen::Index>(robot.velocityNames().size());
  const std::size_t first = joints_->firstVelocity(place->robot);
  if (columns_.cols() < count) columns_.resize(3, count);
  auto columns = columns_.leftCols(count);
  robot.jacobian(state, place->link, reference, columns);
  for (Eigen::Index i = 0; i < count; ++i)
    fields[first + static_cast<std::size_t>(i)].linear = columns.col(i);
  // The field is affine in the point: two more points give the angular velocity.
  for (int axis = 0; axis < 2; ++axis) {
    robot.jacobian(state, place->link, reference + Eigen::Vector3d::Unit(axis), columns);
    for (Eigen::Index i = 0; i < count; ++i) {
      Field& field = fields[first + static_cast<std::size_t>(i)];
      const Eigen::Vector3d turned = columns.col(i) - field.linear;
      if (axis == 0) field.angular.tail<2>() = Eigen::Vector2d(-turned.z(), turned.y());
      if (axis == 1) field.angular.x() = turned.z();
    }
  }
}

}  // namespace concave_distance::detail

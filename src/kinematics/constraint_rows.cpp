#include "concave_distance/kinematics/constraint_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "carrier_motion.h"
#include "concave_distance/base/error.h"
#include "concave_distance/tracking/niche_gradient.h"
#include "niche_places.h"
#include "slot_table.h"
#include "unlisted_search.h"

namespace concave_distance {
namespace {

using detail::NichePlace;
using detail::SlotRequest;

constexpr std::uint32_t kLargestCapacity = 100'000;
constexpr double kLargestTilt = 0.5;       // rad
constexpr double kLeavesAt = 1.05;         // of the distance: a niche at its edge does not come and go
constexpr std::size_t kUsualRequests = 8;  // for each slot

Vector6d twistAt(const RelativeTwist& twist, const Eigen::Vector3d& point) {
  Vector6d values;
  values << twist.at(point), twist.angular;
  return values;
}

/// Returns whether a value does not go on from that of the slot's last row: regions of overlap have merged or
/// split, or the value that there was is not known now.
bool hasJumped(const TrackedPair& pair, const TrackedNiche& niche, const NichePlace& place,
               const ConstraintRow& last) {
  if (pair.repeated) return false;
  const SignedPlace& signed_place = niche.signed_place;
  if (signed_place.state == SignedState::Known) return signed_place.since_cycle == pair.solution.cycle;
  return place.is_overlapping && last.state == SlotState::Used && last.value < 0.0;
}

}  // namespace

struct ConstraintRows::Parts {
  /// A place that wants a row, with the pair that it is of.
  struct Candidate {
    std::size_t pair = 0;  ///< of the tracker's
    const TrackedNiche* niche = nullptr;
    NichePlace place;  ///< in A's frame
  };

  Parts(std::shared_ptr<const SceneKinematics> given, const ConstraintSettings& wanted)
      : joints(std::move(given)), settings(wanted), table(wanted.capacity), rows(wanted.capacity) {
    requests.reserve(kUsualRequests * wanted.capacity);
    candidates.reserve(kUsualRequests * wanted.capacity);
    resize();
  }

  void resize() {
    jacobian.setZero(static_cast<Eigen::Index>(settings.capacity),
                     static_cast<Eigen::Index>(joints->velocityNames().size()));
  }
  void collect(const SceneTracker::Pairs& pairs, const SceneState& state);
  void write(const SlotRequest& request, const Candidate& candidate,
             const std::shared_ptr<const TrackedPair>& pair, const SceneState& state);
  void addMotion(std::size_t body, const SceneState& state, const Eigen::Vector3d& point,
                 const Eigen::Vector3d& normal, double factor, Eigen::Index row);

  std::shared_ptr<const SceneKinematics> joints;
  ConstraintSettings settings;
  detail::SlotTable table;
  detail::NichePlaces places{settings.tilt};
  detail::CarrierMotion carriers;
  std::vector<Candidate> candidates;
  std::vector<SlotRequest> requests;  ///< of the candidates
  std::vector<ConstraintRow> rows;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian;
  std::size_t overflow = 0;
  detail::UnlistedSearch unlisted;
};

ConstraintRows::ConstraintRows(std::shared_ptr<const SceneKinematics> joints, ConstraintSettings settings) {
  if (!(settings.distance > 0.0) || !std::isfinite(settings.distance)) {
    throw Error("constraint_distance", "it is " + numberText(settings.distance), "give metres, more than 0");
  }
  if (settings.capacity == 0 || settings.capacity > kLargestCapacity) {
    throw Error("constraint_capacity", "it is " + std::to_string(settings.capacity), "allowed: 1 to 100000");
  }
  if (!(settings.tilt > 0.0) || settings.tilt > kLargestTilt) {
    throw Error("constraint_tilt", "it is " + numberText(settings.tilt),
                "give radians, more than 0, at most 0.5");
  }
  parts_ = std::make_unique<Parts>(std::move(joints), settings);
}
ConstraintRows::~ConstraintRows() = default;
ConstraintRows::ConstraintRows(ConstraintRows&&) noexcept = default;
ConstraintRows& ConstraintRows::operator=(ConstraintRows&&) noexcept = default;

void ConstraintRows::setScene(std::shared_ptr<const SceneKinematics> joints) {
  parts_->carriers.setScene(*parts_->joints, *joints);
  parts_->joints = std::move(joints);
  parts_->resize();
}

void ConstraintRows::reset() {
  parts_->table.clear();
  parts_->carriers.reset();
}

const std::vector<ConstraintRow>& ConstraintRows::rows() const {
  return parts_->rows;
}
const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& ConstraintRows::jacobian()
    const {
  return parts_->jacobian;
}
std::size_t ConstraintRows::overflow() const {
  return parts_->overflow;
}
const std::vector<UnlistedPlaces>& ConstraintRows::unlisted() const {
  return parts_->unlisted.found();
}
const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& ConstraintRows::reach() const {
  return parts_->unlisted.reach();
}
const SceneKinematics& ConstraintRows::joints() const {
  return *parts_->joints;
}

void ConstraintRows::update(const SceneTracker::Pairs& pairs, const SceneState& state, double time) {
  Parts& parts = *parts_;
  if (state.world_from_body.size() != parts.joints->bodyCount() ||
      state.robots.size() != parts.joints->robots().size()) {
    throw Error("state",
                std::to_string(state.world_from_body.size()) + " bodies and " +
                    std::to_string(state.robots.size()) + " robots",
                "give the state of " + std::to_string(parts.joints->bodyCount()) + " bodies and " +
                    std::to_string(parts.joints->robots().size()) +
                    " robots, of the same revision of the scene as the rows");
  }
  parts.carriers.update(*parts.joints, state, time);
  parts.collect(pairs, state);
  parts.overflow = parts.table.assign(parts.requests);
  for (std::size_t i = 0; i < parts.requests.size(); ++i) {
    const std::size_t slot = parts.requests[i].slot;
    if (slot == SlotRequest::kNone) continue;
    const Parts::Candidate& candidate = parts.candidates[i];
    if (hasJumped(*pairs[candidate.pair], *candidate.niche, candidate.place, parts.rows[slot]))
      parts.table.renew(slot);
  }
  parts.jacobian.setZero();
  for (std::size_t slot = 0; slot < parts.rows.size(); ++slot) {
    parts.rows[slot] = ConstraintRow();
    parts.rows[slot].state = parts.table.slots()[slot].state;
  }
  for (std::size_t i = 0; i < parts.requests.size(); ++i) {
    if (parts.requests[i].slot == SlotRequest::kNone) continue;
    const Parts::Candidate& candidate = parts.candidates[i];
    parts.write(parts.requests[i], candidate, pairs[candidate.pair], state);
  }
  parts.unlisted.begin(*parts.joints, state, parts.carriers, parts.settings.distance);
  parts.unlisted.addPairs(pairs);
  for (std::size_t i = 0; i < parts.requests.size(); ++i) {
    const SlotRequest& request = parts.requests[i];
    if (request.slot != SlotRequest::kNone || !request.may_begin) continue;
    parts.unlisted.addWithoutSlot(pairs[parts.candidates[i].pair], request.distance);
  }
}

void ConstraintRows::Parts::collect(const SceneTracker::Pairs& pairs, const SceneState& state) {
  candidates.clear();
  requests.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const TrackedPair& pair = *pairs[i];
    if (!pair.solved() || !pair.demand.niches) continue;
    const std::size_t a = pair.origin->body_a;
    const std::size_t b = pair.origin->body_b;
    if (std::max(a, b) >= joints->bodyCount()) continue;  // a pair of another revision
    if (!state.world_from_body[a] || !state.world_from_body[b]) continue;
    if (!joints->isMoved(a) && !joints->isMoved(b)) continue;
    const Eigen::Isometry3d b_from_a = pair.solution.a_from_b.inverse();
    for (const TrackedNiche& niche : pair.solution.niches) {
      if (!(niche.distance <= kLeavesAt * settings.distance)) break;  // they ascend
      SlotRequest request;
      request.key = {pair.body_a->serial, pair.body_b->serial, niche.id};
      request.may_begin = niche.distance <= settings.distance || table.holds(request.key);
      if (!request.may_begin) continue;
      for (const NichePlace& place : places.of(pair, niche)) {
        request.on_a = place.point_a;
        request.on_b = b_from_a * place.point_b;
        request.distance = place.value;
        requests.push_back(request);
        candidates.push_back({i, &niche, place});
      }
    }
  }
}

void ConstraintRows::Parts::write(const SlotRequest& request, const Candidate& candidate,
                                  const std::shared_ptr<const TrackedPair>& pair, const SceneState& state) {
  const std::size_t a = pair->origin->body_a;
  const std::size_t b = pair->origin->body_b;
  const Eigen::Isometry3d& world_from_a = *state.world_from_body[a];
  const NichePlace& place = candidate.place;
  ConstraintRow& row = rows[request.slot];
  row.pair = pair;
  row.niche_id = candidate.niche->id;
  row.age = table.cycle() - table.slots()[request.slot].since;
  row.value = place.value;
  row.is_overlapping = place.is_overlapping;
  row.lower_bound = pair->solution.lower_bound;
  row.normal = world_from_a.linear() * place.normal;
  row.point_a = world_from_a * place.point_a;
  row.point_b = world_from_a * place.point_b;
  row.point_a_in_frame = joints->frameFromBody(a) * place.point_a;
  row.point_b_in_frame = joints->frameFromBody(b) * request.on_b;

  const auto index = static_cast<Eigen::Index>(request.slot);
  addMotion(a, state, row.point_a, row.normal, -1.0, index);
  addMotion(b, state, row.point_b, row.normal, 1.0, index);
  const std::optional<RelativeTwist>& with_a = carriers.of(*joints, a);
  const std::optional<RelativeTwist>& with_b = carriers.of(*joints, b);
  const DistanceGradient gradient = gradientOf(row.normal, row.point_a, row.point_b, row.point_a);
  if (with_a) row.drift_a = -gradient.by_a.dot(twistAt(*with_a, row.point_a));
  if (with_b) row.drift_b = -gradient.by_b.dot(twistAt(*with_b, row.point_a));
  row.drift = row.drift_a + row.drift_b;
}

void ConstraintRows::Parts::addMotion(std::size_t body, const SceneState& state, const Eigen::Vector3d& point,
                                      const Eigen::Vector3d& normal, double factor, Eigen::Index row) {
  const auto& place = joints->placeOf(body);
  if (!place) return;
  const RobotKinematics& robot = *joints->robots()[place->robot];
  const auto first = static_cast<Eigen::Index>(joints->firstVelocity(place->robot));
  const auto count = static_cast<Eigen::Index>(robot.velocityNames().size());
  robot.addToRow(state.robots[place->robot], place->link, point, normal, factor,
                 jacobian.row(row).segment(first, count));
}

}  // namespace concave_distance

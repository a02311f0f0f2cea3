#include "near_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/constants.h"
#include "body_box.h"
#include "concave_distance/scene/broad_phase.h"
#include "tracking/rigid_pose.h"

namespace concave_distance {
namespace {

constexpr double kPoseRoundings = 16.0 * std::numeric_limits<double>::epsilon();
constexpr double kRestSeconds = 2.0;        // that a pair which has left is kept
constexpr std::size_t kMostResting = 256;   // pairs: their trackers take memory
constexpr std::size_t kMostUnknown = 1000;  // pairs that have a tracker because a body has no pose

std::uint64_t keyOf(SlotPair slots) {
  return std::uint64_t{slots.a} << 32U | slots.b;
}

}  // namespace

void NearPairs::update(const Poses& poses, double now, std::uint64_t& largest_id) {
  if (!now_.has_rules && pairs_.empty()) {
    others_ = {};
    return;
  }
  if (!keeps_left_) dropLeft(now, largest_id);
  keeps_left_ = false;
  dropRested(now, largest_id);
  if (asks_all_) {
    place_of_slot_.assign(now_.slot_count, 0);
    for (std::size_t i = 0; i < now_.bodies.size(); ++i) place_of_slot_[now_.bodies[i].slot] = i;
    entry_of_.clear();
    for (std::size_t i = 0; i < entries_.size(); ++i) entry_of_[keyOf(entries_[i].slots)] = i;
    unknown_before_.clear();
  }
  placeBoxes(poses);
  sweep_.update();
  now_.free_slots.insert(now_.free_slots.end(), now_.freed_slots.begin(), now_.freed_slots.end());
  now_.freed_slots.clear();
  for (const SlotPair slots : sweep_.ended()) {
    const auto found = entry_of_.find(keyOf(slots));
    if (found != entry_of_.end()) entries_[found->second].is_by_box = false;
  }
  if (std::exchange(asks_all_, false)) {
    cut_.clear();
    sweep_.overlaps().visit([&](SlotPair slots) { admit(slots, largest_id, true); });
  } else {
    for (const SlotPair slots : sweep_.begun()) admit(slots, largest_id, true);
  }
  if (unknown_ != unknown_before_) admitUnknown(largest_id);
  cut_bound_ = kInfinity;
  if (!cut_.empty()) admitCut(poses, largest_id);
  fillOthers();
}

void NearPairs::placeBoxes(const Poses& poses) {
  unknown_.assign(now_.bodies.size(), false);
  for (std::size_t i = 0; i < now_.bodies.size(); ++i) {
    const Plan::Body& body = now_.bodies[i];
    if (body.half_reach < 0.0) {
      sweep_.remove(body.slot);
      continue;
    }
    const std::optional<Eigen::Isometry3d> pose = poses[i] ? rigidPose(*poses[i]) : std::nullopt;
    unknown_[i] = !pose;
    if (pose) {
      const Eigen::AlignedBox3d box = boxAt(body.body->bounds, *pose, body.body->margin + body.half_reach);
      sweep_.set(body.slot, box.min(), box.max());
    } else {
      sweep_.remove(body.slot);
    }
  }
}

// Pairs that nothing has kept near in the last cycle.
void NearPairs::dropLeft(double now, std::uint64_t& largest_id) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].is_by_box || entries_[i].is_by_unknown) {
      if (kept != i) {
        entries_[kept] = entries_[i];
        pairs_[kept] = std::move(pairs_[i]);
        entry_of_[keyOf(entries_[kept].slots)] = kept;
      }
      ++kept;
      continue;
    }
    entry_of_.erase(keyOf(entries_[i].slots));
    largest_id = std::max(largest_id, pairs_[i]->largest_id);
    if (pairs_[i]->tracker() != nullptr) resting_.push_back({entries_[i].slots, now, std::move(pairs_[i])});
  }
  if (kept == entries_.size()) return;
  entries_.resize(kept);
  pairs_.resize(kept);
  ++revision_;
}

void NearPairs::dropRested(double now, std::uint64_t& largest_id) {
  std::size_t gone = resting_.size() - std::min(resting_.size(), kMostResting);
  // A clock that jumps back ends all rest.
  while (gone < resting_.size() && !(std::abs(now - resting_[gone].since) <= kRestSeconds)) ++gone;
  for (std::size_t i = 0; i < gone; ++i) largest_id = std::max(largest_id, resting_[i].pair->largest_id);
  resting_.erase(resting_.begin(), resting_.begin() + static_cast<std::ptrdiff_t>(gone));
}

std::shared_ptr<TrackedPair> NearPairs::takeRested(SlotPair slots) {
  const auto found = std::find_if(resting_.begin(), resting_.end(), [&](const Resting& resting) {
    return resting.slots.a == slots.a && resting.slots.b == slots.b;
  });
  if (found == resting_.end()) return nullptr;
  std::shared_ptr<TrackedPair> pair = std::move(found->pair);
  resting_.erase(found);
  return pair;
}

void NearPairs::admit(SlotPair slots, std::uint64_t largest_id, bool is_by_box) {
  const auto found = entry_of_.find(keyOf(slots));
  if (found != entry_of_.end()) {
    Entry& entry = entries_[found->second];
    (is_by_box ? entry.is_by_box : entry.is_by_unknown) = true;
    return;
  }
  const Scene& scene = now_.scene;
  const std::size_t a = placeOf(slots.a);
  const std::size_t b = placeOf(slots.b);
  const PairRule* rule = ruleOf(scene, a, b);
  if (rule == nullptr || !rule->is_enabled) return;
  if (entries_.size() >= scene.limits.pairs) {
    if (is_by_box) cut_.push_back(slots);
    return;
  }
  std::shared_ptr<TrackedPair> pair = takeRested(slots);
  if (!pair) {
    auto origin = std::make_shared<const ScenePair>(*ruledPair(scene, a, b));
    const std::size_t body_a = origin->body_a;
    const std::size_t body_b = origin->body_b;
    pair = std::make_shared<TrackedPair>(std::move(origin), now_.bodies[body_a].body,
                                         now_.bodies[body_b].body, largest_id);
  }
  pairs_.push_back(std::move(pair));
  entries_.push_back({slots, is_by_box, !is_by_box});
  entry_of_[keyOf(slots)] = entries_.size() - 1;
  ++revision_;
}

// Those that are tracked first: their alerts must know.
void NearPairs::admitUnknown(std::uint64_t largest_id) {
  std::size_t admitted = 0;
  for (Entry& entry : entries_) {
    entry.is_by_unknown = unknown_[placeOf(entry.slots.a)] || unknown_[placeOf(entry.slots.b)];
    admitted += entry.is_by_unknown ? 1 : 0;
  }
  for (std::size_t i = 0; i < unknown_.size(); ++i) {
    for (std::size_t j = 0; unknown_[i] && j < unknown_.size() && admitted < kMostUnknown; ++j) {
      if (now_.bodies[j].half_reach < 0.0 || j == i) continue;
      const std::size_t before = entries_.size();
      admit(slotPair(now_.bodies[i].slot, now_.bodies[j].slot), largest_id, false);
      admitted += entries_.size() - before;
    }
  }
  const BodySet unknown = BodySet::marked(unknown_);
  const BodySet known = BodySet::before(unknown_.size()) - unknown;
  missing_ = 0;
  if (!unknown.empty()) {
    const BodySet all = unknown | known;
    missing_ = countPairsByRule(now_.scene, {{unknown, all}, {known, unknown}}) - admitted;
  }
  unknown_before_ = unknown_;
}

// The nearest first, where there is room again.
void NearPairs::admitCut(const Poses& poses, std::uint64_t largest_id) {
  std::vector<std::pair<double, SlotPair>> left;
  for (const SlotPair slots : cut_) {
    if (!sweep_.overlaps().contains(slots) || entry_of_.count(keyOf(slots)) != 0) continue;
    const std::size_t a = placeOf(slots.a);
    const std::size_t b = placeOf(slots.b);
    const PairRule* rule = ruleOf(now_.scene, a, b);
    if (rule == nullptr || !rule->is_enabled) continue;
    const SceneBody& body_a = *now_.bodies[a].body;
    const SceneBody& body_b = *now_.bodies[b].body;
    // Far from the world's origin, `a_from_b` has lost what the margin takes off again.
    const double rounding =
        kPoseRoundings * (poses[a]->translation().lpNorm<1>() + poses[b]->translation().lpNorm<1>());
    const Eigen::Isometry3d a_from_b = poses[a]->inverse(Eigen::Isometry) * *poses[b];
    left.emplace_back(
        distanceLowerBound(body_a.bounds, body_b.bounds, a_from_b, body_a.margin + body_b.margin + rounding),
        slots);
  }
  std::sort(left.begin(), left.end(), [](const auto& l, const auto& r) {
    return l.first != r.first ? l.first < r.first : keyOf(l.second) < keyOf(r.second);
  });
  cut_.clear();
  for (const auto& [bound, slots] : left) {
    admit(slots, largest_id, true);
    if (entry_of_.count(keyOf(slots)) == 0) cut_bound_ = std::min(cut_bound_, bound);
  }
}

// Boxes that do not overlap are farther apart than what both are widened by.
void NearPairs::fillOthers() {
  others_ = {};
  others_.missing = missing_;
  others_.cut = cut_.size();
  const std::uint64_t counted = entries_.size() + missing_ + cut_.size();
  others_.beyond = now_.ruled > counted ? now_.ruled - counted : 0;
  double least = kInfinity;
  double second = kInfinity;
  for (std::size_t i = 0; others_.beyond > 0 && i < now_.bodies.size(); ++i) {
    const double half_reach = now_.bodies[i].half_reach;
    if (half_reach < 0.0 || unknown_[i]) continue;
    second = std::min(second, std::max(least, half_reach));
    least = std::min(least, half_reach);
  }
  others_.lower_bound = std::min(cut_bound_, others_.beyond > 0 ? least + second : kInfinity);
}

}  // namespace concave_distance

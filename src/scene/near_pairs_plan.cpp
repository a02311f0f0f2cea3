#include <algorithm>
#include <utility>

#include "near_pairs.h"

// What an edit of the scene changes in the near pairs.
namespace concave_distance {
namespace {

double reachOf(const PairSettings& settings) {
  const double warned =
      settings.warning_distance ? *settings.warning_distance + settings.warning_hysteresis : 0.0;
  return std::max(settings.tracker.cutoff, warned);
}

// The largest reach of a pair of each body; below 0: none.
std::vector<double> reachesOf(const Scene& scene) {
  std::vector<double> reaches(scene.bodies.size(), -1.0);
  for (std::size_t i = 0; i < scene.rules.list.size(); ++i) {
    const PairRule& rule = scene.rules.list[i];
    if (!rule.is_enabled || !rule.is_watched) continue;
    const double reach = reachOf(settingsOf(scene, rule));
    for (const std::size_t body : scene.rules.bodiesOf(i).indices())
      reaches[body] = std::max(reaches[body], reach);
  }
  return reaches;
}

std::size_t findBySerial(const std::unordered_map<std::uint64_t, std::size_t>& places, const SceneBody& body,
                         const Scene& scene) {
  const auto found = places.find(body.serial);
  const bool is_there = found != places.end() && isSameBody(scene.bodies[found->second], body);
  return is_there ? found->second : scene.bodies.size();
}

// What a near pair is in another scene: nullptr when no rule watches it there.
std::shared_ptr<const ScenePair> pairIn(const Scene& scene, std::size_t a, std::size_t b,
                                        const TrackedPair& tracked, bool settings_changed) {
  if (a == scene.bodies.size() || b == scene.bodies.size()) return nullptr;
  const PairRule* rule = ruleOf(scene, a, b);
  if (rule == nullptr || !rule->is_enabled) return nullptr;
  const bool is_shared = &scene.bodies[a] == tracked.body_a.get() && &scene.bodies[b] == tracked.body_b.get();
  if (!settings_changed && is_shared && tracked.origin->body_a == a && tracked.origin->body_b == b) {
    return tracked.origin;
  }
  std::optional<ScenePair> pair = ruledPair(scene, a, b);
  // In a scene with another order of bodies, the two may have changed sides.
  if (!isSameBody(scene.bodies[pair->body_a], *tracked.body_a)) return nullptr;
  return std::make_shared<const ScenePair>(std::move(*pair));
}

}  // namespace

NearPairs::Plan NearPairs::plan(const Scene& scene, bool settings_changed) const {
  Plan next;
  next.scene = scene;
  next.free_slots = now_.free_slots;
  next.freed_slots = now_.freed_slots;
  next.slot_count = now_.slot_count;
  std::unordered_map<std::uint64_t, std::size_t> places;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) places.emplace(scene.bodies[i].serial, i);
  const std::vector<double> reaches = reachesOf(scene);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::shared_ptr<const SceneBody> body = scene.bodies.share(i);
    const auto known = now_.slot_of.find(body->serial);
    std::uint32_t slot = 0;
    if (known != now_.slot_of.end()) {
      slot = known->second;
    } else if (!next.free_slots.empty()) {
      slot = next.free_slots.back();
      next.free_slots.pop_back();
    } else {
      slot = next.slot_count++;
    }
    next.slot_of.emplace(body->serial, slot);
    const double reach = reaches[i];
    next.has_rules = next.has_rules || reach >= 0.0;
    next.bodies.push_back({body, slot, reach < 0.0 ? reach : 0.5 * reach});
  }
  for (const Plan::Body& body : now_.bodies) {
    if (next.slot_of.count(body.body->serial) == 0) next.freed_slots.push_back(body.slot);
  }
  const auto in_next = [&](const TrackedPair& pair) {
    return pairIn(scene, findBySerial(places, *pair.body_a, scene), findBySerial(places, *pair.body_b, scene),
                  pair, settings_changed);
  };
  for (const std::shared_ptr<TrackedPair>& pair : pairs_) next.pairs.push_back(in_next(*pair));
  for (const Resting& resting : resting_) next.resting.push_back(in_next(*resting.pair));
  if (next.has_rules) next.ruled = countPairsByRule(scene);
  return next;
}

void NearPairs::adopt(Plan&& plan, bool settings_changed, std::uint64_t& largest_id) {
  for (const Plan::Body& body : now_.bodies) {
    const auto found = plan.slot_of.find(body.body->serial);
    if (found == plan.slot_of.end()) sweep_.remove(body.slot);
  }
  const auto go_on_as = [&](std::shared_ptr<const ScenePair>& pair, TrackedPair& tracked) {
    if (pair == tracked.origin && !settings_changed) return;
    const auto& a = plan.scene.bodies.share(pair->body_a);
    const auto& b = plan.scene.bodies.share(pair->body_b);
    tracked.adopt(std::move(pair), a, b, settings_changed);
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (!plan.pairs[i]) continue;
    go_on_as(plan.pairs[i], *pairs_[i]);
    pairs_[kept] = std::move(pairs_[i]);
    entries_[kept] = entries_[i];
    ++kept;
  }
  entries_.resize(kept);
  pairs_.resize(kept);
  entry_of_.clear();
  std::size_t rests = 0;
  for (std::size_t i = 0; i < resting_.size(); ++i) {
    if (!plan.resting[i]) {
      largest_id = std::max(largest_id, resting_[i].pair->largest_id);
      continue;
    }
    go_on_as(plan.resting[i], *resting_[i].pair);
    if (rests != i) resting_[rests] = std::move(resting_[i]);
    ++rests;
  }
  resting_.resize(rests);
  plan.resting.clear();
  plan.pairs.clear();
  now_ = std::move(plan);
  asks_all_ = true;
  ++revision_;
}

void NearPairs::recover() {
  sweep_.clear();
  cut_.clear();
  unknown_before_.clear();
  for (Entry& entry : entries_) entry.is_by_box = entry.is_by_unknown = false;
  asks_all_ = true;
  keeps_left_ = true;
  entries_.resize(std::min(entries_.size(), pairs_.size()));
  pairs_.resize(entries_.size());
  entry_of_.clear();
  ++revision_;
}

}  // namespace concave_distance

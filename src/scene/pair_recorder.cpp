#include "pair_recorder.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace concave_distance {

// The documents say what a pair's cycles take.
static_assert(sizeof(RecordedCycle) == 136);

Eigen::Isometry3d RecordedCycle::pose() const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.matrix().topRows<3>() = a_from_b;
  return pose;
}

void PairRecorder::record(const SceneTracker::Pairs& pairs, std::int64_t epoch) {
  if (length_ == 0) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  epoch_ = epoch;
  follow(pairs);
  for (Slot& slot : slots_) {
    add(slot);
    if (request_ == nullptr || !isOf(slot, request_->body_a, request_->body_b)) continue;
    answer(slot, *request_);
    if (slot.tracked->solved()) request_->recording.last_answer = slot.tracked->solution;
    request_ = nullptr;
    answered_.notify_all();
  }
}

// Moves the slots to the places that their pairs have now.
void PairRecorder::follow(const SceneTracker::Pairs& pairs) {
  const auto is_there = [&](std::size_t i) { return i < slots_.size() && slots_[i].tracked == pairs[i]; };
  std::size_t first = 0;
  while (first < pairs.size() && is_there(first)) ++first;
  if (first < pairs.size() || slots_.size() != pairs.size()) {
    std::unordered_map<const TrackedPair*, Slot*> known;
    for (Slot& slot : slots_) known.emplace(slot.tracked.get(), &slot);
    std::vector<Slot> next(pairs.size());
    rings_ = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto found = known.find(pairs[i].get());
      if (found != known.end()) next[i] = std::move(*found->second);
      next[i].tracked = pairs[i];
      rings_ += next[i].ring.empty() ? 0 : 1;
    }
    slots_ = std::move(next);
  }
  for (Slot& slot : slots_) {
    if (slot.pair == slot.tracked->origin && slot.body_a == slot.tracked->body_a &&
        slot.body_b == slot.tracked->body_b)
      continue;
    slot.pair = slot.tracked->origin;
    slot.body_a = slot.tracked->body_a;
    slot.body_b = slot.tracked->body_b;
  }
}

void PairRecorder::add(Slot& slot) {
  const TrackedPair& pair = *slot.tracked;
  if (!pair.demand.due || pair.repeated) return;
  if (pair.state == PairState::NotLocated) {
    ++slot.missed;
    return;
  }
  if (pair.state != PairState::Solved && pair.state != PairState::BeyondCutoff) return;
  if (slot.ring.empty()) {
    // A pair that was never near does without.
    slot.has_room = (rings_ + 1) * length_ * sizeof(RecordedCycle) <= most_bytes_;
    if (!pair.solved() || !slot.has_room) return;
    slot.ring.resize(length_);
    ++rings_;
  }
  RecordedCycle cycle;
  cycle.a_from_b = pair.input.a_from_b.matrix().topRows<3>();
  cycle.time = pair.input.time;
  cycle.distance = pair.solution.distance;
  cycle.lower_bound = pair.box_bound.value_or(pair.solution.lower_bound);
  cycle.niche_count = static_cast<std::uint32_t>(pair.solution.niches.size());
  cycle.state = pair.state;
  cycle.status = pair.solution.status;
  cycle.with_niches = pair.demand.niches;
  cycle.put_off = pair.put_off;
  cycle.missed_before = std::exchange(slot.missed, 0);
  if (slot.count > 0 && cycle.time < slot.last().time) slot.count = slot.next = 0;
  if (slot.count > 0 && cycle.time == slot.last().time && cycle.a_from_b == slot.last().a_from_b) {
    cycle.missed_before += slot.last().missed_before;
    slot.last() = cycle;
    return;
  }
  slot.ring[slot.next] = cycle;
  slot.next = (slot.next + 1) % slot.ring.size();
  slot.count = std::min(slot.count + 1, slot.ring.size());
}

bool PairRecorder::isOf(const Slot& slot, std::uint64_t body_a, std::uint64_t body_b) {
  const std::uint64_t a = slot.body_a->serial;
  const std::uint64_t b = slot.body_b->serial;
  return (a == body_a && b == body_b) || (a == body_b && b == body_a);
}

std::optional<PairRecording> PairRecorder::take(std::uint64_t body_a, std::uint64_t body_b, std::size_t most,
                                                std::chrono::milliseconds wait) {
  Request request{body_a, body_b, most, false, {}};
  request.recording.cycles.reserve(std::min<std::size_t>(most, length_));
  std::unique_lock<std::mutex> lock(mutex_);
  if (request_ == nullptr) {
    request_ = &request;
    answered_.wait_for(lock, wait, [&] { return request.is_answered; });
    if (request_ == &request) request_ = nullptr;
  }
  const auto slot =
      std::find_if(slots_.begin(), slots_.end(), [&](const Slot& one) { return isOf(one, body_a, body_b); });
  if (!request.is_answered && slot != slots_.end()) answer(*slot, request);
  if (!request.is_answered) return std::nullopt;
  return std::move(request.recording);
}

void PairRecorder::answer(const Slot& slot, Request& request) const {
  PairRecording& recording = request.recording;
  recording.pair = slot.pair;
  recording.body_a = slot.body_a;
  recording.body_b = slot.body_b;
  recording.missed_after = slot.missed;
  recording.epoch = epoch_;
  recording.has_room = slot.has_room;
  for (std::size_t back = std::min(request.most, slot.count); back > 0; --back)
    recording.cycles.push_back(slot.ring[(slot.next + slot.ring.size() - back) % slot.ring.size()]);
  request.is_answered = true;
}

}  // namespace concave_distance

#include "sweep_and_prune.h"

#include <algorithm>
#include <cmath>

namespace concave_distance {
namespace {

/// Swaps for each end above which sorting anew is faster.
constexpr std::uint64_t kMostSwapsEach = 32;
constexpr std::size_t kFewNew = 32;  // boxes that appear at once and are still sorted in one by one

}  // namespace

std::size_t SlotPairSet::homeOf(std::uint64_t key) const {
  return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 20U) & (keys_.size() - 1);
}

std::size_t SlotPairSet::placeOf(std::uint64_t key) const {
  std::size_t place = homeOf(key);
  while (keys_[place] != kFree && keys_[place] != key) place = (place + 1) & (keys_.size() - 1);
  return place;
}

bool SlotPairSet::contains(SlotPair pair) const {
  return !keys_.empty() && keys_[placeOf(keyOf(pair))] != kFree;
}

bool SlotPairSet::insert(SlotPair pair) {
  if (2 * (size_ + 1) > keys_.size()) grow();
  std::uint64_t& place = keys_[placeOf(keyOf(pair))];
  if (place != kFree) return false;
  place = keyOf(pair);
  ++size_;
  return true;
}

// What stands behind the gap moves up, unless its own place is behind the gap.
bool SlotPairSet::erase(SlotPair pair) {
  if (keys_.empty()) return false;
  std::size_t gap = placeOf(keyOf(pair));
  if (keys_[gap] == kFree) return false;
  const std::size_t mask = keys_.size() - 1;
  for (std::size_t next = (gap + 1) & mask; keys_[next] != kFree; next = (next + 1) & mask) {
    const std::size_t home = homeOf(keys_[next]);
    if (((next - home) & mask) < ((next - gap) & mask)) continue;
    keys_[gap] = keys_[next];
    gap = next;
  }
  keys_[gap] = kFree;
  --size_;
  return true;
}

void SlotPairSet::clear() {
  std::fill(keys_.begin(), keys_.end(), kFree);
  size_ = 0;
}

void SlotPairSet::grow() {
  std::vector<std::uint64_t> old(keys_.empty() ? 64 : 2 * keys_.size(), kFree);
  old.swap(keys_);
  for (const std::uint64_t key : old) {
    if (key != kFree) keys_[placeOf(key)] = key;
  }
}

void SweepAndPrune::set(std::uint32_t slot, const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  if (!(lower.array() <= upper.array()).all()) {
    remove(slot);
    return;
  }
  if (slot >= boxes_.size()) boxes_.resize(slot + std::size_t{1});
  Box& box = boxes_[slot];
  box.lower = lower;
  box.upper = upper;
  box.is_wanted = true;
}

void SweepAndPrune::remove(std::uint32_t slot) {
  if (slot >= boxes_.size()) return;
  boxes_[slot].is_wanted = false;
  has_removed_ = has_removed_ || boxes_[slot].is_listed;
}

void SweepAndPrune::clear() {
  boxes_.clear();
  for (std::vector<End>& ends : ends_) ends.clear();
  overlaps_.clear();
  begun_.clear();
  ended_.clear();
  has_removed_ = false;
}

void SweepAndPrune::update() {
  begun_.clear();
  ended_.clear();
  swaps_ = 0;
  if (has_removed_) takeOutRemoved();
  const std::size_t added = addNew();
  for (std::vector<End>& ends : ends_) {
    const auto axis = static_cast<Eigen::Index>(&ends - ends_.data());
    for (End& end : ends) {
      const Box& box = boxes_[end.slot];
      end.value = (end.is_upper ? box.upper : box.lower)[axis];
    }
  }
  const bool are_few = added <= kFewNew || 8 * added <= ends_[0].size() / 2;
  if (!are_few || !(sort(0) && sort(1) && sort(2))) sortAnew();
}

void SweepAndPrune::takeOutRemoved() {
  has_removed_ = false;
  const auto is_out = [&](const End& end) { return !boxes_[end.slot].is_wanted; };
  for (std::vector<End>& ends : ends_) {
    ends.erase(std::remove_if(ends.begin(), ends.end(), is_out), ends.end());
  }
  overlaps_.visit([&](SlotPair pair) {
    if (!boxes_[pair.a].is_wanted || !boxes_[pair.b].is_wanted) ended_.push_back(pair);
  });
  for (const SlotPair pair : ended_) overlaps_.erase(pair);
  for (Box& box : boxes_) box.is_listed = box.is_listed && box.is_wanted;
}

// The ends of new boxes stand behind all others at first, where they overlap nothing.
std::size_t SweepAndPrune::addNew() {
  std::size_t added = 0;
  for (std::uint32_t slot = 0; slot < boxes_.size(); ++slot) {
    Box& box = boxes_[slot];
    if (!box.is_wanted || box.is_listed) continue;
    for (std::vector<End>& ends : ends_) {
      ends.push_back({0.0, slot, false});
      ends.push_back({0.0, slot, true});
    }
    box.is_listed = true;
    ++added;
  }
  return added;
}

// Insertion sort. @return false when it gave up: too much has moved too far
bool SweepAndPrune::sort(std::size_t axis) {
  std::vector<End>& ends = ends_[axis];
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const End passing = ends[i];
    std::size_t place = i;
    for (; place > 0 && isBefore(passing, ends[place - 1]); --place) {
      swap(passing, ends[place - 1]);
      ends[place] = ends[place - 1];
    }
    ends[place] = passing;
    swaps_ += i - place;
    if (swaps_ > kMostSwapsEach * ends.size() + 1000) return false;
  }
  return true;
}

// Each two ends change their order at most once, so that a pair begins or ends at most once, too.
void SweepAndPrune::swap(const End& passing, const End& passed) {
  if (passing.is_upper == passed.is_upper) return;
  const SlotPair pair = slotPair(passing.slot, passed.slot);
  if (passing.is_upper) {
    if (overlaps_.erase(pair)) ended_.push_back(pair);
  } else if (doOverlap(pair) && overlaps_.insert(pair)) {
    begun_.push_back(pair);
  }
}

bool SweepAndPrune::doOverlap(SlotPair pair) const {
  const Box& a = boxes_[pair.a];
  const Box& b = boxes_[pair.b];
  return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

void SweepAndPrune::sortAnew() {
  swaps_ = 0;
  for (std::vector<End>& ends : ends_) std::sort(ends.begin(), ends.end(), isBefore);
  others_.clear();
  active_.clear();
  for (const End& end : ends_[0]) {
    if (end.is_upper) {
      const auto place = std::find(active_.begin(), active_.end(), end.slot);
      *place = active_.back();
      active_.pop_back();
      continue;
    }
    for (const std::uint32_t slot : active_) {
      const SlotPair pair = slotPair(slot, end.slot);
      if (doOverlap(pair)) others_.insert(pair);
    }
    active_.push_back(end.slot);
  }
  // Back to the pairs of the last update, to compare with.
  for (const SlotPair pair : begun_) overlaps_.erase(pair);
  for (const SlotPair pair : ended_) overlaps_.insert(pair);
  begun_.clear();
  ended_.clear();
  others_.visit([&](SlotPair pair) {
    if (!overlaps_.contains(pair)) begun_.push_back(pair);
  });
  overlaps_.visit([&](SlotPair pair) {
    if (!others_.contains(pair)) ended_.push_back(pair);
  });
  std::swap(overlaps_, others_);
}

}  // namespace concave_distance

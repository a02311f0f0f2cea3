#include "slot_table.h"

#include <algorithm>
#include <numeric>

namespace concave_distance::detail {

bool SlotTable::holds(const NicheKey& key) const {
  return std::any_of(slots_.begin(), slots_.end(),
                     [&](const Slot& slot) { return slot.state == SlotState::Used && slot.key == key; });
}

void SlotTable::clear() {
  for (Slot& slot : slots_) slot.state = SlotState::Free;
}

std::size_t SlotTable::assign(std::vector<SlotRequest>& requests) {
  ++cycle_;
  std::fill(owners_.begin(), owners_.end(), SlotRequest::kNone);
  for (SlotRequest& request : requests) request.slot = SlotRequest::kNone;
  keepKnown(requests);
  freeOthers();
  order_.resize(requests.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::sort(order_.begin(), order_.end(), [&](std::size_t l, std::size_t r) {
    return requests[l].distance != requests[r].distance ? requests[l].distance < requests[r].distance : l < r;
  });
  std::size_t overflow = 0;
  for (const std::size_t next : order_) {
    if (requests[next].slot != SlotRequest::kNone || !requests[next].may_begin) continue;
    std::size_t slot = findFree();
    if (slot == SlotRequest::kNone) {
      const auto farthest = std::max_element(
          owners_.begin(), owners_.end(),
          [&](std::size_t l, std::size_t r) { return requests[l].distance < requests[r].distance; });
      if (!(requests[*farthest].distance > requests[next].distance)) {
        ++overflow;
        continue;
      }
      slot = static_cast<std::size_t>(farthest - owners_.begin());
      requests[*farthest].slot = SlotRequest::kNone;  // it comes later in the order, and is counted then
    }
    take(slot, next, requests, true);
  }
  return overflow;
}

void SlotTable::keepKnown(std::vector<SlotRequest>& requests) {
  matches_.clear();
  for (std::size_t i = 0; i < requests.size(); ++i) {
    for (std::size_t k = 0; k < slots_.size(); ++k) {
      const Slot& slot = slots_[k];
      if (slot.state != SlotState::Used || !(slot.key == requests[i].key)) continue;
      const double moved =
          std::min((slot.on_a - requests[i].on_a).norm(), (slot.on_b - requests[i].on_b).norm());
      matches_.push_back({moved, i, k});
    }
  }
  std::sort(matches_.begin(), matches_.end(), [](const Match& l, const Match& r) {
    if (l.moved != r.moved) return l.moved < r.moved;
    return l.slot != r.slot ? l.slot < r.slot : l.request < r.request;
  });
  for (const Match& match : matches_) {
    if (requests[match.request].slot != SlotRequest::kNone) continue;
    if (owners_[match.slot] != SlotRequest::kNone) continue;
    take(match.slot, match.request, requests, false);
  }
}

void SlotTable::freeOthers() {
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    Slot& slot = slots_[k];
    if (slot.state == SlotState::Used && owners_[k] == SlotRequest::kNone) {
      slot.state = SlotState::Freed;
      slot.since = cycle_;
    } else if (slot.state == SlotState::Freed && cycle_ - slot.since >= ConstraintRows::kQuarantine) {
      slot.state = SlotState::Free;
      slot.since = cycle_;
    }
  }
}

std::size_t SlotTable::findFree() const {
  std::size_t oldest = SlotRequest::kNone;
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    if (slots_[k].state == SlotState::Free) return k;
    if (slots_[k].state != SlotState::Freed) continue;
    if (oldest == SlotRequest::kNone || slots_[k].since < slots_[oldest].since) oldest = k;
  }
  return oldest;
}

void SlotTable::take(std::size_t slot, std::size_t request, std::vector<SlotRequest>& requests, bool is_new) {
  owners_[slot] = request;
  requests[request].slot = slot;
  Slot& taken = slots_[slot];
  if (is_new) taken.since = cycle_;
  taken.state = SlotState::Used;
  taken.key = requests[request].key;
  taken.on_a = requests[request].on_a;
  taken.on_b = requests[request].on_b;
}

}  // namespace concave_distance::detail

#include "node_pair_map.h"

#include <algorithm>

#include "base/pair_key.h"

namespace concave_distance {

NodePairMap::NodePairMap(std::uint32_t capacity_log2)
    : slots_(std::size_t{1} << capacity_log2), shift_(64U - capacity_log2) {}

void NodePairMap::clear() {
  used_ = 0;
  if (++stamp_ == 0) {  // after 2^32 clearings old stamps would look new
    std::fill(slots_.begin(), slots_.end(), Slot{});
    stamp_ = 1;
  }
}

/// Where the pair is, or the free slot where it would go.
std::size_t NodePairMap::slotOf(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = slotOfKey(key, shift_);
  while (slots_[slot].stamp == stamp_ && slots_[slot].key != key) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

std::uint32_t NodePairMap::find(NodeIndex node_a, NodeIndex node_b) const {
  const Slot& slot = slots_[slotOf(pairKey(node_a, node_b))];
  return slot.stamp == stamp_ ? slot.number : kAbsent;
}

std::uint32_t NodePairMap::insert(NodeIndex node_a, NodeIndex node_b, std::uint32_t number) {
  if (2 * (used_ + 1) > slots_.size()) {
    grow();
  }
  const std::uint64_t key = pairKey(node_a, node_b);
  Slot& slot = slots_[slotOf(key)];
  if (slot.stamp != stamp_) {
    slot = {key, stamp_, number};
    ++used_;
  }
  return slot.number;
}

void NodePairMap::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  --shift_;
  for (const Slot& slot : old) {
    if (slot.stamp == stamp_) {
      slots_[slotOf(slot.key)] = slot;
    }
  }
}

}  // namespace concave_distance

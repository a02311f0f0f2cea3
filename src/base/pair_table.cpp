#include "pair_table.h"

#include <algorithm>

namespace concave_distance {

void PairTable::clear() {
  size_ = 0;
  if (++stamp_ != 0) return;
  // After 2^32 clearings the stamps of old pairs would look new.
  std::fill(slots_.begin(), slots_.end(), Slot{});
  stamp_ = 1;
}

void PairTable::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  --shift_;
  for (const Slot& slot : old) {
    if (slot.stamp == stamp_) slots_[slotOf(slot.key)] = slot;
  }
}

}  // namespace concave_distance

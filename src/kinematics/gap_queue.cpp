#include "gap_queue.h"

#include <algorithm>
#include <tuple>

namespace concave_distance::detail {

bool GapQueue::Key::operator<(const Key& other) const {
  return std::tie(other.order, other.moment, other.pair) < std::tie(order, moment, pair);
}

void GapQueue::push(const ClearanceGap& gap, double order) {
  std::size_t place = gaps_.size();
  if (free_.empty()) {
    gaps_.push_back(gap);
  } else {
    place = free_.back();
    free_.pop_back();
    gaps_[place] = gap;
  }
  open_.push_back({order, gap.pair, gap.left.moment, place});
  std::push_heap(open_.begin(), open_.end());
}

std::size_t GapQueue::pop() {
  std::pop_heap(open_.begin(), open_.end());
  const std::size_t gap = open_.back().gap;
  open_.pop_back();
  return gap;
}

}  // namespace concave_distance::detail

#include "basin_memory.h"

namespace concave_distance {

void BasinMemory::clear() {
  minimum_of_pair_.clear();
  minima_.clear();
}

std::int64_t BasinMemory::find(NodeIndex node_a, NodeIndex node_b) const {
  const std::uint32_t found = minimum_of_pair_.find(node_a, node_b);
  return found == PairTable::kAbsent ? -1 : std::int64_t{found};
}

void BasinMemory::insert(NodeIndex node_a, NodeIndex node_b, std::uint32_t minimum) {
  minimum_of_pair_.insert(node_a, node_b, minimum);
}

std::uint32_t BasinMemory::addMinimum(const TrialPoint& minimum) {
  const auto next = static_cast<std::uint32_t>(minima_.size());
  const std::uint32_t index = minimum_of_pair_.insert(minimum.node_a, minimum.node_b, next);
  if (index == next) {
    minima_.push_back(minimum);
  }
  return index;
}

}  // namespace concave_distance

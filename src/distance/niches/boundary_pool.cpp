#include "boundary_pool.h"

namespace concave_distance::detail {

std::uint32_t BoundaryPool::take(std::uint32_t next, WorkLimit& limit) {
  std::uint32_t chunk = free_;
  if (chunk != kNone) {
    free_ = (*this)[chunk].next;
  } else {
    if (chunk_count_ == blocks_.size() * kBlockSize) {
      if (!limit.makeRoom(blocks_) || !limit.takeMemory(sizeof(Block))) return kNone;
      blocks_.push_back(std::make_unique<Block>());
    }
    chunk = chunk_count_++;
  }
  (*this)[chunk].count = 0;
  (*this)[chunk].next = next;
  return chunk;
}

void BoundaryPool::release(std::uint32_t first) {
  while (first != kNone) {
    const std::uint32_t next = (*this)[first].next;
    (*this)[first].next = free_;
    free_ = first;
    first = next;
  }
}

void BoundaryPool::clear() {
  chunk_count_ = 0;
  free_ = kNone;
}

std::size_t BoundaryPool::memoryBytes() const {
  return blocks_.size() * sizeof(Block) + blocks_.capacity() * sizeof(blocks_[0]) +
         anew.capacity() * sizeof(Directed) + crossed.capacity() * sizeof(BoundaryElement);
}

}  // namespace concave_distance::detail

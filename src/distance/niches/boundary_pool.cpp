#include "boundary_pool.h"

namespace concave_distance::detail {

std::uint32_t BoundaryPool::take(std::uint32_t next) {
  std::uint32_t chunk = free_;
  if (chunk != kNone) {
    free_ = (*this)[chunk].next;
  } else {
    if (chunk_count_ == blocks_.size() * kBlockSize) blocks_.push_back(std::make_unique<Block>());
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

}  // namespace concave_distance::detail

#pragma once

// Replaces the global operator new so that a test can make it fail. For programs of one source file: include
// it there, nowhere else, and not beside count_allocations.h.

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

namespace {

/// Allocations of this thread that still succeed.
thread_local std::size_t allocations_left = std::numeric_limits<std::size_t>::max();

/// While it lives, the thread's first `succeeding` allocations succeed and all others throw std::bad_alloc.
class FailingAllocations {
 public:
  explicit FailingAllocations(std::size_t succeeding) { allocations_left = succeeding; }
  ~FailingAllocations() { allocations_left = std::numeric_limits<std::size_t>::max(); }
  FailingAllocations(const FailingAllocations&) = delete;
  FailingAllocations& operator=(const FailingAllocations&) = delete;
};

}  // namespace

// Not inlined: gcc 12 warns where it has inlined only one of a pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (allocations_left == 0) throw std::bad_alloc();
  if (allocations_left != std::numeric_limits<std::size_t>::max()) --allocations_left;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

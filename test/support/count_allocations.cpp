#include "support/count_allocations.h"

#include <malloc.h>

#include <cstdlib>
#include <new>

std::atomic<std::size_t> allocations{0};
std::atomic<std::size_t> allocated_bytes{0};
std::atomic<std::size_t> most_allocated_bytes{0};

namespace {

void* noted(void* memory) {
  ++allocations;
  const std::size_t now = allocated_bytes += malloc_usable_size(memory);
  std::size_t most = most_allocated_bytes.load();
  while (now > most && !most_allocated_bytes.compare_exchange_weak(most, now)) {
  }
  return memory;
}

void* notedOrThrow(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return noted(memory);
}

void freeNoted(void* memory) {
  allocated_bytes -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  return notedOrThrow(std::malloc(size == 0 ? 1 : size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return notedOrThrow(std::aligned_alloc(step, (size + step - 1) / step * step));
}
// Those that do not throw must come from the same place, since all are freed below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return noted(std::malloc(size == 0 ? 1 : size));
}
void operator delete(void* memory) noexcept {
  freeNoted(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  freeNoted(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  freeNoted(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  freeNoted(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  freeNoted(memory);
}

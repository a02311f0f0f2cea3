#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>

namespace concave_distance {

/// A value that its first use makes, once for all threads; nothing changes it afterwards.
template <typename T>
class MadeOnce {
 public:
  /// Returns nullptr until the value has been made.
  const T* ifMade() const { return made_.load(std::memory_order_acquire); }

  /// Returns the value. The first call makes it and others wait; when `make` throws, the next call tries
  /// again.
  template <typename Make>
  const T& get(const Make& make) const {
    if (const T* made = ifMade()) return *made;
    std::call_once(once_, [&] {
      value_ = make();
      made_.store(&value_, std::memory_order_release);
    });
    return value_;
  }

 private:
  mutable std::once_flag once_;
  mutable T value_;
  mutable std::atomic<const T*> made_{nullptr};
};

}  // namespace concave_distance

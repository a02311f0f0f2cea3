#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace concave_distance {

/// Finds which of many entries have expired on a clock that never runs back, without looking at the others: a
/// radix heap (Ahuja, Mehlhorn, Orlin and Tarjan 1990). An entry is moved at most once for each bit by which
/// its expiry differs from the clock. The lists of all queues share one pool, so that a queue allocates
/// nothing itself.
///
/// Entries are chained through `std::uint32_t next` members of the pool's elements, which also have a
/// `std::uint64_t expiry`.
template <typename Entry>
class ExpiryQueue {
 public:
  static constexpr std::uint32_t kEnd = 0xffffffffU;

  ExpiryQueue() { heads_.fill(kEnd); }

  std::uint64_t clock() const { return clock_; }

  /// Chains an element of the pool with an expiry above the clock.
  void insert(std::vector<Entry>& pool, std::uint32_t index) {
    std::uint32_t& head = heads_[bucketOf(pool[index].expiry)];
    pool[index].next = head;
    head = index;
  }

  /// Moves the clock on and takes out every entry whose expiry it has reached.
  /// @param expired (index in the pool) may not insert into this queue
  template <typename Expired>
  void advance(std::vector<Entry>& pool, std::uint64_t to, const Expired& expired) {
    if (to <= clock_) return;
    const std::uint32_t highest = widthOf(to ^ clock_);
    clock_ = to;
    for (std::uint32_t bucket = 1; bucket < highest; ++bucket) {
      std::uint32_t index = heads_[bucket];
      heads_[bucket] = kEnd;
      while (index != kEnd) {
        const std::uint32_t next = pool[index].next;
        expired(index);
        index = next;
      }
    }
    std::uint32_t index = heads_[highest];
    heads_[highest] = kEnd;
    while (index != kEnd) {
      const std::uint32_t next = pool[index].next;
      if (pool[index].expiry <= to) {
        expired(index);
      } else {
        insert(pool, index);
      }
      index = next;
    }
  }

  /// Forgets its entries; the clock begins anew.
  void clear() {
    heads_.fill(kEnd);
    clock_ = 0;
  }

 private:
  static std::uint32_t widthOf(std::uint64_t value) {
    return value == 0 ? 0U : 64U - static_cast<std::uint32_t>(__builtin_clzll(value));
  }
  std::uint32_t bucketOf(std::uint64_t expiry) const { return widthOf(expiry ^ clock_); }

  std::array<std::uint32_t, 65> heads_;  ///< by the number of bits below and with the highest that differs
  std::uint64_t clock_ = 0;
};

}  // namespace concave_distance

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pair_key.h"

namespace concave_distance {

/// Maps pairs of nodes or of triangles to numbers: open addressing, doubled when half full. Library tables
/// clear in time proportional to their capacity; this one clears in constant time and keeps its capacity.
class PairTable {
 public:
  static constexpr std::uint32_t kAbsent = 0xffffffffU;

  /// @param capacity_log2 the table starts with 2^capacity_log2 slots of 16 bytes; in [1, 31]
  explicit PairTable(std::uint32_t capacity_log2 = 12)
      : slots_(std::size_t{1} << capacity_log2), shift_(64U - capacity_log2) {}

  /// Grows to at least 2^capacity_log2 slots.
  void reserve(std::uint32_t capacity_log2) {
    while (slots_.size() < std::size_t{1} << capacity_log2) grow();
  }

  /// Forgets all pairs.
  void clear();

  /// Returns the number of a pair; kAbsent where it has none.
  template <typename Tag>
  std::uint32_t find(Index<Tag> a, Index<Tag> b) const {
    const Slot& slot = slots_[slotOf(pairKey(a, b))];
    return slot.stamp == stamp_ ? slot.number : kAbsent;
  }

  /// Gives a pair a number, unless it has one. Returns the number that it has now.
  template <typename Tag>
  std::uint32_t insert(Index<Tag> a, Index<Tag> b, std::uint32_t number) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    const std::uint64_t key = pairKey(a, b);
    Slot& slot = slots_[slotOf(key)];
    if (slot.stamp != stamp_) {
      slot = {key, stamp_, number};
      ++size_;
    }
    return slot.number;
  }

  std::size_t size() const { return size_; }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t stamp = 0;  ///< the slot is in use when this equals stamp_
    std::uint32_t number = 0;
  };

  /// Returns the slot of a key, or the free one where it would go.
  std::size_t slotOf(std::uint64_t key) const {
    std::size_t slot = slotOfKey(key, shift_);
    while (slots_[slot].stamp == stamp_ && slots_[slot].key != key) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
  }
  void grow();

  std::vector<Slot> slots_;
  std::uint32_t shift_;  ///< see slotOfKey()
  std::uint32_t stamp_ = 1;
  std::size_t size_ = 0;  ///< pairs
};

}  // namespace concave_distance

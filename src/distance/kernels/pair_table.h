#pragma once

#include <cstdint>
#include <vector>

#include "base/pair_key.h"
#include "concave_distance/base/indices.h"
#include "concave_distance/base/work_limit.h"

namespace concave_distance::detail {

/// From triangle pairs to numbers: open addressing, doubled when half full.
class PairTable {
 public:
  static constexpr std::uint32_t kAbsent = 0xffffffffU;

  /// @param log_slots at first: logarithm of their number, from 1
  explicit PairTable(std::uint32_t log_slots = 12)
      : slots_(std::size_t{1} << log_slots), shift_(64 - log_slots) {}

  std::uint32_t find(TriangleIndex a, TriangleIndex b) const { return slots_[slotOf(pairKey(a, b))].number; }

  /// The pair must not be in the table yet.
  void insert(TriangleIndex a, TriangleIndex b, std::uint32_t number) {
    if (2 * (used_.size() + 1) > slots_.size()) grow();
    const std::uint64_t key = pairKey(a, b);
    const std::size_t slot = slotOf(key);
    slots_[slot] = {key, number};
    used_.push_back(static_cast<std::uint32_t>(slot));
  }

  std::size_t memoryBytes() const {
    return slots_.capacity() * sizeof(Slot) + used_.capacity() * sizeof(std::uint32_t);
  }

  /// Whether another pair may be inserted; lets the table grow at once.
  bool makeRoom(WorkLimit& limit) {
    if (!limit.makeRoom(used_)) return false;
    if (2 * (used_.size() + 1) <= slots_.size()) return true;
    const std::size_t before = slots_.size() * sizeof(Slot);
    if (!limit.takeMemory(2 * before)) return false;
    grow();
    limit.returnMemory(before);
    return true;
  }

  /// Keeps the capacity; costs what is in it.
  void clear() {
    for (const std::uint32_t slot : used_) slots_[slot].number = kAbsent;
    used_.clear();
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number = kAbsent;
  };

  /// Where the pair is, or the free slot where it would go.
  std::size_t slotOf(std::uint64_t key) const {
    std::size_t slot = slotOfKey(key, shift_);
    while (slots_[slot].number != kAbsent && slots_[slot].key != key) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
  }

  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    --shift_;
    for (std::uint32_t& used : used_) {
      const Slot& slot = old[used];
      used = static_cast<std::uint32_t>(slotOf(slot.key));
      slots_[used] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::uint32_t shift_;              ///< see slotOfKey()
  std::vector<std::uint32_t> used_;  ///< slots
};

}  // namespace concave_distance::detail

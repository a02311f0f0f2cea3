#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "concave_distance/base/indices.h"

namespace concave_distance {

/// From node pairs to numbers. Open addressing with generation stamps: clear() is O(1), and once grown the
/// table allocates nothing.
class NodePairMap {
 public:
  static constexpr std::uint32_t kAbsent = 0xffffffffU;

  /// @param capacity_log2 the table starts with 2^capacity_log2 slots of 16 bytes; in [1, 31]
  explicit NodePairMap(std::uint32_t capacity_log2 = 10);
  /// Grows to at least 2^capacity_log2 slots.
  void reserve(std::uint32_t capacity_log2) {
    while (slots_.size() < std::size_t{1} << capacity_log2) grow();
  }
  void clear();
  std::uint32_t find(NodeIndex node_a, NodeIndex node_b) const;  ///< kAbsent when it is not there
  /// Keeps the number a pair has already. Returns the number the pair has now.
  std::uint32_t insert(NodeIndex node_a, NodeIndex node_b, std::uint32_t number);
  std::size_t size() const { return used_; }
  std::size_t memoryBytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t stamp = 0;  ///< in use when it equals stamp_
    std::uint32_t number = 0;
  };
  std::size_t slotOf(std::uint64_t key) const;
  void grow();
  std::vector<Slot> slots_;
  std::uint32_t shift_;
  std::uint32_t stamp_ = 1;
  std::size_t used_ = 0;
};

}  // namespace concave_distance

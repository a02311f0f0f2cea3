#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/pair_table.h"
#include "concave_distance/search/trial_point.h"

namespace concave_distance {

/// Basins descended in this cycle: node pairs that a descent ran through, with the minimum it led to.
/// clear() is O(1), a warm cycle allocates nothing.
class BasinMemory {
 public:
  /// @param capacity_log2 of the pairs' table, see PairTable
  explicit BasinMemory(std::uint32_t capacity_log2 = 12) : minimum_of_pair_(capacity_log2) {}
  void reserve(std::size_t minima) {
    minima_.reserve(minima);
    minimum_of_pair_.reserve(kUsualPairsLog2);
  }
  void clear();  ///< forgets all; call once a cycle
  /// Index into minima() or -1.
  std::int64_t find(NodeIndex node_a, NodeIndex node_b) const;
  /// Remembers that a descent through the pair ends in `minimum`; a pair known already stays as it is.
  void insert(NodeIndex node_a, NodeIndex node_b, std::uint32_t minimum);
  /// The minimum's index; the one it had when it is known.
  std::uint32_t addMinimum(const TrialPoint& minimum);
  /// Distinct local minima met this cycle, in order of discovery.
  const std::vector<TrialPoint>& minima() const { return minima_; }

 private:
  static constexpr std::uint32_t kUsualPairsLog2 = 12;
  PairTable minimum_of_pair_;
  std::vector<TrialPoint> minima_;
};

}  // namespace concave_distance

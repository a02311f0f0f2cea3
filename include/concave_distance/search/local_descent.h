#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/search/pair_objective.h"

namespace concave_distance {

/// Basins descended in this cycle: each node pair that a descent ran through, with the minimum it led to.
/// Open addressing with generation stamps: clear() is O(1), a warm cycle allocates nothing.
class BasinMemory {
 public:
  explicit BasinMemory(std::uint32_t capacity_log2 = 14);
  void clear();  ///< forgets all; call once a cycle
  /// Index into minima() or -1.
  std::int64_t find(NodeIndex node_a, NodeIndex node_b) const;
  void insert(NodeIndex node_a, NodeIndex node_b, std::uint32_t minimum);
  std::uint32_t addMinimum(const TrialPoint& minimum);
  /// Distinct local minima met this cycle, in order of discovery.
  const std::vector<TrialPoint>& minima() const { return minima_; }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t stamp = 0;
    std::uint32_t minimum = 0;
  };
  void grow();
  std::vector<Slot> slots_;
  std::vector<TrialPoint> minima_;
  std::uint32_t stamp_ = 1;
  std::uint32_t used_ = 0;
};

/// Carretero, sec. 3.1.5: node A moves to its best neighbour until none is closer, then node B, in turn until
/// neither moves. Ties by node index, so that the end is a strict function of the start. With `memory`, a
/// descent that meets a node pair already descended takes over its minimum, and a finished one is remembered.
/// Returns a discrete local minimum: no neighbour of either node is closer.
TrialPoint descend(const PairObjective& objective, TrialPoint start, BasinMemory* memory,
                   std::vector<std::uint64_t>& trail, SearchCost& cost);

}  // namespace concave_distance

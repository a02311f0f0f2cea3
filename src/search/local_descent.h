#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "basin_memory.h"
#include "pair_objective.h"
#include "search/grid/node_graph.h"

namespace concave_distance {

/// One descent over node pairs (Carretero, sec. 3.1.5): node A moves to its best neighbour until none is
/// closer, then node B, in turn until neither moves; of equally good neighbours the one of smallest index.
/// The stored squared distance, in double and in A's frame, only ever falls; whatever was found in float or
/// in B's frame is accepted only when it does. Node pairs being finitely many, it ends.
class Descent {
 public:
  /// @param memory of descents with the same moves; nullptr: none. A descent that meets a node pair already
  ///        descended takes over its minimum, and a finished one is remembered. The pairs of the first half
  ///        move are not: they depend on B's starting node, which another descent rarely shares, and
  ///        remembering them costs more than it saves.
  /// @param trail buffer; keeps its capacity
  Descent(const PairObjective& objective, BasinMemory* memory, std::vector<std::uint64_t>& trail,
          SearchCost& cost);
  Descent(const Descent&) = delete;
  Descent& operator=(const Descent&) = delete;

  /// `start.squared_distance` is not read.
  void begin(const TrialPoint& start);
  /// Moves on until neither node has a closer neighbour; false where it has joined a basin that was known.
  bool run();
  /// Moves both nodes to a pair that is closer, between two runs.
  void moveTo(const TrialPoint& closer);
  const TrialPoint& point() const { return point_; }
  /// Remembers the way and returns where it ends.
  const TrialPoint& end();

 private:
  bool joinsKnownBasin();
  bool moveA();
  bool stepA();
  bool moveB();
  bool stepB();

  const PairObjective& objective_;
  const NodeGraph& graph_a_;
  const NodeGraph& graph_b_;
  TrialPoint point_{};
  SearchCost& cost_;
  Eigen::Vector3d b_in_a_ = Eigen::Vector3d::Zero();
  BasinMemory* memory_;
  std::vector<std::uint64_t>& trail_;
  bool joined_ = false;
};

/// Returns a discrete local minimum: no neighbour of either node is closer by PairObjective::squaredDistance,
/// whose value it carries.
TrialPoint descend(const PairObjective& objective, const TrialPoint& start, BasinMemory* memory,
                   std::vector<std::uint64_t>& trail, SearchCost& cost);

}  // namespace concave_distance

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
/// in B's frame is accepted only when it does. Node pairs being finitely many, it ends. On graphs with levels
/// (SearchNodes::levels) a move takes longer steps the longer it is, and ends where no neighbour on the graph
/// itself is closer all the same: of several such nodes not always the one that steps along edges lead to.
class Descent {
 public:
  /// @param memory of descents with the same moves; nullptr: none. A descent that meets a node pair already
  ///        descended takes over its minimum, and a finished one is remembered. The pairs of the first half
  ///        move are not: they depend on B's starting node, which another descent rarely shares, and
  ///        remembering them costs more than it saves.
  /// @param trail buffer; keeps its capacity
  Descent(const PairObjective& objective, BasinMemory* memory, std::vector<std::uint64_t>& trail,
          SearchCost& cost, bool takes_long_steps = true);
  Descent(const Descent&) = delete;
  Descent& operator=(const Descent&) = delete;
  virtual ~Descent() = default;

  /// Returns a discrete local minimum: no neighbour of either node is closer by
  /// PairObjective::squaredDistance, whose value it carries. `start.squared_distance` is not read.
  TrialPoint from(const TrialPoint& start);

 protected:
  /// Called where no move of one node is left; true when another has led closer (thesis/src/genetic).
  virtual bool moveOn() { return false; }
  /// Moves both nodes to a pair that is closer.
  void moveTo(const TrialPoint& closer);

  const PairObjective& objective_;
  const NodeGraph& graph_a_;
  const NodeGraph& graph_b_;
  TrialPoint point_{};
  SearchCost& cost_;

 private:
  bool run();
  bool joinsKnownBasin();
  bool moveA();
  bool stepA();
  bool moveB();
  bool stepB();

  bool takes_long_steps_;
  Eigen::Vector3d b_in_a_ = Eigen::Vector3d::Zero();
  BasinMemory* memory_;
  std::vector<std::uint64_t>& trail_;
  bool joined_ = false;
};

/// Descent::from(), of a descent as the search takes it.
TrialPoint descend(const PairObjective& objective, const TrialPoint& start, BasinMemory* memory,
                   std::vector<std::uint64_t>& trail, SearchCost& cost);

}  // namespace concave_distance

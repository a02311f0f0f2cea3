#pragma once

#include <cstdint>
#include <vector>

#include "search/basin_memory.h"
#include "search/pair_objective.h"

namespace concave_distance {

/// How a descent may move.
enum class DescentMoves : std::uint8_t {
  OneNode,  ///< to a neighbour of one node, the other stays (Carretero, sec. 3.1.5)
  /// Where no such move is left also to a neighbour of both at once (the thesis's outlook, sec. 7.1): along
  /// parallel edges, whose nodes are pairwise closest, nothing else leads on.
  BothNodes
};

/// Descends as descend() does, with these moves. With BothNodes no neighbour of both nodes at once is closer
/// than the result either. @param memory of descents with the same moves
TrialPoint descendBy(DescentMoves moves, const PairObjective& objective, const TrialPoint& start,
                     BasinMemory* memory, std::vector<std::uint64_t>& trail, SearchCost& cost);

}  // namespace concave_distance

#pragma once

#include <cstdint>
#include <vector>

#include "basin_memory.h"
#include "concave_distance/search/descent_moves.h"
#include "pair_objective.h"

namespace concave_distance {

/// Carretero, sec. 3.1.5: node A moves to its best neighbour until none is closer, then node B, in turn until
/// neither moves; of equally good neighbours the one of smallest index. `start.squared_distance` is not read.
/// Returns a discrete local minimum: no neighbour of either node, nor with BothNodes of both, is closer by
/// PairObjective::squaredDistance, whose value it carries.
/// On graphs with levels (SearchNodes::levels), but with OneNodeAlongEdges, a move takes longer steps the
/// longer it is, and ends where no neighbour on the graph itself is closer all the same: of several such
/// nodes not always the one that steps along edges lead to. With `memory`, a descent that meets a node pair
/// already descended takes over its minimum, and a finished one is remembered. The pairs of the first half
/// move are not: they depend on B's starting node, which another descent rarely shares, and remembering them
/// costs more than it saves.
/// @param memory of descents with the same moves
/// @param trail buffer; keeps its capacity
TrialPoint descend(const PairObjective& objective, TrialPoint start, BasinMemory* memory,
                   std::vector<std::uint64_t>& trail, SearchCost& cost,
                   DescentMoves moves = DescentMoves::OneNode);

}  // namespace concave_distance

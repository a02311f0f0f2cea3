#pragma once

#include <cstdint>

namespace concave_distance {

/// How a descent may move.
enum class DescentMoves : std::uint8_t {
  OneNode,  ///< to a neighbour of one node, the other stays (Carretero, sec. 3.1.5); on fine grids also in
            ///< longer steps
  /// Where no such move is left also to a neighbour of both at once (the thesis's outlook, sec. 7.1): along
  /// parallel edges, whose nodes are pairwise closest, nothing else leads on.
  BothNodes,
  /// As OneNode, and on fine grids, too, from neighbour to neighbour: no longer steps (the thesis's).
  OneNodeAlongEdges
};

}  // namespace concave_distance

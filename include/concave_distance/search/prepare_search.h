#pragma once

#include <cstddef>
#include <vector>

namespace concave_distance {

class BodyMesh;

/// Makes the missing parts that a search of these bodies needs, in parallel. Room for matrices is given in
/// this order, so that it does not depend on the threads.
void prepareSearch(const std::vector<const BodyMesh*>& bodies);

/// Makes a body's grid when that takes so long that the first search should not wait for it.
void prepareLargeGrid(const BodyMesh& body);

/// Says what has been made for the searches of a body.
struct SearchPreparation {
  std::size_t grid_nodes = 0;      ///< 0: no grid yet
  double max_edge_length = 0.0;    ///< of the grid, metres
  bool is_complete = false;        ///< grid and mesh metric
  bool is_metric_thinned = false;  ///< mesh distances are kept for a choice of the nodes
};
SearchPreparation searchPreparationOf(const BodyMesh& body);

}  // namespace concave_distance

#pragma once

#include <vector>

#include "concave_distance/mesh/surface_mesh.h"

namespace concave_distance::detail {

struct WeldedVertices {
  std::vector<Eigen::Vector3d> vertices;  ///< the first of each group, in the order of the input
  std::vector<NodeIndex> node_of_vertex;  ///< per input vertex
};

/// Gives vertices in the same place one number. In the order of the input, a vertex joins the nearest earlier
/// representative within `relative_tolerance` times the bounding box's diagonal, or becomes one: none moves
/// farther than that. 0 joins equal vertices only. Coordinates must be finite. O(n log n).
WeldedVertices weldVertices(const std::vector<Eigen::Vector3d>& vertices, double relative_tolerance);

}  // namespace concave_distance::detail

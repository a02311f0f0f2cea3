#pragma once

#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

struct WeldedVertices {
  std::vector<Eigen::Vector3d> vertices;  ///< the first of each group, in the order of the input
  std::vector<NodeIndex> node_of_vertex;  ///< per input vertex
};

/// Gives vertices in the same place one number. In the order of the input, a vertex joins the nearest earlier
/// representative within `tolerance` metres, or becomes one: none moves farther than that. 0 joins equal
/// vertices only. Coordinates must be finite. O(n log n).
WeldedVertices weldVertices(const std::vector<Eigen::Vector3d>& vertices, double tolerance);

struct BorderWeld {
  std::size_t joined_vertices = 0;  ///< no triangle uses them any more
  double farthest = 0.0;            ///< that one moved, metres
};

/// Joins vertices of border edges that lie within `tolerance` metres of each other; the others stay, so that
/// no detail within a surface collapses. Triangles with the same corners count as one. O(n log n).
BorderWeld weldBorders(const std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles,
                       double tolerance);

}  // namespace concave_distance::detail

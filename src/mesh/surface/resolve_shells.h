#pragma once

#include <vector>

#include "enclosure_solver.h"

namespace concave_distance::detail {

/// The role of every face of a surface in the union of the solids that it bounds.
struct ResolvedShells {
  FaceTable table;
  SurfaceUnits units;
  std::vector<FaceDecision> decisions;  ///< one per face
  std::vector<bool> unit_is_inward;     ///< mostly wound inside out in the file
};

/// Uses only windings and edges, and exact predicates where more than two faces meet at an edge
/// (doc/numerics.md, "Inside and outside"). O(n log n).
ResolvedShells resolveShells(const std::vector<Eigen::Vector3d>& vertices,
                             const std::vector<TriangleNodes>& triangles);

/// The shells of a surface: sets of triangles that bound a solid, connected by edges, and open ones,
/// connected by edges or corners.
struct ShellLabels {
  std::vector<std::uint32_t> shell_of_triangle;  ///< numbered by their first triangles
  std::vector<TriangleIndex> triangle_of_shell;  ///< the first of each
  /// Bounds a solid: not flat, and the windings balance along each of its edges.
  std::vector<bool> shell_is_closed;
};

/// @param edges those of the triangles
ShellLabels labelShells(const std::vector<Eigen::Vector3d>& vertices,
                        const std::vector<TriangleNodes>& triangles, const EdgeTable& edges);

}  // namespace concave_distance::detail

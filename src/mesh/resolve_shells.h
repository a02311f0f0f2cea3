#pragma once

#include <vector>

#include "unit_solver.h"

namespace concave_distance::detail {

/// What every face of a surface is to the union of the solids that it bounds.
struct ResolvedShells {
  FaceTable table;
  SurfaceUnits units;
  std::vector<FaceVerdict> verdicts;  ///< of each face
  std::vector<bool> unit_is_inward;   ///< wound inside out in the file, for the most part
};

/// Combinatorics of the windings and edges, with exact predicates where more than two faces meet at an edge
/// (doc/numerics.md, "Inside and outside"). O(n log n).
ResolvedShells resolveShells(const std::vector<Eigen::Vector3d>& vertices,
                             const std::vector<TriangleNodes>& triangles);

/// Which units bound a cavity: those that lie in the material of others and are wound the other way than the
/// outermost unit around them. All others bound material. Winding numbers: van Oosterom and Strackee 1983.
/// O(n) for each pair of units of which one's bounding box holds the other's.
std::vector<bool> findCavities(const std::vector<Eigen::Vector3d>& vertices, const ResolvedShells& resolved);

/// The shells of a surface: pieces connected by edges whose triangles bound a solid, and open ones, which
/// corners connect, too.
struct ShellLabels {
  std::vector<std::uint32_t> shell_of_triangle;  ///< numbered by their first triangles
  std::vector<TriangleIndex> triangle_of_shell;  ///< the first
  /// Bounds a solid: not flat, and the windings balance along each of its edges.
  std::vector<bool> shell_is_closed;
};

ShellLabels labelShells(const std::vector<Eigen::Vector3d>& vertices,
                        const std::vector<TriangleNodes>& triangles);

}  // namespace concave_distance::detail

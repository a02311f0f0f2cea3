#pragma once

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "mesh/surface/mesh_topology.h"
#include "triangle_tree.h"

namespace concave_distance {

/// Says how nearly convex a solid is. Where every ray from a centre inside crosses the surface once, the
/// surface and its convex hull are images of each other along these rays.
struct HullGap {
  /// Metres: no point of the surface is farther from the hull's along the ray through it. It holds in spite
  /// of rounding. Infinite for an open surface, where a ray may cross the surface more than once, and beyond
  /// kWidestHullGap.
  double gap = 0.0;

  std::size_t memoryBytes() const { return 0; }
};

/// A wider gap, as a share of the diameter, is not looked for: it would tell nothing of bodies that are near.
inline constexpr double kWidestHullGap = 0.05;

/// Measures a surface without making its hull: the hull lies below the plane of each triangle moved out to
/// the farthest vertex. O(n log n) for a nearly convex surface, O(n) for most others.
HullGap measureHullGap(const SurfaceMesh& mesh, const MeshTopology& topology, const TriangleTree& tree);

}  // namespace concave_distance

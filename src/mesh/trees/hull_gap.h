#pragma once

#include <limits>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "mesh/surface/mesh_topology.h"
#include "triangle_tree.h"

namespace concave_distance {

/// Says how nearly convex a solid is. Where every ray from a centre inside crosses the surface once, the
/// surface and its convex hull are images of each other along these rays.
struct HullGap {
  /// A triangle that lies deeper below the hull than `shallow`.
  struct Dent {
    TriangleIndex triangle;
    double gap;  ///< metres, along the rays through it
  };

  /// Metres: no point of the surface is farther from the hull's along the ray through it. It holds in spite
  /// of rounding. Infinite for an open surface, where a ray may cross the surface more than once, and beyond
  /// kWidestHullGap.
  double gap = std::numeric_limits<double>::infinity();
  /// Metres: the gap of every triangle that is no dent, and how far the surface reaches over the plane of
  /// every triangle that is not `behind`.
  double shallow = 0.0;
  /// By triangle: the surface reaches over its plane by more than `shallow`, or its plane is not known as
  /// well. Empty where that is so for a quarter of them.
  std::vector<bool> behind;
  std::vector<Dent> dents;  ///< empty with `behind`
};

/// A wider gap, as a share of the diameter, is not looked for: it would tell nothing of bodies that are near.
inline constexpr double kWidestHullGap = 0.05;

/// `shallow` as a share of the diameter: the noise of coordinates in single precision is less.
inline constexpr double kShallowGap = 1e-6;

/// Measures a surface without making its hull: the hull lies below the plane of each triangle moved out to
/// the farthest vertex. O(n log n) for a nearly convex surface, O(n) for most others.
HullGap measureHullGap(const SurfaceMesh& mesh, const MeshTopology& topology, const TriangleTree& tree);

}  // namespace concave_distance

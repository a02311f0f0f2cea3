#pragma once

#include <cstddef>
#include <limits>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "mesh/surface/mesh_topology.h"
#include "triangle_distance.h"
#include "witness_refinement.h"

namespace concave_distance::detail {

/// A triangle of a surface, in coordinates relative to `centre`.
struct LocalTriangle {
  const SurfaceMesh& mesh;
  const MeshTopology& topology;
  const Eigen::Vector3d& centre;
  TriangleIndex triangle;
};

/// A witness on that triangle and the vector from it to the other body's witness, same coordinates.
struct LocalWitness {
  Eigen::Vector3d point;
  Feature feature;
  Eigen::Vector3d to_other;
};

struct RingTolerances {
  double on_feature;   ///< metres; a point as near as this to an edge or vertex may lie on it
  double first_order;  ///< square metres; bound on to_other . (corner - point) that still counts as level
};

struct RingLook {
  TriangleIndex
      triangle;  ///< the one whose point is closest to the other witness; the own one if none is closer
  std::uint32_t opened = 0;
};

/// All triangles that hold the witness, its own first: across its edge, around its vertex, and all others
/// connected to them within the tolerance, for triangles as thin as rounding. Time is linear in the ring. At
/// most `largest` triangles and the rest of the last vertex or edge.
void collectRing(const LocalTriangle& own, const LocalWitness& witness, double on_feature,
                 RefinementWorkspace& workspace,
                 std::size_t largest = std::numeric_limits<std::size_t>::max());

/// Looks for a triangle around the witness that comes closer to the other witness. A triangle none of whose
/// corners lies beyond the plane through the point, across the direction to the other, cannot.
RingLook findCloserNeighbour(const LocalTriangle& own, const LocalWitness& witness,
                             const RingTolerances& tolerances, RefinementWorkspace& workspace);

}  // namespace concave_distance::detail

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "concave_distance/distance/witness.h"
#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance {

struct WitnessRefinement {
  WitnessPair witness;
  /// No triangle that touches either witness offers a closer point: a proven local minimum of |p - q| up to
  /// the stated tolerance. False only when `iterations` reached the limit.
  bool proven = false;
  std::uint32_t iterations = 0;        ///< triangle pair distances computed
  std::uint32_t triangles_opened = 0;  ///< triangles looked at by the proof
};

/// Buffers of one thread; cleared, never freed.
struct RefinementWorkspace {
  std::vector<TriangleIndex> ring;
  std::vector<NodeIndex> ring_vertices;
  std::vector<bool> ring_marks;  ///< the same by index, of large rings; false between calls
  std::vector<bool> vertex_marks;
};

/// Polishes a pair of original triangles to the exact local minimum of the distance around them.
/// Why the proof is cheap: (p, q) minimises |p - q| over the convex product tA x tB if and only if p is the
/// point of tA closest to q and q that of tB closest to p (the variational inequality of a product of convex
/// sets separates), so it is enough to look at the triangles around p and those around q one side at a time.
/// Terminates: every step strictly decreases the distance and the triangle pairs are finitely many.
/// Witnesses that touch (distance within the kernel's error of 0) end it at once, as one point at distance 0.
/// Error: that of triangleDistance in coordinates relative to the start triangles, once more for what the
/// proof lets pass, and the rounding of a_from_b's translation. a_from_b must be rigid to rounding.
WitnessRefinement refineWitness(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                TriangleIndex start_a, TriangleIndex start_b, RefinementWorkspace& workspace);

}  // namespace concave_distance

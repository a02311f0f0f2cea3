#include "witness_refinement.h"

#include <cmath>

#include "adjacent_triangles.h"
#include "pair_frame.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;

/// Far above any descent seen; only a broken surface could ask for more.
constexpr std::uint32_t kIterationLimit = 10000;

/// A triangle this many times thinner than what the proof resolves cannot show which way leads down across
/// it; what lies beyond it is looked at as if it touched the witness.
constexpr double kThinnest = 16.0;

}  // namespace

WitnessRefinement refineWitness(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                TriangleIndex start_a, TriangleIndex start_b,
                                RefinementWorkspace& workspace) {
  const detail::PairFrame frame(a, b, a_from_b, start_a, start_b);
  WitnessRefinement refinement;
  TriangleIndex triangle_a = start_a;
  TriangleIndex triangle_b = start_b;
  TrianglePoints corners_a = frame.cornersOfA(triangle_a);
  TrianglePoints corners_b = frame.cornersOfB(triangle_b);
  TrianglePairDistance closest = triangleDistance(corners_a, corners_b);
  refinement.iterations = 1;
  while (true) {
    const double largest = detail::largestMagnitude(corners_a, corners_b);
    const double distance = std::sqrt(closest.squared_distance);
    if (distance <= kTriangleDistanceError * largest) {  // they touch: no direction to look along
      closest.squared_distance = 0.0;
      closest.point_b = closest.point_a;
      refinement.proven = true;
      break;
    }
    const detail::RingTolerances tolerances{kThinnest * kTriangleDistanceError * largest,
                                            kTriangleDistanceError * largest * distance};
    const Vector3d direction = closest.point_b - closest.point_a;
    const detail::RingLook look_a =
        detail::findCloserNeighbour({a.surface(), a.topology(), frame.centre_a, triangle_a},
                                    {closest.point_a, closest.feature_a, direction}, tolerances, workspace);
    const detail::RingLook look_b = detail::findCloserNeighbour(
        {b.surface(), b.topology(), frame.centre_b, triangle_b},
        {frame.pointInB(closest.point_b), closest.feature_b, -(frame.rotation.transpose() * direction)},
        tolerances, workspace);
    refinement.triangles_opened += look_a.opened + look_b.opened;
    if (look_a.triangle == triangle_a && look_b.triangle == triangle_b) {
      refinement.proven = true;
      break;
    }
    if (refinement.iterations == kIterationLimit) break;
    // Both new triangles hold their old witness as well, so that the new pair is at least as close as the
    // better of the two one-sided finds.
    const TrianglePoints next_a = frame.cornersOfA(look_a.triangle);
    const TrianglePoints next_b = frame.cornersOfB(look_b.triangle);
    const TrianglePairDistance next = triangleDistance(next_a, next_b);
    ++refinement.iterations;
    if (!(next.squared_distance < closest.squared_distance)) {  // the find was a rounding
      refinement.proven = true;
      break;
    }
    closest = next;
    triangle_a = look_a.triangle;
    triangle_b = look_b.triangle;
    corners_a = next_a;
    corners_b = next_b;
  }
  refinement.witness = frame.toWitness(closest, triangle_a, triangle_b);
  return refinement;
}

}  // namespace concave_distance

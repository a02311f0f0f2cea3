#include "nearest_triangles.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "leaf_pair.h"

namespace concave_distance::detail {

using Eigen::Vector3d;
using Hierarchy = BoundingVolumeHierarchy;

void NearestTriangles::begin(const TrianglePair& start) {
  if (request_.far_enough < kInfinity) {
    measure(frame_.cornersOfA(start.a), frame_.cornersOfB(start.b), start.a, start.b);
    return;
  }
  const WitnessRefinement refined = frame_.refine(start.a, start.b, workspace_);
  cost_.triangle_pairs += refined.iterations;
  // Once more in the frame that everything else here is measured in.
  const TriangleIndex a = refined.witness.triangle_a;
  const TriangleIndex b = refined.witness.triangle_b;
  measure(frame_.cornersOfA(a), frame_.cornersOfB(b), a, b);
}

TrianglePairDistance NearestTriangles::measure(const TrianglePoints& a, const TrianglePoints& b,
                                               TriangleIndex triangle_a, TriangleIndex triangle_b) {
  TrianglePairDistance found = triangleDistance(a, b);
  ++cost_.triangle_pairs;
  if (!(found.squared_distance < squared_distance_)) return found;
  closest_ = found;
  triangle_a_ = triangle_a;
  triangle_b_ = triangle_b;
  distance_ = std::sqrt(found.squared_distance);
  if (distance_ <= kTriangleDistanceError * frame_.scale.scale) {
    // The kernel cannot tell it from touching.
    closest_.point_b = closest_.point_a;
    closest_.squared_distance = distance_ = 0.0;
  }
  squared_distance_ = closest_.squared_distance;
  if (distance_ > 0.0) {
    direction_ = (found.point_b - found.point_a) / distance_;
    ++direction_count_;
  }
  const double tolerance = request_.toleranceAt(distance_);
  enough_ = std::max(0.0, distance_ - std::max(tolerance, frame_.error));
  squared_enough_ = enough_ * enough_;
  return found;
}

double NearestTriangles::measureLeaves(const Hierarchy::Leaf& leaf_a, const Hierarchy::Leaf& leaf_b,
                                       bool tries_normals, Vector3d& parting) {
  ++cost_.leaf_pairs;
  const double slack = frame_.scale.slack;
  LeafLanes b(leaf_b, frame_.rotation, frame_.offset);
  const Lanes least = leastAlong(b, direction_);
  const Lanes most = mostAlong(leaf_a, direction_) + slack;
  const double together = least.minCoeff() - most.maxCoeff();
  parting = direction_;
  double parting_distance = kInfinity;
  if (together >= enough_) return together;
  b.computeNormals();
  if (tries_normals) {
    const double along_normals = separationAlongNormals(leaf_a, b, slack, enough_, parting);
    if (along_normals >= enough_) return along_normals;
  }
  // The direction between the last pair measured here parts its neighbours as well, as a rule.
  Lanes near_least = Lanes::Zero();
  Lanes near_most = Lanes::Zero();
  double bound = kInfinity;
  for (std::size_t i = 0; i < leaf_a.count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    Lanes separation = (least - most[row]).max(near_least - near_most[row]);
    if (separation.minCoeff() >= enough_) {
      bound = std::min(bound, separation.minCoeff());
      continue;
    }
    const TrianglePoints a = triangleOf(leaf_a, i);
    separation = separation.max(planeSeparation(a, b) - slack);
    for (std::uint32_t lane = 0; lane < leaf_b.count; ++lane) {
      if (separation[lane] < enough_) {
        const TrianglePairDistance found =
            measure(a, b.triangle(lane), leaf_a.triangle[i], leaf_b.triangle[lane]);
        const double distance = std::sqrt(found.squared_distance);
        if (!(distance > 0.0)) return 0.0;
        const Vector3d direction = (found.point_b - found.point_a) / distance;
        if (distance < parting_distance) {
          parting_distance = distance;
          parting = direction;
        }
        near_least = leastAlong(b, direction);
        near_most = mostAlong(leaf_a, direction) + slack;
        separation = separation.max(near_least - near_most[row]);
        separation[lane] = distance;
      }
      bound = std::min(bound, separation[lane]);
    }
  }
  return bound;
}

}  // namespace concave_distance::detail

#include "depth_probe.h"

#include <algorithm>
#include <cmath>

#include "distance/bound/closest_point.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance {

void DepthProbe::begin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  last_nearest_[0] = last_nearest_[1] = TriangleIndex{0};  // another pair may be at the last one's address
  body_[0] = &a;
  body_[1] = &b;
  a_from_b_ = a_from_b;
  b_from_a_ = a_from_b.inverse(Eigen::Isometry);
}

ProbedPoint DepthProbe::look(const OverlapFacet& facet, const Eigen::Vector3d& point) {
  const BodyMesh& body = other(facet);
  TriangleIndex& last_nearest = last_nearest_[facet.of_b ? 0 : 1];
  const Eigen::Vector3d target = inOther(facet, point);
  const SurfacePoint nearest = closestPoint(body, target, last_nearest);
  last_nearest = nearest.triangle;
  if (facet.may_leave && !containsPoint(body.tree(), body.surface(), body.topology().shell_is_closed,
                                        body.topology().shell_of_triangle, target)) {
    return {point, pushOf(facet), 0.0, nearest.triangle, true};
  }
  const double depth = std::sqrt(nearest.squared_distance);
  const Eigen::Vector3d surface = facet.of_b ? nearest.point : a_from_b_ * nearest.point;
  if (depth > deepest_.depth) deepest_ = {depth, point, surface, facet.of_b};
  if (!(depth > 0.0)) return {point, pushOf(facet), depth, nearest.triangle, false};
  const Eigen::Vector3d out = (surface - point) / depth;
  return {point, facet.of_b ? out : Eigen::Vector3d(-out), depth, nearest.triangle, false};
}

double DepthProbe::depthBound(const OverlapFacet& facet, const std::array<Eigen::Vector3d, 3>& corners,
                              TriangleIndex nearest) const {
  const TrianglePoints triangle = trianglePoints(other(facet).surface(), nearest);
  double farthest = 0.0;
  for (const Eigen::Vector3d& corner : corners) {
    farthest = std::max(farthest, pointTriangleDistance(inOther(facet, corner), triangle).squared_distance);
  }
  return std::sqrt(farthest);
}

}  // namespace concave_distance

#include "overlap_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "distance/closest_point.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance {
namespace {

// A facet of less than this share of the region's surface has one sample.
constexpr double kSmallShare = 1.0 / 512.0;
// A part this small a share of its facet is not halved again: 2^-kDeepest of its area.
constexpr std::uint32_t kDeepestLevel = 12;
// The greatest depth is looked for to this share, and in so many halvings.
constexpr double kDepthShare = 1e-3;
constexpr int kMostHalvings = 256;

Eigen::Vector3d middleOf(const Eigen::Vector3d& l, const Eigen::Vector3d& r) {
  return 0.5 * (l + r);
}

double areaOf(const std::array<Eigen::Vector3d, 3>& corners) {
  return 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
}

Eigen::Vector3d pushOf(const OverlapFacet& facet) {
  return facet.of_b ? Eigen::Vector3d(-facet.normal_in_a) : facet.normal_in_a;
}

// Both surfaces count half.
double weightOf(const OverlapFacet& facet) {
  return facet.is_negative ? -0.5 : 0.5;
}

}  // namespace

void OverlapSampler::begin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  if (body_[0] != &a || body_[1] != &b) last_nearest_[0] = last_nearest_[1] = TriangleIndex{0};
  body_[0] = &a;
  body_[1] = &b;
  a_from_b_ = a_from_b;
  b_from_a_ = a_from_b.inverse(Eigen::Isometry);
}

OverlapSampler::Corner OverlapSampler::look(const OverlapFacet& facet, const Eigen::Vector3d& point,
                                            DeepestPoint& deepest) {
  const std::size_t other = facet.of_b ? 0 : 1;
  const BodyMesh& body = *body_[other];
  const Eigen::Vector3d target = facet.of_b ? point : b_from_a_ * point;
  if (facet.may_leave && !containsPoint(body.tree(), body.surface(), body.topology().shell_is_closed,
                                        body.topology().shell_of_triangle, target)) {
    return {point, pushOf(facet), 0.0, last_nearest_[other]};
  }
  const SurfacePoint nearest = closestPoint(body, target, last_nearest_[other]);
  last_nearest_[other] = nearest.triangle;
  const double depth = std::sqrt(nearest.squared_distance);
  const Eigen::Vector3d surface = facet.of_b ? nearest.point : a_from_b_ * nearest.point;
  if (depth > deepest.depth) deepest = {depth, point, surface, facet.of_b};
  if (!(depth > 0.0)) return {point, pushOf(facet), depth, nearest.triangle};
  const Eigen::Vector3d out = (surface - point) / depth;
  return {point, facet.of_b ? out : Eigen::Vector3d(-out), depth, nearest.triangle};
}

OverlapSampler::Part OverlapSampler::wholeOf(const OverlapFacet& facet, DeepestPoint& deepest) {
  Part part;
  part.level = 0;
  for (std::size_t k = 0; k < 3; ++k) part.corners[k] = look(facet, facet.corners_in_a[k], deepest);
  for (std::size_t k = 0; k < 3; ++k) {
    part.middles[k] = look(facet, middleOf(facet.corners_in_a[k], facet.corners_in_a[(k + 1) % 3]), deepest);
  }
  return part;
}

void OverlapSampler::sample(const OverlapFacet* first, const OverlapFacet* last, double tolerance,
                            std::vector<OverlapSample>& samples, DeepestPoint& deepest) {
  deepest = {};
  double surface = 0.0;
  for (const OverlapFacet* facet = first; facet != last; ++facet) surface += areaOf(facet->corners_in_a);
  large_.clear();
  wholes_.clear();
  double integral = 0.0;
  for (const OverlapFacet* facet = first; facet != last; ++facet) {
    const double area = areaOf(facet->corners_in_a);
    if (area < kSmallShare * surface) {
      const Eigen::Vector3d centre =
          (facet->corners_in_a[0] + facet->corners_in_a[1] + facet->corners_in_a[2]) / 3.0;
      const Corner at = look(*facet, centre, deepest);
      samples.push_back({centre, pushOf(*facet), at.exit, weightOf(*facet) * area, at.depth});
      integral += area * at.depth;
      continue;
    }
    large_.push_back(static_cast<std::uint32_t>(facet - first));
    const Part& whole = wholes_.emplace_back(wholeOf(*facet, deepest));
    for (const Corner& middle : whole.middles) integral += area / 3.0 * middle.depth;
  }
  for (std::size_t i = 0; i < large_.size(); ++i) {
    integrate(first[large_[i]], wholes_[i], tolerance * integral, samples, deepest);
  }
  findDeepest(first, last, deepest);
}

// No point of a part is farther from the other surface than the farthest of its corners is from one triangle
// of it: the distance to a convex set is convex.
double OverlapSampler::depthBound(const OverlapFacet& facet, const Part& part) const {
  const BodyMesh& body = *body_[facet.of_b ? 0 : 1];
  double bound = std::numeric_limits<double>::infinity();
  for (const Corner& middle : part.middles) {
    const TrianglePoints triangle = trianglePoints(body.surface(), middle.nearest);
    double farthest = 0.0;
    for (const Corner& corner : part.corners) {
      const Eigen::Vector3d target = facet.of_b ? corner.point : b_from_a_ * corner.point;
      farthest = std::max(farthest, pointTriangleDistance(target, triangle).squared_distance);
    }
    bound = std::min(bound, farthest);
  }
  return std::sqrt(bound);
}

void OverlapSampler::findDeepest(const OverlapFacet* first, const OverlapFacet* last, DeepestPoint& deepest) {
  int halvings = 0;
  for (const OverlapFacet* facet = first; facet != last; ++facet) {
    // A point inside is no deeper than the shallowest corner and the way there.
    const Eigen::Vector3d centre =
        (facet->corners_in_a[0] + facet->corners_in_a[1] + facet->corners_in_a[2]) / 3.0;
    double reach = 0.0;
    for (const Eigen::Vector3d& corner : facet->corners_in_a)
      reach = std::max(reach, (corner - centre).norm());
    const double enough = (1.0 + kDepthShare) * deepest.depth;
    if (look(*facet, centre, deepest).depth + reach <= enough) continue;
    parts_.assign(1, wholeOf(*facet, deepest));
    while (!parts_.empty() && halvings < kMostHalvings) {
      const Part part = parts_.back();
      parts_.pop_back();
      if (part.level >= 2 * kDeepestLevel) continue;
      if (depthBound(*facet, part) <= (1.0 + kDepthShare) * deepest.depth) continue;
      ++halvings;
      halve(*facet, part, deepest);
    }
  }
}

void OverlapSampler::integrate(const OverlapFacet& facet, const Part& whole, double allowed,
                               std::vector<OverlapSample>& samples, DeepestPoint& deepest) {
  const double area = areaOf(facet.corners_in_a);
  parts_.assign(1, whole);
  while (!parts_.empty()) {
    const Part part = parts_.back();
    parts_.pop_back();
    double bend = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double linear = 0.5 * (part.corners[k].depth + part.corners[(k + 1) % 3].depth);
      bend = std::max(bend, std::abs(part.middles[k].depth - linear));
    }
    const double share = std::ldexp(1.0, -static_cast<int>(part.level));
    if (bend * area * share > allowed && part.level < kDeepestLevel) {
      halve(facet, part, deepest);
      continue;
    }
    for (const Corner& middle : part.middles) {
      samples.push_back(
          {middle.point, pushOf(facet), middle.exit, weightOf(facet) * area * share / 3.0, middle.depth});
    }
  }
}

// Across the longest edge, whose middle is known.
void OverlapSampler::halve(const OverlapFacet& facet, const Part& part, DeepestPoint& deepest) {
  std::size_t k = 0;
  double longest = -1.0;
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const double length = (part.corners[edge].point - part.corners[(edge + 1) % 3].point).squaredNorm();
    if (length > longest) {
      longest = length;
      k = edge;
    }
  }
  const Corner& from = part.corners[k];
  const Corner& to = part.corners[(k + 1) % 3];
  const Corner& tip = part.corners[(k + 2) % 3];
  const Corner& cut = part.middles[k];
  const Corner across = look(facet, middleOf(cut.point, tip.point), deepest);
  const Corner first = look(facet, middleOf(from.point, cut.point), deepest);
  const Corner second = look(facet, middleOf(cut.point, to.point), deepest);
  parts_.push_back({{from, cut, tip}, {first, across, part.middles[(k + 2) % 3]}, part.level + 1});
  parts_.push_back({{cut, to, tip}, {second, part.middles[(k + 1) % 3], across}, part.level + 1});
}

}  // namespace concave_distance

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
constexpr double kSmallShare = 1.0 / 128.0;
// A part this small a share of its facet is not halved again: 2^-kDeepest of its area.
constexpr std::uint32_t kDeepestLevel = 12;
// The greatest depth is looked for to this share.
constexpr double kDepthShare = 1e-6;
// The same where parts have to be halved to find it.
constexpr double kDepthShareOfHalving = 1e-2;

Eigen::Vector3d middleOf(const Eigen::Vector3d& l, const Eigen::Vector3d& r) {
  return 0.5 * (l + r);
}

double areaOf(const std::array<Eigen::Vector3d, 3>& corners) {
  return 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
}

Eigen::Vector3d centreOf(const std::array<Eigen::Vector3d, 3>& corners) {
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

double reachOf(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& centre) {
  double reach = 0.0;
  for (const Eigen::Vector3d& corner : corners) reach = std::max(reach, (corner - centre).norm());
  return reach;
}

Eigen::Vector3d pushOf(const OverlapFacet& facet) {
  return facet.of_b ? Eigen::Vector3d(-facet.normal_in_a) : facet.normal_in_a;
}

// Both surfaces count half.
double weightOf(const OverlapFacet& facet) {
  return facet.is_negative ? -0.5 : 0.5;
}

template <typename Part>
std::array<Eigen::Vector3d, 3> cornersOf(const Part& part) {
  return {part.corners[0].point, part.corners[1].point, part.corners[2].point};
}

/// By how much the depth in the middle of an edge differs from the mean of its ends.
template <typename Part>
double bendOf(const Part& part) {
  double bend = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double linear = 0.5 * (part.corners[k].depth + part.corners[(k + 1) % 3].depth);
    bend = std::max(bend, std::abs(part.middles[k].depth - linear));
  }
  return bend;
}

}  // namespace

void OverlapSampler::begin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  last_nearest_[0] = last_nearest_[1] = TriangleIndex{0};  // another pair may be at the last one's address
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

// The triangles of a fan share an edge with the one before.
OverlapSampler::Part OverlapSampler::wholeOf(const OverlapFacet& facet, const Part* before,
                                             DeepestPoint& deepest) {
  Part part;
  part.level = 0;
  const bool continues = before != nullptr && before->corners[0].point == facet.corners_in_a[0] &&
                         before->corners[2].point == facet.corners_in_a[1];
  if (continues) {
    part.corners = {before->corners[0], before->corners[2], look(facet, facet.corners_in_a[2], deepest)};
    part.middles[0] = before->middles[2];
  } else {
    for (std::size_t k = 0; k < 3; ++k) part.corners[k] = look(facet, facet.corners_in_a[k], deepest);
  }
  for (std::size_t k = continues ? 1 : 0; k < 3; ++k) {
    part.middles[k] = look(facet, middleOf(facet.corners_in_a[k], facet.corners_in_a[(k + 1) % 3]), deepest);
  }
  return part;
}

void OverlapSampler::sample(const OverlapFacet* first, const OverlapFacet* last, double tolerance,
                            std::vector<OverlapSample>& samples, DeepestPoint& deepest) {
  deepest = {};
  double surface = 0.0;
  for (const OverlapFacet* facet = first; facet != last; ++facet) surface += areaOf(facet->corners_in_a);
  small_.clear();
  large_.clear();
  wholes_.clear();
  double integral = 0.0;
  const OverlapFacet* last_whole = nullptr;
  for (const OverlapFacet* facet = first; facet != last; ++facet) {
    const double area = areaOf(facet->corners_in_a);
    const auto index = static_cast<std::uint32_t>(facet - first);
    if (area >= kSmallShare * surface) {
      large_.push_back(index);
      const bool same_triangle =
          facet != first && facet[-1].triangle == facet->triangle && facet[-1].of_b == facet->of_b;
      const Part* before = same_triangle && last_whole == facet - 1 ? &wholes_.back() : nullptr;
      wholes_.push_back(wholeOf(*facet, before, deepest));
      last_whole = facet;
      const Part& whole = wholes_.back();
      for (const Corner& middle : whole.middles) integral += area / 3.0 * middle.depth;
      continue;
    }
    const Eigen::Vector3d centre = centreOf(facet->corners_in_a);
    const Corner at = look(*facet, centre, deepest);
    samples.push_back({centre, pushOf(*facet), at.exit, weightOf(*facet) * area, at.depth});
    integral += area * at.depth;
    small_.push_back({index, at.nearest, at.depth + reachOf(facet->corners_in_a, centre)});
  }
  for (std::size_t i = 0; i < large_.size(); ++i) {
    integrate(first[large_[i]], wholes_[i], tolerance * integral, samples, deepest);
  }
  lookAtCorners(first, deepest);
}

void OverlapSampler::integrate(const OverlapFacet& facet, const Part& whole, double allowed,
                               std::vector<OverlapSample>& samples, DeepestPoint& deepest) {
  const double area = areaOf(facet.corners_in_a);
  planes_.begin(*body_[facet.of_b ? 0 : 1], facet.of_b ? Eigen::Isometry3d::Identity() : a_from_b_,
                facet.of_b);
  parts_.assign(1, whole);
  while (!parts_.empty()) {
    const Part part = parts_.back();
    parts_.pop_back();
    const double part_area = area * std::ldexp(1.0, -static_cast<int>(part.level));
    findPlanes(facet, part);
    const double worst = worstHeight(facet, part, deepest);
    const bool is_flat = worst * part_area <= allowed;
    const bool hides_depth =
        worst > kDepthShareOfHalving * deepest.depth && mayBeDeeper(facet, part, deepest);
    if (part.level < kDeepestLevel && (hides_depth || (!is_flat && bendOf(part) * part_area > allowed))) {
      halve(facet, part, deepest);
    } else if (is_flat) {
      addBelowPlanes(facet, part, samples, deepest);
    } else {
      addQuadratic(facet, part, samples);
    }
  }
}

void OverlapSampler::findPlanes(const OverlapFacet& facet, const Part& part) {
  planes_.clear();
  const auto add = [&](const Corner& corner) {
    const Eigen::Vector3d in_a = corner.point + (facet.of_b ? corner.depth : -corner.depth) * corner.exit;
    planes_.addAround(corner.nearest, facet.of_b ? in_a : b_from_a_ * in_a);
  };
  for (const Corner& corner : part.corners) add(corner);
  for (const Corner& middle : part.middles) add(middle);
}

// By how much the planes are wrong, at the points that are known and at the centre.
double OverlapSampler::worstHeight(const OverlapFacet& facet, const Part& part, DeepestPoint& deepest) {
  double worst = 0.0;
  const auto compare = [&](const Corner& at) {
    worst = std::max(worst, std::abs(planes_.leastDepth(at.point) - at.depth));
  };
  for (const Corner& corner : part.corners) compare(corner);
  for (const Corner& middle : part.middles) compare(middle);
  if (planes_.size() > 1) {
    compare(look(facet, centreOf(cornersOf(part)), deepest));
  }
  return worst;
}

void OverlapSampler::addBelowPlanes(const OverlapFacet& facet, const Part& part,
                                    std::vector<OverlapSample>& samples, DeepestPoint& deepest) {
  planes_.forEachPart(
      cornersOf(part), [&](const DepthPlane& plane, const std::vector<Eigen::Vector3d>& polygon) {
        for (const Eigen::Vector3d& corner : polygon) {
          if (plane.depth(corner) > (1.0 + kDepthShare) * deepest.depth) look(facet, corner, deepest);
        }
        for (std::size_t k = 2; k < polygon.size(); ++k) {
          const std::array<Eigen::Vector3d, 3> corners = {polygon[0], polygon[k - 1], polygon[k]};
          const double area = areaOf(corners);
          if (!(area > 0.0)) continue;
          for (std::size_t edge = 0; edge < 3; ++edge) {
            const Eigen::Vector3d middle = middleOf(corners[edge], corners[(edge + 1) % 3]);
            samples.push_back({middle, pushOf(facet), plane.exit, weightOf(facet) * area / 3.0,
                               std::max(0.0, plane.depth(middle))});
          }
        }
      });
}

void OverlapSampler::addQuadratic(const OverlapFacet& facet, const Part& part,
                                  std::vector<OverlapSample>& samples) const {
  const double area = areaOf(cornersOf(part));
  for (const Corner& middle : part.middles) {
    samples.push_back({middle.point, pushOf(facet), middle.exit, weightOf(facet) * area / 3.0, middle.depth});
  }
}

// No point of a triangle is farther from the other surface than the farthest of its corners is from one
// triangle of it: the distance to a convex set is convex.
double OverlapSampler::depthBound(const OverlapFacet& facet, const std::array<Eigen::Vector3d, 3>& corners,
                                  TriangleIndex nearest) const {
  const TrianglePoints triangle = trianglePoints(body_[facet.of_b ? 0 : 1]->surface(), nearest);
  double farthest = 0.0;
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d target = facet.of_b ? corner : b_from_a_ * corner;
    farthest = std::max(farthest, pointTriangleDistance(target, triangle).squared_distance);
  }
  return std::sqrt(farthest);
}

bool OverlapSampler::mayBeDeeper(const OverlapFacet& facet, const Part& part,
                                 const DeepestPoint& deepest) const {
  const std::array<Eigen::Vector3d, 3> corners = cornersOf(part);
  return std::all_of(part.middles.begin(), part.middles.end(), [&](const Corner& middle) {
    return depthBound(facet, corners, middle.nearest) > (1.0 + kDepthShareOfHalving) * deepest.depth;
  });
}

void OverlapSampler::lookAtCorners(const OverlapFacet* first, DeepestPoint& deepest) {
  for (const Candidate& candidate : small_) {
    const OverlapFacet& facet = first[candidate.facet];
    if (candidate.reachable <= (1.0 + kDepthShare) * deepest.depth) continue;
    if (depthBound(facet, facet.corners_in_a, candidate.nearest) <= (1.0 + kDepthShare) * deepest.depth)
      continue;
    for (const Eigen::Vector3d& corner : facet.corners_in_a) look(facet, corner, deepest);
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

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
// Planes whose normals differ by less are one, radians squared.
constexpr double kSameDirection = 1e-28;

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
  small_.clear();
  large_.clear();
  wholes_.clear();
  double integral = 0.0;
  for (const OverlapFacet* facet = first; facet != last; ++facet) {
    const double area = areaOf(facet->corners_in_a);
    const auto index = static_cast<std::uint32_t>(facet - first);
    if (area >= kSmallShare * surface) {
      large_.push_back(index);
      const Part& whole = wholes_.emplace_back(wholeOf(*facet, deepest));
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

void OverlapSampler::addPlane(const OverlapFacet& facet, TriangleIndex nearest) {
  const BodyMesh& body = *body_[facet.of_b ? 0 : 1];
  const Eigen::Vector3d& normal = body.topology().triangle_normals[nearest.value];
  const Eigen::Vector3d& corner = body.surface().corner(nearest, 0);
  Plane plane;
  plane.out = facet.of_b ? normal : Eigen::Vector3d(a_from_b_.linear() * normal);
  plane.exit = facet.of_b ? plane.out : Eigen::Vector3d(-plane.out);
  plane.offset = plane.out.dot(facet.of_b ? corner : Eigen::Vector3d(a_from_b_ * corner));
  const auto same = [&](const Plane& known) {
    return (known.out - plane.out).squaredNorm() < kSameDirection && known.offset == plane.offset;
  };
  if (std::none_of(planes_.begin(), planes_.end(), same)) planes_.push_back(plane);
}

void OverlapSampler::findPlanes(const OverlapFacet& facet, const Part& part) {
  planes_.clear();
  for (const Corner& corner : part.corners) addPlane(facet, corner.nearest);
  for (const Corner& middle : part.middles) addPlane(facet, middle.nearest);
}

double OverlapSampler::leastHeight(const Eigen::Vector3d& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes_) least = std::min(least, plane.depth(point));
  return std::max(0.0, least);
}

// By how much the planes are wrong, at the points that are known and at the centre.
double OverlapSampler::worstHeight(const OverlapFacet& facet, const Part& part, DeepestPoint& deepest) {
  double worst = 0.0;
  const auto compare = [&](const Corner& at) {
    worst = std::max(worst, std::abs(leastHeight(at.point) - at.depth));
  };
  for (const Corner& corner : part.corners) compare(corner);
  for (const Corner& middle : part.middles) compare(middle);
  if (planes_.size() > 1) {
    compare(
        look(facet, (part.corners[0].point + part.corners[1].point + part.corners[2].point) / 3.0, deepest));
  }
  return worst;
}

// Each plane has what it is the lowest over.
void OverlapSampler::addBelowPlanes(const OverlapFacet& facet, const Part& part,
                                    std::vector<OverlapSample>& samples, DeepestPoint& deepest) {
  for (const Plane& plane : planes_) {
    polygon_.assign({part.corners[0].point, part.corners[1].point, part.corners[2].point});
    for (const Plane& other : planes_) {
      if (&other != &plane) keepBelow(plane, other);
    }
    for (const Eigen::Vector3d& corner : polygon_) {
      if (plane.depth(corner) > (1.0 + kDepthShare) * deepest.depth) look(facet, corner, deepest);
    }
    for (std::size_t k = 2; k < polygon_.size(); ++k) {
      const std::array<Eigen::Vector3d, 3> corners = {polygon_[0], polygon_[k - 1], polygon_[k]};
      const double area = areaOf(corners);
      if (!(area > 0.0)) continue;
      for (std::size_t edge = 0; edge < 3; ++edge) {
        const Eigen::Vector3d middle = middleOf(corners[edge], corners[(edge + 1) % 3]);
        samples.push_back({middle, pushOf(facet), plane.exit, weightOf(facet) * area / 3.0,
                           std::max(0.0, plane.depth(middle))});
      }
    }
  }
}

// Cuts off the polygon where `other` is lower; where both are equal the first one keeps it.
void OverlapSampler::keepBelow(const Plane& plane, const Plane& other) {
  clipped_.clear();
  const auto height = [&](const Eigen::Vector3d& p) { return other.depth(p) - plane.depth(p); };
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const Eigen::Vector3d& from = polygon_[k];
    const Eigen::Vector3d& to = polygon_[(k + 1) % polygon_.size()];
    const double at_from = height(from);
    const double at_to = height(to);
    if (at_from >= 0.0) clipped_.push_back(from);
    if ((at_from > 0.0 && at_to < 0.0) || (at_from < 0.0 && at_to > 0.0)) {
      clipped_.push_back(from + at_from / (at_from - at_to) * (to - from));
    }
  }
  polygon_.swap(clipped_);
}

void OverlapSampler::addQuadratic(const OverlapFacet& facet, const Part& part,
                                  std::vector<OverlapSample>& samples) const {
  const double area = areaOf({part.corners[0].point, part.corners[1].point, part.corners[2].point});
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
  const std::array<Eigen::Vector3d, 3> corners = {part.corners[0].point, part.corners[1].point,
                                                  part.corners[2].point};
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

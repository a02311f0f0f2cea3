#include "depth_search.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/triangle_measures.h"

namespace concave_distance {
namespace {

// Depths that differ by less than this share of the greatest one are the same.
constexpr double kSameDepth = 1e-6;

template <typename Corners>
std::array<Eigen::Vector3d, 3> pointsOf(const Corners& corners) {
  return {corners[0].point, corners[1].point, corners[2].point};
}

}  // namespace

bool DepthSearch::isLess(const Part& l, const Part& r) {
  return std::tie(l.bound, r.facet) < std::tie(r.bound, l.facet);
}

void DepthSearch::push(const Part& part) {
  parts_.push_back(part);
  std::push_heap(parts_.begin(), parts_.end(), isLess);
}

void DepthSearch::add(const OverlapFacet* first, std::uint32_t facet, TriangleIndex nearest,
                      const DepthProbe& probe) {
  const std::array<Eigen::Vector3d, 3>& corners = first[facet].corners_in_a;
  Part part;
  part.bound = probe.depthBound(first[facet], corners, nearest);
  part.facet = facet;
  for (std::size_t k = 0; k < 3; ++k) part.corners[k] = {corners[k], corners[k], 0.0, nearest, false};
  push(part);
}

void DepthSearch::add(const OverlapFacet* first, std::uint32_t facet,
                      const std::array<ProbedPoint, 3>& corners, const DepthProbe& probe) {
  Part part;
  part.facet = facet;
  part.corners_are_known = true;
  for (std::size_t k = 0; k < 3; ++k) part.corners[k] = cornerOf(first[facet], corners[k], probe);
  tighten(first[facet], probe, part);
  push(part);
}

void DepthSearch::run(const OverlapFacet* first, double share, std::size_t largest_count, DepthProbe& probe) {
  for (std::size_t count = 0; count < largest_count && !parts_.empty(); ++count) {
    std::pop_heap(parts_.begin(), parts_.end(), isLess);
    Part part = parts_.back();
    parts_.pop_back();
    if (part.bound <= (1.0 + share) * probe.deepest().depth) return;
    split(first[part.facet], part, share, probe);
  }
}

void DepthSearch::split(const OverlapFacet& facet, Part part, double share, DepthProbe& probe) {
  const auto is_shallow = [&] { return part.bound <= (1.0 + share) * probe.deepest().depth; };
  if (!part.corners_are_known) {
    for (Corner& corner : part.corners) corner = cornerOf(facet, probe.look(facet, corner.point), probe);
    part.corners_are_known = true;
    tighten(facet, probe, part);
    if (is_shallow()) return;
  }
  const std::array<Eigen::Vector3d, 3> corners = pointsOf(part.corners);
  const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  const ProbedPoint at = probe.look(facet, middle);
  part.bound = std::min(part.bound, probe.depthBound(facet, corners, at.nearest));
  if (is_shallow()) return;
  planes_.begin(probe.other(facet), probe.aFromOther(facet), facet.of_b);
  planes_.add(at.nearest);
  if (areExplained(part, at, probe.deepest().depth)) return;
  planes_.addAround(at.nearest, probe.footInOther(facet, at));
  for (const Corner& corner : part.corners) planes_.addAround(corner.nearest, corner.foot);
  const double enough = (1.0 + share) * probe.deepest().depth;
  if (part.is_piece || !areExplained(part, at, probe.deepest().depth) || !cut(facet, part, enough, probe))
    halve(facet, part, share, probe);
}

// Returns whether the corners and the middle are as deep as below the planes.
bool DepthSearch::areExplained(const Part& part, const ProbedPoint& middle, double deepest) const {
  const auto is_explained = [&](const Eigen::Vector3d& point, double depth) {
    return std::abs(planes_.leastDepth(point) - depth) <= kSameDepth * deepest;
  };
  return is_explained(middle.point, middle.depth) &&
         std::all_of(part.corners.begin(), part.corners.end(),
                     [&](const Corner& corner) { return is_explained(corner.point, corner.depth); });
}

// Finds where the planes meet. Each piece is bounded by the triangle of the plane that is the lowest there.
bool DepthSearch::cut(const OverlapFacet& facet, const Part& part, double enough, const DepthProbe& probe) {
  int count = 0;
  planes_.forEachPart(pointsOf(part.corners),
                      [&](const DepthPlane&, const std::vector<Eigen::Vector3d>&) { ++count; });
  if (count < 2) return false;
  planes_.forEachPart(
      pointsOf(part.corners), [&](const DepthPlane& plane, const std::vector<Eigen::Vector3d>& polygon) {
        for (std::size_t k = 2; k < polygon.size(); ++k)
          addPiece(facet, part, {polygon[0], polygon[k - 1], polygon[k]}, plane.triangle, enough, probe);
      });
  return true;
}

void DepthSearch::addPiece(const OverlapFacet& facet, const Part& part,
                           const std::array<Eigen::Vector3d, 3>& corners, TriangleIndex nearest,
                           double enough, const DepthProbe& probe) {
  Part piece;
  piece.bound = std::min(part.bound, probe.depthBound(facet, corners, nearest));
  if (piece.bound <= enough) return;
  piece.facet = part.facet;
  piece.is_piece = true;
  for (std::size_t k = 0; k < 3; ++k) piece.corners[k] = {corners[k], corners[k], 0.0, nearest, false};
  push(piece);
}

DepthSearch::Corner DepthSearch::cornerOf(const OverlapFacet& facet, const ProbedPoint& at,
                                          const DepthProbe& probe) {
  return {at.point, probe.footInOther(facet, at), at.depth, at.nearest, at.is_outside};
}

void DepthSearch::tighten(const OverlapFacet& facet, const DepthProbe& probe, Part& part) {
  const std::array<Eigen::Vector3d, 3> corners = pointsOf(part.corners);
  for (const Corner& corner : part.corners) {
    part.bound = std::min(part.bound, probe.depthBound(facet, corners, corner.nearest));
    if (!corner.is_outside) continue;
    double farthest = 0.0;
    for (const Eigen::Vector3d& other : corners) farthest = std::max(farthest, (other - corner.point).norm());
    part.bound = std::min(part.bound, farthest);
  }
}

// Across the longest edge.
void DepthSearch::halve(const OverlapFacet& facet, const Part& part, double share, DepthProbe& probe) {
  const std::size_t k = longestEdge(pointsOf(part.corners));
  const std::size_t end = (k + 1) % 3;
  const Eigen::Vector3d between = 0.5 * (part.corners[k].point + part.corners[end].point);
  const Corner middle = cornerOf(facet, probe.look(facet, between), probe);
  for (const std::size_t replaced : {k, end}) {
    Part half = part;
    half.corners[replaced] = middle;
    half.is_piece = false;
    tighten(facet, probe, half);
    if (half.bound > (1.0 + share) * probe.deepest().depth) push(half);
  }
}

}  // namespace concave_distance

#include "deepest_place.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/triangle_measures.h"
#include "distance/bound/closest_point.h"

namespace concave_distance::detail {
namespace {

// Halved parts that are looked at for one region.
constexpr int kMostParts = 20000;
// A half begins with as many of the walls that it was bounded by.
constexpr std::uint32_t kInheritedWalls = 6;
// A point on a piece's border counts as in it when this share of the way to the middle of its part is.
constexpr double kOffBorder = 1e-6;

Eigen::Vector3d middleOf(const std::array<Eigen::Vector3d, 3>& corners) {
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

}  // namespace

void DeepestPlaceSearch::begin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                               double tolerance) {
  bodies_[0] = &a;
  bodies_[1] = &b;
  a_from_b_ = a_from_b;
  tolerance_ = tolerance;
  walls_[0].begin(a, 0.125 * tolerance);
  walls_[1].begin(b, 0.125 * tolerance);
  last_nearest_[0] = last_nearest_[1] = TriangleIndex{0};
}

DeepestPlace DeepestPlaceSearch::find(const OverlapFacet* first, const OverlapFacet* last, WorkLimit& limit) {
  facets_ = first;
  facet_count_ = static_cast<std::uint32_t>(last - first);
  parts_.clear();
  deepest_ = {};
  const auto is_lower = [](const Part& l, const Part& r) {
    return l.ceiling != r.ceiling ? l.ceiling < r.ceiling : l.facet > r.facet;
  };
  bool is_sure = true;
  for (std::uint32_t facet = 0; facet < facet_count_ && is_sure; ++facet) {
    if (first[facet].is_negative) continue;
    Part whole = partOf(facet);
    search(whole);
    is_sure = !limit.isOverNow();
  }
  std::make_heap(parts_.begin(), parts_.end(), is_lower);
  for (int count = 0; is_sure && !parts_.empty(); ++count) {
    std::pop_heap(parts_.begin(), parts_.end(), is_lower);
    Part part = parts_.back();
    parts_.pop_back();
    if (part.ceiling <= deepest_.depth + tolerance_) break;
    is_sure = count < kMostParts && !limit.isOverNow();
    const std::size_t known = parts_.size();
    search(part);
    for (std::size_t end = known; end < parts_.size(); ++end)
      std::push_heap(parts_.begin(), parts_.begin() + static_cast<std::ptrdiff_t>(end) + 1, is_lower);
  }
  DeepestPlace place = placeOf(deepest_);
  place.is_sure = is_sure;
  return place;
}

DeepestPlaceSearch::Part DeepestPlaceSearch::partOf(std::uint32_t facet) const {
  Part part;
  part.ceiling = std::numeric_limits<double>::infinity();
  part.facet = facet;
  part.wall_count = 1;
  part.walls[0] = last_nearest_[facets_[facet].of_b ? 0 : 1];
  const Eigen::Isometry3d holder_from_a = aFromHolder(facets_[facet]).inverse(Eigen::Isometry);
  for (std::size_t k = 0; k < 3; ++k) part.corners[k] = holder_from_a * facets_[facet].corners_in_a[k];
  return part;
}

void DeepestPlaceSearch::search(Part& part) {
  const OverlapFacet& facet = facets_[part.facet];
  const std::size_t side = facet.of_b ? 0 : 1;
  ceiling_.clear();
  for (std::uint32_t w = 0; w < part.wall_count; ++w)
    ceiling_.add(walls_[side].ceiling(part.corners, part.walls[w]));
  for (;;) {
    const LeastOfLinear::Peak peak = ceiling_.peak();
    part.ceiling = std::min(part.ceiling, peak.value);
    if (part.ceiling <= deepest_.depth + tolerance_) return;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) point += peak.weights[static_cast<Eigen::Index>(k)] * part.corners[k];
    const SurfacePoint nearest = closestPoint(holder(facet), point, last_nearest_[side]);
    last_nearest_[side] = nearest.triangle;
    const double depth = std::sqrt(nearest.squared_distance);
    const bool is_inside =
        !facet.may_leave || isInPiece(part.facet, point + kOffBorder * (middleOf(part.corners) - point));
    if (is_inside && depth > deepest_.depth) deepest_ = {depth, point, nearest.point, part.facet};
    if (part.ceiling <= deepest_.depth + tolerance_) return;
    if (!is_inside && isWhollyOutside(part)) return;
    const auto last = part.walls.begin() + part.wall_count;
    const bool is_known = std::find(part.walls.begin(), last, nearest.triangle) != last;
    if (is_known || part.wall_count == part.walls.size()) return halve(part);
    part.walls[part.wall_count++] = nearest.triangle;
    ceiling_.add(walls_[side].ceiling(part.corners, nearest.triangle));
  }
}

// Across the longest edge.
void DeepestPlaceSearch::halve(const Part& part) {
  const std::size_t k = longestEdge(part.corners);
  const std::size_t end = (k + 1) % 3;
  const Eigen::Vector3d between = 0.5 * (part.corners[k] + part.corners[end]);
  Part half = part;
  keepNearestWalls(half);
  for (const std::size_t replaced : {k, end}) {
    half.corners = part.corners;
    half.corners[replaced] = between;
    parts_.push_back(half);
  }
}

void DeepestPlaceSearch::keepNearestWalls(Part& part) {
  if (part.wall_count <= kInheritedWalls) return;
  std::array<std::size_t, LeastOfLinear::kMost> order{};
  for (std::size_t w = 0; w < part.wall_count; ++w) order[w] = w;
  std::sort(order.begin(), order.begin() + part.wall_count, [&](std::size_t l, std::size_t r) {
    const double at_l = ceiling_.inMiddle(l);
    const double at_r = ceiling_.inMiddle(r);
    return at_l != at_r ? at_l < at_r : l < r;
  });
  const auto walls = part.walls;
  for (std::uint32_t w = 0; w < kInheritedWalls; ++w) part.walls[w] = walls[order[w]];
  part.wall_count = kInheritedWalls;
}

// The winding number of the border of the triangle's part inside, which the facets' far edges are.
bool DeepestPlaceSearch::isInPiece(std::uint32_t facet, const Eigen::Vector3d& point) const {
  const OverlapFacet& own = facets_[facet];
  const Eigen::Vector3d in_a = aFromHolder(own) * point;
  const Eigen::Vector3d u = own.normal_in_a.unitOrthogonal();
  const Eigen::Vector3d v = own.normal_in_a.cross(u);
  const auto is_same = [&](std::uint32_t other) {
    return facets_[other].triangle == own.triangle && facets_[other].of_b == own.of_b;
  };
  std::uint32_t begin = facet;
  while (begin > 0 && is_same(begin - 1)) --begin;
  int winding = 0;
  for (std::uint32_t f = begin; f < facet_count_ && is_same(f); ++f) {
    const Eigen::Vector3d from = facets_[f].corners_in_a[1] - in_a;
    const Eigen::Vector3d to = facets_[f].corners_in_a[2] - in_a;
    const double low = from.dot(v);
    const double high = to.dot(v);
    if ((low <= 0.0) == (high <= 0.0)) continue;
    const double at = from.dot(u) * high - to.dot(u) * low;
    if (high > low && at > 0.0) ++winding;
    if (high < low && at < 0.0) --winding;
  }
  return winding > 0;
}

// No border of the piece, which lies on the other surface, runs through a part that is nearer than that.
bool DeepestPlaceSearch::isWhollyOutside(const Part& part) {
  const Eigen::Vector3d middle = middleOf(part.corners);
  if (isInPiece(part.facet, middle)) return false;
  double reach = 0.0;
  for (const Eigen::Vector3d& corner : part.corners) reach = std::max(reach, (corner - middle).norm());
  const OverlapFacet& facet = facets_[part.facet];
  const SurfacePoint nearest = closestPoint(holder(facet), middle, last_nearest_[facet.of_b ? 0 : 1]);
  return nearest.squared_distance > reach * reach;
}

DeepestPlace DeepestPlaceSearch::placeOf(const Deepest& deepest) {
  DeepestPlace place;
  if (!(deepest.depth > 0.0)) return place;
  const OverlapFacet& facet = facets_[deepest.facet];
  const Eigen::Isometry3d a_from_holder = aFromHolder(facet);
  const Eigen::Isometry3d a_from_own = facet.of_b ? a_from_b_ : Eigen::Isometry3d::Identity();
  place.depth = deepest.depth;
  place.inside_in_a = a_from_holder * deepest.inside;
  place.surface_in_a = a_from_holder * deepest.surface;
  place.inside_is_of_b = facet.of_b;
  const Eigen::Vector3d out =
      slope_.find({*bodies_[facet.of_b ? 1 : 0], a_from_own}, {holder(facet), a_from_holder},
                  place.inside_in_a, deepest.depth, 10.0 * tolerance_);
  // B takes its point further in, or its wall further away.
  place.slope_in_a = facet.of_b ? Eigen::Vector3d(-out) : out;
  return place;
}

}  // namespace concave_distance::detail

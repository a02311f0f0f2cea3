#include "clearance_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace concave_distance::detail {
namespace {

/// Moments nearer than this, relative to the larger one, are not told apart.
constexpr double kLeastSpan = 0x1.0p-46;

bool isInOneSegment(const MotionPaths& paths, double from, double to) {
  return to - static_cast<double>(momentAt(from, paths.segmentCount()).segment) <= 1.0;
}

/// Where two bounds that fall from the ends of a span meet: how far along, and what both say there.
struct Crossing {
  double along = 0.0;
  double lower = 0.0;
};

Crossing crossingByWay(double left, double right, double way) {
  double along = 0.5 * (left - right + way);
  along = std::isnan(along) ? 0.5 * way : std::clamp(along, 0.0, way);
  return {along, std::max(left - along, right - (way - along))};
}

// With the same acceleration on both sides the squares cancel: the equation is linear. Where both ends are
// seen from one body, each one's bound of the acceleration holds for the whole span.
Crossing crossingBySpeed(const ClearanceGap& gap, double length) {
  DisplacementBound from_left = gap.from_left;
  DisplacementBound from_right = gap.from_right;
  const auto [least, most] = std::minmax(gap.from_left.acceleration, gap.from_right.acceleration);
  from_left.acceleration = from_right.acceleration =
      from_left.is_from_a == from_right.is_from_a ? least : most;
  const double left = gap.left.lower;
  const double right = gap.right.lower;
  const double sum = from_left.speed + from_right.speed + from_left.acceleration * length;
  double along = (left - right + from_right.after(length)) / sum;
  along = std::isnan(along) ? 0.5 * length : std::clamp(along, 0.0, length);
  return {along, std::max(left - from_left.after(along), right - from_right.after(length - along))};
}

}  // namespace

bool ClearanceGap::isUndivided(double least_way) const {
  return way <= least_way || weakest <= left.moment || weakest >= right.moment ||
         right.moment - left.moment <= kLeastSpan * (1.0 + right.moment);
}

double splitAt(const MotionPaths& paths, double from, double to, double wanted) {
  if (isInOneSegment(paths, from, to)) return wanted;
  return std::clamp(std::round(wanted), std::floor(from) + 1.0, std::ceil(to) - 1.0);
}

ClearanceGap gapBetween(const MotionPaths& paths, const ClearancePair& pair, std::size_t index,
                        const ClearanceSample& left, const ClearanceSample& right,
                        ClearanceWorkspace& workspace) {
  ClearanceGap gap;
  gap.pair = index;
  gap.left = left;
  gap.right = right;
  const double length = right.moment - left.moment;
  MotionSpan& span = workspace.span;
  span.set(paths, pair.path, left.moment, right.moment);
  pair.path.evaluate(paths, span.momentOf(left.moment), workspace.other_pose);
  gap.from_left = span.from(workspace.other_pose, pair.a->corners, pair.b->corners);
  pair.path.evaluate(paths, span.momentOf(right.moment), workspace.other_pose);
  gap.from_right = span.from(workspace.other_pose, pair.a->corners, pair.b->corners);
  gap.way = std::min(gap.from_left.way, gap.from_right.way);
  const Crossing by_way = crossingByWay(left.lower, right.lower, gap.way);
  gap.lower = by_way.lower;
  double along = gap.way > 0.0 ? by_way.along / gap.way * length : 0.5 * length;
  if (span.isInOneSegment()) {
    gap.way = std::min({gap.way, gap.from_left.after(length), gap.from_right.after(length)});
    const Crossing by_speed = crossingBySpeed(gap, length);
    if (by_speed.lower > gap.lower) {
      gap.lower = by_speed.lower;
      along = by_speed.along;
    }
  }
  gap.weakest =
      splitAt(paths, left.moment, right.moment, std::clamp(left.moment + along, left.moment, right.moment));
  return gap;
}

std::optional<double> middleBelow(const MotionPaths& paths, const ClearanceGap& gap, double threshold) {
  if (gap.lower >= threshold) return std::nullopt;
  double from = gap.left.moment;
  double to = gap.right.moment;
  if (isInOneSegment(paths, from, to)) {
    from += gap.from_left.shareOf(gap.left.lower - threshold);
    to -= gap.from_right.shareOf(gap.right.lower - threshold);
    if (from > to) return std::nullopt;
  }
  return splitAt(paths, gap.left.moment, gap.right.moment, 0.5 * (from + to));
}

ClearanceSample sampleIn(const MotionPaths& paths, const ClearancePair& pair, const ClearanceGap& gap,
                         double moment, const SampleRequest& request, ClearanceWorkspace& workspace,
                         WorkLimit& limit) {
  std::array<TrianglePair, 2> starts{};
  std::size_t count = 0;
  const bool left_is_nearer = moment - gap.left.moment <= gap.right.moment - moment;
  for (const ClearanceSample* end :
       {left_is_nearer ? &gap.left : &gap.right, left_is_nearer ? &gap.right : &gap.left}) {
    if (!end->is_certified) continue;
    const bool is_same = count == 1 && starts[0].a == end->triangles.a && starts[0].b == end->triangles.b;
    if (!is_same) starts[count++] = end->triangles;
  }
  // Neither body can come inside the other while no point comes as far as its surface.
  const auto stays = [&](const ClearanceSample& end, const DisplacementBound& bound, double share) {
    const bool is_near = bound.way < end.lower || bound.after(share) < end.lower;
    return end.is_apart && end.lower > 0.0 && is_near;
  };
  const bool is_apart = stays(gap.left, gap.from_left, moment - gap.left.moment) ||
                        stays(gap.right, gap.from_right, gap.right.moment - moment);
  pair.path.evaluate(paths, momentAt(moment, paths.segmentCount()), workspace.pose);
  return sampleAt(pair, moment, request, starts.data(), count, is_apart, workspace, limit);
}

}  // namespace concave_distance::detail

#include "convex_pair.h"

#include "mesh/trees/hull_gap.h"

namespace concave_distance::detail {
namespace {

/// Solids whose gaps are within so many roundings of a distance are convex.
constexpr double kConvexGap = 64.0;

}  // namespace

ConvexNiches countConvexNiches(const PairFrame& frame, const NicheRule& rule, double certain_distance,
                               bool is_contained) {
  const double gap = frame.a.hullGap().gap + frame.b.hullGap().gap;
  if (certain_distance > 0.0) {
    const double rise = gap + 16.0 * frame.rounding + 2.0 * frame.pose_error;
    if (rise < rule.least_prominence * certain_distance) return ConvexNiches::OnlyTheNearest;
  }
  if (!(gap <= kConvexGap * frame.rounding)) return ConvexNiches::Unknown;
  return is_contained ? ConvexNiches::None : ConvexNiches::OnlyTheNearest;
}

bool areConvex(const BodyMesh& a, const BodyMesh& b) {
  const double least_size = 0.5 * (a.diameter() + b.diameter());
  return a.hullGap().gap + b.hullGap().gap <= kConvexGap * kTriangleDistanceError * least_size;
}

}  // namespace concave_distance::detail

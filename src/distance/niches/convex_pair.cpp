#include "convex_pair.h"

#include <algorithm>
#include <limits>

#include "mesh/trees/hull_gap.h"
#include "mesh/trees/ray_crossing.h"

namespace concave_distance::detail {
namespace {

/// Solids whose gaps are within so many roundings of a distance are convex.
constexpr double kConvexGap = 64.0;

/// How far a body and its dents reach beyond one of its points along a direction, metres.
struct Reach {
  double body = 0.0;
  double dents = -std::numeric_limits<double>::infinity();
};

/// @param point, direction in the body's frame; the direction is a unit vector
Reach reachBeyond(const BodyMesh& body, const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  Reach reach;
  const double here = direction.dot(point);
  const auto reaches = [&](const Eigen::AlignedBox3d& box) {
    return direction.dot(box.center()) + 0.5 * direction.cwiseAbs().dot(box.sizes()) - here > reach.body;
  };
  const auto height = [&](TriangleIndex t) {
    double most = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) most = std::max(most, direction.dot(body.surface().corner(t, k)) - here);
    return most;
  };
  visitLeaves(body.tree(), reaches, [&](TriangleIndex t) {
    reach.body = std::max(reach.body, height(t));
    return false;
  });
  for (const HullGap::Dent& dent : body.hullGap().dents) {
    reach.dents = std::max(reach.dents, height(dent.triangle) + dent.gap);
  }
  return reach;
}

/// Two features that support their bodies' hulls are the closest of the hulls, and are joined with the
/// nearest points over what lies between the hulls, unless a dent reaches there (doc/proofs.md).
bool dentsAreAway(const PairFrame& frame, double rise, const WitnessPair& nearest) {
  const HullGap& gap_a = frame.a.hullGap();
  const HullGap& gap_b = frame.b.hullGap();
  const double tie = 2.0 * (gap_a.shallow + gap_b.shallow) + rise;
  const Eigen::Vector3d direction = (nearest.point_b_in_a - nearest.point_a_in_a).normalized();
  const Reach of_a = reachBeyond(frame.a, nearest.point_a_in_a, direction);
  const Reach of_b =
      reachBeyond(frame.b, frame.bFromA() * nearest.point_b_in_a, -(frame.rotation.transpose() * direction));
  return of_a.dents < -(of_b.body + tie) && of_b.dents < -(of_a.body + tie);
}

}  // namespace

ConvexNiches countConvexNiches(const PairFrame& frame, const NicheRule& rule, double certain_distance,
                               bool is_contained, const WitnessPair* nearest) {
  const double gap = frame.a.hullGap().gap + frame.b.hullGap().gap;
  if (certain_distance > 0.0) {
    const double rounding = 16.0 * frame.rounding + 2.0 * frame.pose_error;
    const double least_rise = rule.leastRiseFrom(certain_distance);
    if (gap + rounding < least_rise) return ConvexNiches::OnlyTheNearest;
    const bool has_marks =
        nearest != nullptr && !frame.a.hullGap().behind.empty() && !frame.b.hullGap().behind.empty();
    const double shallow = frame.a.hullGap().shallow + frame.b.hullGap().shallow + rounding;
    if (has_marks && shallow < least_rise && dentsAreAway(frame, rounding, *nearest)) {
      return ConvexNiches::TheNearestAndDents;
    }
  }
  if (!(gap <= kConvexGap * frame.rounding)) return ConvexNiches::Unknown;
  return is_contained ? ConvexNiches::None : ConvexNiches::OnlyTheNearest;
}

bool areConvex(const BodyMesh& a, const BodyMesh& b) {
  const double least_size = 0.5 * (a.diameter() + b.diameter());
  return a.hullGap().gap + b.hullGap().gap <= kConvexGap * kTriangleDistanceError * least_size;
}

}  // namespace concave_distance::detail

#include "niche_places.h"

#include <algorithm>
#include <cmath>

#include "distance/niches/round_corners.h"

namespace concave_distance::detail {
namespace {

/// A place that is level within that, but not within rounding, has corners where it is longer than this
/// share: a shorter one moves a niche's points by so little, and small facets of a curved surface are always
/// level.
constexpr double kLeastShare = 0.05;
/// Triangle pairs, and triangles around their corners, that are looked at where the cycle has found a point,
/// or a segment or patch: at most 0.1 ms, or 1 ms.
constexpr std::size_t kPairLimitOfPoints = 256;
constexpr std::size_t kPairLimitOfSets = 4096;
constexpr std::size_t kRingLimitOfPoints = 2048;
constexpr std::size_t kRingLimitOfSets = 16'384;
/// The points of a niche are no place of their own where a corner is as near, to this share of the bodies.
constexpr double kSameDistance = 1e-12;

NichePlace placeOf(const TrackedNiche& niche) {
  const SignedPlace& in_overlap = niche.signed_place;
  // Where the bare bodies overlap, the gradient of the depth acts at its pivot.
  if (in_overlap.value <= 0.0)
    return {in_overlap.pivot_in_a, in_overlap.pivot_in_a, in_overlap.gradient_in_a, niche.signed_distance,
            false};
  NichePlace place{niche.point_a_in_a, niche.point_b_in_a, niche.normal_in_a, niche.signed_distance, false};
  if (std::isnan(place.value)) {
    place.value = 0.0;
    place.is_overlapping = true;
  }
  return place;
}

}  // namespace

const std::vector<NichePlace>& NichePlaces::of(const TrackedPair& pair, const TrackedNiche& niche) {
  places_.clear();
  const BodyMesh& a = *pair.body_a->mesh;
  const BodyMesh& b = *pair.body_b->mesh;
  const NichePlace own = placeOf(niche);
  std::size_t count = 0;
  CornerPairs corners;
  // Touching surfaces have no direction but the niche's.
  if (!own.is_overlapping && niche.witness.squared_distance > 0.0) {
    const double size = std::min(a.diameter(), b.diameter());
    const bool is_point = niche.kind == NicheKind::Point;
    const auto find = a.shape() != nullptr || b.shape() != nullptr ? findRoundCorners : findCorners;
    count = find(a, b, pair.solution.a_from_b, niche.witness, tilt_ * size,
                 is_point ? kLeastShare * size : 0.0, is_point ? kPairLimitOfPoints : kPairLimitOfSets,
                 is_point ? kRingLimitOfPoints : kRingLimitOfSets, workspace_, corners);
  }
  const TrackerParameters& parameters = pair.settings.tracker;
  const double bare = std::sqrt(niche.witness.squared_distance);
  bool needs_own = true;
  for (std::size_t i = 0; i < count; ++i) {
    const CornerPair& corner = corners[i];
    if (!(corner.distance > 0.0)) continue;
    const Eigen::Vector3d normal = (corner.point_b_in_a - corner.point_a_in_a) / corner.distance;
    places_.push_back({corner.point_a_in_a + parameters.margin_a * normal,
                       corner.point_b_in_a - parameters.margin_b * normal, normal,
                       corner.distance - parameters.margin(), false});
    if (corner.distance <= bare + kSameDistance * (a.diameter() + b.diameter())) needs_own = false;
  }
  if (needs_own) places_.push_back(own);
  return places_;
}

}  // namespace concave_distance::detail

#include "signed_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "distance/kernels/triangle_distance.h"
#include "interference/round_signed_distance.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance {
namespace {

using detail::PairFrame;

// Metres for a metre of the smaller body: how exact the greatest depth is.
constexpr double kTolerance = 2.5e-10;
constexpr std::size_t kNoRegion = std::numeric_limits<std::size_t>::max();

SignedPlace without(SignedState state) {
  SignedPlace place;
  place.state = state;
  return place;
}

SignedPlace ofDistance(const TrackedNiche& niche) {
  SignedPlace place;
  place.state = SignedState::Known;
  place.value = niche.distance;
  place.point_a_in_a = place.pivot_in_a = niche.point_a_in_a;
  place.point_b_in_a = niche.point_b_in_a;
  place.gradient_in_a = niche.normal_in_a;
  return place;
}

double toleranceOf(const PairFrame& frame) {
  return kTolerance * std::min(frame.a.diameter(), frame.b.diameter());
}

bool areRoundSolids(const PairFrame& frame) {
  return frame.a.shape() != nullptr && frame.b.shape() != nullptr;
}

bool areMeshes(const PairFrame& frame) {
  return frame.a.shape() == nullptr && frame.b.shape() == nullptr;
}

SignedPlace ofRoundPair(const PairFrame& frame) {
  const std::optional<detail::RoundSignedDistance> found =
      detail::roundSignedDistance(*frame.a.shape(), *frame.b.shape(), frame.a_from_b);
  if (!found) return without(SignedState::NoClosedForm);
  return {SignedState::Known,
          found->value,
          found->point_a_in_a,
          found->point_b_in_a,
          found->pivot_in_a,
          found->gradient_in_a,
          0};
}

}  // namespace

void SignedValues::update(const PairFrame& frame, const Cycle& cycle, PairSolution& solution,
                          WorkLimit& limit) {
  limit.allowShare(1.0);
  const bool overlaps = std::any_of(solution.niches.begin(), solution.niches.end(),
                                    [](const TrackedNiche& niche) { return !(niche.distance > 0.0); });
  if (overlaps && !areRoundSolids(frame)) findRegions(frame, limit);
  for (TrackedNiche& niche : solution.niches)
    niche.signed_place = niche.distance > 0.0 ? ofDistance(niche) : ofOverlap(frame, niche, limit);
  keepAges(cycle, 4.0 * toleranceOf(frame), solution);
}

void SignedValues::findRegions(const PairFrame& frame, WorkLimit& limit) {
  // A pair that stands still keeps its answer.
  if (has_regions_ && pose_.matrix() == frame.a_from_b.matrix()) return;
  if (workspace_ == nullptr) workspace_ = std::make_unique<InterferenceWorkspace>();
  findInterference(frame.a, frame.b, frame.a_from_b, *workspace_, overlap_, &limit);
  has_regions_ = overlap_.status == InterferenceStatus::Ok;
  pose_ = frame.a_from_b;
  values_.assign(overlap_.regions.size(), {});
  search_.begin(frame.a, frame.b, frame.a_from_b, toleranceOf(frame));
}

SignedPlace SignedValues::ofOverlap(const PairFrame& frame, const TrackedNiche& niche, WorkLimit& limit) {
  if (areRoundSolids(frame)) return ofRoundPair(frame);
  if (overlap_.status != InterferenceStatus::Ok) return without(SignedState::Unfinished);
  if (frame.hasJoints()) return without(SignedState::CrossedShells);
  const std::size_t r = regionAt(frame, niche);
  if (r != kNoRegion) {
    if (values_[r].state == SignedState::NotAsked) values_[r] = ofRegion(frame, overlap_.regions[r], limit);
    has_regions_ = has_regions_ && values_[r].state != SignedState::Unfinished;
    return values_[r];
  }
  const bool is_closed = frame.a.topology().isOnClosedShell(niche.witness.triangle_a) &&
                         frame.b.topology().isOnClosedShell(niche.witness.triangle_b);
  // The surfaces touch and enclose nothing.
  return is_closed ? ofDistance(niche) : without(SignedState::OpenSurface);
}

// The surfaces meet at the niche's points, on the border of its region.
std::size_t SignedValues::regionAt(const PairFrame& frame, const TrackedNiche& niche) const {
  const Eigen::Vector3d place = 0.5 * (niche.point_a_in_a + niche.point_b_in_a);
  const bool are_meshes = areMeshes(frame);
  double least = are_meshes ? 1e-7 * frame.diameters() : std::numeric_limits<double>::infinity();
  least *= least;
  std::size_t nearest = kNoRegion;
  const auto look = [&](const auto& is_asked) {
    for (std::size_t r = 0; r < overlap_.regions.size(); ++r) {
      const InterferenceRegion& region = overlap_.regions[r];
      for (std::uint32_t f = region.first_facet; f < region.first_facet + region.facet_count; ++f) {
        const OverlapFacet& facet = overlap_.facets[f];
        if (!is_asked(facet)) continue;
        const double squared = pointTriangleDistance(place, facet.corners_in_a).squared_distance;
        if (squared >= least) continue;
        least = squared;
        nearest = r;
      }
    }
  };
  if (are_meshes) {
    look([&](const OverlapFacet& facet) {
      return facet.triangle == (facet.of_b ? niche.witness.triangle_b : niche.witness.triangle_a);
    });
  }
  if (nearest == kNoRegion) look([](const OverlapFacet&) { return true; });
  return nearest;
}

SignedPlace SignedValues::ofRegion(const PairFrame& frame, const InterferenceRegion& region,
                                   WorkLimit& limit) {
  if (!region.consistent) return without(SignedState::CrossedShells);
  SignedPlace place;
  place.state = SignedState::Known;
  if (areMeshes(frame)) {
    const OverlapFacet* first = overlap_.facets.data() + region.first_facet;
    const detail::DeepestPlace deepest = search_.find(first, first + region.facet_count, limit);
    if (!deepest.is_sure) return without(SignedState::Unfinished);
    place.value = -deepest.depth;
    place.pivot_in_a = deepest.inside_in_a;
    place.point_a_in_a = deepest.inside_is_of_b ? deepest.surface_in_a : deepest.inside_in_a;
    place.point_b_in_a = deepest.inside_is_of_b ? deepest.inside_in_a : deepest.surface_in_a;
    place.gradient_in_a = -deepest.slope_in_a;
    return place;
  }
  const bool is_a = frame.a.shape() != nullptr;
  const bool has_closed_form = is_a ? detail::isCoreOutside(*frame.a.shape(), frame.b, frame.bFromA())
                                    : detail::isCoreOutside(*frame.b.shape(), frame.a, frame.a_from_b);
  if (!has_closed_form || !(region.depth >= 0.0)) return without(SignedState::NoClosedForm);
  place.value = -region.depth;
  place.point_a_in_a = place.pivot_in_a = region.point_a_in_a;
  place.point_b_in_a = region.point_b_in_a;
  place.gradient_in_a = region.depth > toleranceOf(frame)
                            ? Eigen::Vector3d((region.point_a_in_a - region.point_b_in_a) / region.depth)
                            : region.normal_in_a;
  return place;
}

void SignedValues::keepAges(const Cycle& cycle, double rounding, PairSolution& solution) {
  now_.clear();
  for (TrackedNiche& niche : solution.niches) {
    SignedPlace& place = niche.signed_place;
    place.since_cycle = cycle.number;
    if (place.state != SignedState::Known) continue;
    const auto known = std::find_if(before_.begin(), before_.end(),
                                    [&](const Known& before) { return before.id == niche.id; });
    if (known != before_.end() && std::abs(place.value - known->value) <= cycle.displacement + rounding)
      place.since_cycle = known->since_cycle;
    now_.push_back({niche.id, place.value, place.since_cycle});
  }
  before_.swap(now_);
}

}  // namespace concave_distance

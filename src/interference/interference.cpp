#include "concave_distance/interference/interference.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/refill.h"
#include "overlap_samples.h"
#include "region_builder.h"
#include "round_overlap.h"
#include "round_pair_overlap.h"

namespace concave_distance {

using detail::FoundRegion;

struct InterferenceWorkspace::Implementation {
  detail::RegionBuilder builder;
  std::vector<FoundRegion> solids;  ///< of the best pass so far
  std::vector<FoundRegion> others;  ///< what touches, and open surfaces
  std::vector<FoundRegion> found;
  std::vector<OverlapFacet> facets;  ///< of the solids
  std::vector<Eigen::Vector3d> loop_areas;
  OverlapSampler sampler;
  detail::RoundOverlap round;
};

InterferenceWorkspace::InterferenceWorkspace() : implementation_(std::make_unique<Implementation>()) {}
InterferenceWorkspace::~InterferenceWorkspace() = default;
InterferenceWorkspace::InterferenceWorkspace(InterferenceWorkspace&&) noexcept = default;
InterferenceWorkspace& InterferenceWorkspace::operator=(InterferenceWorkspace&&) noexcept = default;

namespace {

bool isPose(const Eigen::Isometry3d& pose) {
  if (!pose.matrix().allFinite() || pose.translation().cwiseAbs().maxCoeff() > kLargestCoordinate) {
    return false;
  }
  const Eigen::Matrix3d excess = pose.linear().transpose() * pose.linear() - Eigen::Matrix3d::Identity();
  return excess.cwiseAbs().maxCoeff() <= 1e-3 && pose.linear().determinant() > 0.0;
}

bool isSolid(const FoundRegion& found) {
  return found.region.closed && !found.region.touching;
}

/// Says how well a motion shows the solids of the overlap where things are flush: the more parts, the fewer
/// of them hang together by walls that only touch; the fewer flaps the better; and a body that is swallowed
/// but for a flush face has a loop.
struct Clarity {
  std::size_t parts = 0;
  double flap_area = 0.0;
  std::size_t swallowed = 0;

  bool better(const Clarity& than) const {
    if (parts != than.parts) return parts > than.parts;
    if (flap_area != than.flap_area) return flap_area < than.flap_area;
    return swallowed < than.swallowed;
  }
};

Clarity clarityOf(const std::vector<FoundRegion>& found) {
  Clarity clarity;
  for (const FoundRegion& f : found) {
    if (!isSolid(f)) continue;
    ++clarity.parts;
    clarity.flap_area += f.flap_area;
    clarity.swallowed += f.region.loop_count == 0 ? 1U : 0U;
  }
  return clarity;
}

void takeSolids(InterferenceWorkspace::Implementation& space) {
  space.solids.clear();
  for (const FoundRegion& f : space.found) {
    if (isSolid(f)) space.solids.push_back(f);
  }
  refill(space.facets, space.builder.facets());
  refill(space.loop_areas, space.builder.loopAreas());
}

void dropSurfaces(InterferenceRegion& region) {
  region.first_loop = region.first_facet = region.facet_count = 0;
}

/// Faces that touch do so after one of two opposite motions alone; curves of open surfaces are there after
/// both unless these only touch.
void addOthers(const std::vector<FoundRegion>& found, double rounding, std::vector<FoundRegion>& others) {
  const std::size_t known = others.size();
  for (const FoundRegion& f : found) {
    if (isSolid(f)) continue;
    const auto same = [&](const FoundRegion& other) {
      return !f.region.closed && !other.region.closed &&
             (other.region.centroid_in_a - f.region.centroid_in_a).norm() <= 16.0 * rounding;
    };
    const auto last = others.begin() + static_cast<std::ptrdiff_t>(known);
    if (!std::none_of(others.begin(), last, same)) continue;
    others.push_back(f);
    dropSurfaces(others.back().region);
  }
}

/// Finds the regions after one motion of B and, where anything coincides exactly, after its opposite; where
/// these differ or have flaps after the remaining six, for the solids alone.
void findRegions(InterferenceWorkspace::Implementation& space, WorkLimit& limit) {
  const double rounding = space.builder.frame().roundingBound();
  detail::Motion motion = {1, 1, 1};
  const bool tied = space.builder.pass(motion, space.found, limit);
  takeSolids(space);
  space.others.clear();
  addOthers(space.found, rounding, space.others);
  if (!tied) return;
  Clarity best = clarityOf(space.found);
  bool unclear = false;
  for (int octant = 1; octant < 8 && (octant == 1 || unclear); ++octant) {
    // The opposite first.
    const int bits = octant <= 1 ? 7 : octant - 1;
    for (std::size_t axis = 0; axis < 3; ++axis) motion[axis] = (bits >> axis & 1) != 0 ? -1 : 1;
    space.builder.pass(motion, space.found, limit);
    if (space.builder.wasCut()) return;
    const Clarity clarity = clarityOf(space.found);
    if (octant == 1) {
      addOthers(space.found, rounding, space.others);
      unclear = clarity.parts != best.parts || std::min(clarity.flap_area, best.flap_area) > 0.0;
    }
    if (!clarity.better(best)) continue;
    best = clarity;
    takeSolids(space);
  }
}

// Parts of a surface that hold less of the overlap than this share are not looked at more closely.
constexpr double kSampleTolerance = 1e-3;

void measureDepths(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                   InterferenceWorkspace::Implementation& space, Interference& result) {
  space.sampler.begin(a, b, a_from_b);
  for (FoundRegion& found : space.found) {
    InterferenceRegion& region = found.region;
    if (region.facet_count == 0) continue;
    const OverlapFacet* first = result.facets.data() + region.first_facet;
    region.first_sample = static_cast<std::uint32_t>(result.samples.size());
    const DeepestPoint deepest =
        space.sampler.sample(first, first + region.facet_count, kSampleTolerance, result.samples);
    region.sample_count = static_cast<std::uint32_t>(result.samples.size()) - region.first_sample;
    region.depth = deepest.depth;
    region.point_a_in_a = deepest.inside_is_of_b ? deepest.surface_in_a : deepest.inside_in_a;
    region.point_b_in_a = deepest.inside_is_of_b ? deepest.inside_in_a : deepest.surface_in_a;
  }
}

bool deeper(const InterferenceRegion& l, const InterferenceRegion& r) {
  const double depth_l = std::isnan(l.depth) ? -1.0 : l.depth;
  const double depth_r = std::isnan(r.depth) ? -1.0 : r.depth;
  if (depth_l != depth_r) return depth_l > depth_r;
  const Eigen::Vector3d& at_l = l.centroid_in_a;
  const Eigen::Vector3d& at_r = r.centroid_in_a;
  return std::lexicographical_compare(at_l.data(), at_l.data() + 3, at_r.data(), at_r.data() + 3);
}

/// Deepest first, and whether one body holds the other without a crossing.
void sortRegions(Interference& result) {
  std::sort(result.regions.begin(), result.regions.end(), deeper);
  bool surfaces_meet = false;
  for (const InterferenceRegion& region : result.regions) {
    surfaces_meet = surfaces_meet || !(region.a_swallowed || region.b_swallowed);
    result.a_inside_b = result.a_inside_b || region.a_swallowed;
    result.b_inside_a = result.b_inside_a || region.b_swallowed;
  }
  result.a_inside_b = result.a_inside_b && !surfaces_meet;
  result.b_inside_a = result.b_inside_a && !surfaces_meet;
}

}  // namespace

void findInterference(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                      InterferenceWorkspace& workspace, Interference& result, WorkLimit* limit,
                      const std::vector<KnownNormal>& known) {
  result.regions.clear();
  result.facets.clear();
  result.samples.clear();
  result.loop_areas_in_a.clear();
  result.a_inside_b = result.b_inside_a = false;
  result.rounding_bound = std::numeric_limits<double>::quiet_NaN();
  result.status = isPose(a_from_b) ? InterferenceStatus::Ok : InterferenceStatus::InvalidPose;
  if (result.status != InterferenceStatus::Ok) return;
  InterferenceWorkspace::Implementation& space = workspace.implementation();
  WorkLimit none;
  WorkLimit& work = limit != nullptr ? *limit : none;
  if ((a.shape() != nullptr) != (b.shape() != nullptr)) {
    result.rounding_bound = kProofError * proofScale(a, b, a_from_b);
    space.round.find(a, b, a_from_b, result, work);
    return sortRegions(result);
  }
  if (a.shape() != nullptr && b.shape() != nullptr) {
    result.rounding_bound = kProofError * proofScale(a, b, a_from_b);
    if (detail::findRoundPairOverlap(a, b, a_from_b, result)) return;
  }
  space.builder.findCandidates(a, b, a_from_b, known, work);
  result.rounding_bound = space.builder.frame().roundingBound();
  findRegions(space, work);
  if (space.builder.wasCut()) {
    result.status = InterferenceStatus::Cut;
    return;
  }
  space.found.clear();
  for (const std::vector<FoundRegion>* list : {&space.solids, &space.others}) {
    for (const FoundRegion& found : *list) space.found.push_back(found);
  }
  refill(result.facets, space.facets);
  refill(result.loop_areas_in_a, space.loop_areas);
  measureDepths(a, b, a_from_b, space, result);
  for (const FoundRegion& found : space.found) result.regions.push_back(found.region);
  sortRegions(result);
}

}  // namespace concave_distance

#include "concave_distance/interference/interference.h"

#include <algorithm>
#include <cmath>

#include "region_builder.h"

namespace concave_distance {

using detail::FoundRegion;

struct InterferenceWorkspace::Implementation {
  detail::RegionBuilder builder;
  std::vector<FoundRegion> first;
  std::vector<FoundRegion> second;
  std::vector<std::uint8_t> matched;
};

InterferenceWorkspace::InterferenceWorkspace() : implementation_(std::make_unique<Implementation>()) {}
InterferenceWorkspace::~InterferenceWorkspace() = default;
InterferenceWorkspace::InterferenceWorkspace(InterferenceWorkspace&&) noexcept = default;
InterferenceWorkspace& InterferenceWorkspace::operator=(InterferenceWorkspace&&) noexcept = default;

namespace {

bool isPose(const Eigen::Isometry3d& pose) {
  if (!pose.matrix().allFinite()) return false;
  const Eigen::Matrix3d excess = pose.linear().transpose() * pose.linear() - Eigen::Matrix3d::Identity();
  return excess.cwiseAbs().maxCoeff() <= 1e-3 && pose.linear().determinant() > 0.0;
}

/// Whether two passes' regions are the same solid: volume and first moment agree to rounding. Touching
/// surfaces have no volume to agree on, and meet in one pass only.
bool sameSolid(const InterferenceRegion& l, const InterferenceRegion& r, double rounding) {
  if (!l.closed || !r.closed || l.touching || r.touching) return false;
  const double volume = std::max(l.volume, r.volume);
  const double surface = l.surface_area_a + l.surface_area_b + r.surface_area_a + r.surface_area_b;
  const double tolerance = 1e-9 * volume + 4.0 * rounding * surface;
  return std::abs(l.volume - r.volume) <= tolerance &&
         volume * (l.centroid_in_a - r.centroid_in_a).norm() <= tolerance * std::sqrt(surface);
}

/// Faces of both bodies in one plane and facing one way belong to A's surface inside B after one motion and
/// to B's inside A after the other: half to each.
void average(const FoundRegion& first, FoundRegion& second, std::uint32_t index,
             detail::RegionBuilder& builder) {
  InterferenceRegion& region = second.region;
  region.surface_area_a = 0.5 * (region.surface_area_a + first.region.surface_area_a);
  region.surface_area_b = 0.5 * (region.surface_area_b + first.region.surface_area_b);
  region.consistent = region.consistent && first.region.consistent;
  second.vector_area = 0.5 * (second.vector_area + first.vector_area);
  builder.measureDepth(index, second.vector_area, region);
}

/// Joins two passes. The same solid in both becomes one region; of solids that hang together in one pass
/// only, by walls that just touch, the finer parts stay; what touches in one pass stays.
void joinPasses(std::vector<FoundRegion>& first, std::vector<FoundRegion>& second,
                std::vector<std::uint8_t>& matched, detail::RegionBuilder& builder) {
  const double rounding = builder.frame().roundingBound();
  matched.assign(first.size() + second.size(), 0);
  for (std::size_t j = 0; j < second.size(); ++j) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (matched[i] != 0 || !sameSolid(first[i].region, second[j].region, rounding)) continue;
      matched[i] = matched[first.size() + j] = 1;
      if (second[j].region.loop_count == 0) {
        second[j] = first[i];
      } else if (first[i].region.loop_count > 0) {
        average(first[i], second[j], static_cast<std::uint32_t>(j), builder);
      }
      break;
    }
  }
  const auto is_alone = [&](const FoundRegion& found, std::size_t mark) {
    return matched[mark] == 0 && found.region.closed && !found.region.touching;
  };
  std::size_t alone[2] = {0, 0};
  for (std::size_t i = 0; i < first.size(); ++i) alone[0] += is_alone(first[i], i) ? 1U : 0U;
  for (std::size_t j = 0; j < second.size(); ++j) alone[1] += is_alone(second[j], first.size() + j) ? 1U : 0U;
  const bool first_is_finer = alone[0] > alone[1];
  std::size_t kept = 0;
  for (std::size_t j = 0; j < second.size(); ++j) {
    if (is_alone(second[j], first.size() + j) && first_is_finer) continue;
    second[kept++] = second[j];
  }
  second.resize(kept);
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (matched[i] != 0 || (is_alone(first[i], i) && !first_is_finer)) continue;
    // A curve of open surfaces is there in both passes unless they only touch.
    const auto& region = first[i].region;
    const bool again = !region.closed && std::any_of(second.begin(), second.end(), [&](const FoundRegion& f) {
      return !f.region.closed && (f.region.centroid_in_a - region.centroid_in_a).norm() <= 16.0 * rounding;
    });
    if (!again) second.push_back(first[i]);
  }
}

bool deeper(const FoundRegion& l, const FoundRegion& r) {
  const double depth_l = std::isnan(l.region.depth) ? -1.0 : l.region.depth;
  const double depth_r = std::isnan(r.region.depth) ? -1.0 : r.region.depth;
  if (depth_l != depth_r) return depth_l > depth_r;
  const Eigen::Vector3d& at_l = l.region.centroid_in_a;
  const Eigen::Vector3d& at_r = r.region.centroid_in_a;
  return std::lexicographical_compare(at_l.data(), at_l.data() + 3, at_r.data(), at_r.data() + 3);
}

}  // namespace

void findInterference(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                      InterferenceWorkspace& workspace, Interference& result) {
  result.regions.clear();
  result.a_inside_b = result.b_inside_a = false;
  result.rounding_bound = std::numeric_limits<double>::quiet_NaN();
  result.status = isPose(a_from_b) ? InterferenceStatus::Ok : InterferenceStatus::InvalidPose;
  if (result.status != InterferenceStatus::Ok) return;
  InterferenceWorkspace::Implementation& space = workspace.implementation();
  space.builder.findCandidates(a, b, a_from_b);
  result.rounding_bound = space.builder.frame().roundingBound();
  if (space.builder.pass(1, space.second)) {
    space.first.swap(space.second);
    space.builder.pass(-1, space.second);
    joinPasses(space.first, space.second, space.matched, space.builder);
  }
  std::sort(space.second.begin(), space.second.end(), deeper);
  bool surfaces_meet = false;
  for (const FoundRegion& found : space.second) {
    result.regions.push_back(found.region);
    surfaces_meet = surfaces_meet || !(found.region.a_swallowed || found.region.b_swallowed);
    result.a_inside_b = result.a_inside_b || found.region.a_swallowed;
    result.b_inside_a = result.b_inside_a || found.region.b_swallowed;
  }
  result.a_inside_b = result.a_inside_b && !surfaces_meet;
  result.b_inside_a = result.b_inside_a && !surfaces_meet;
}

}  // namespace concave_distance

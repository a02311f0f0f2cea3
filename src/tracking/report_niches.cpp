#include <cmath>

#include "concave_distance/distance/niche_properties.h"
#include "tracker_state.h"

namespace concave_distance {
namespace {

// Triangle pairs that the extent of a niche is followed over at the most.
constexpr std::size_t kExtentPairLimit = 64;
// The archive holds this many times what is reported, for niches that come and go at the edge of the list.
constexpr std::size_t kArchiveFactor = 4;

}  // namespace

void TrackerState::report(double displacement, PairSolution& solution) {
  std::vector<NicheRecord>& records = archive.records();
  const std::size_t capacity = kArchiveFactor * parameters.largest_niche_count;
  while (records.size() > capacity) {
    archive.remove(records.size() - 1, solution.events);
    solution.niches_cut = true;
  }
  for (NicheRecord& record : records) {
    if (record.niche.distance > parameters.cutoff) {
      ++solution.niches_beyond_cutoff;
      continue;
    }
    if (solution.niches.size() == parameters.largest_niche_count) {
      solution.niches_cut = true;
      continue;
    }
    if (!record.reported) {
      solution.events.push_back({NicheEvent::Kind::Birth, record.niche.id, 0});
      record.reported = true;
    }
    if (parameters.niches_wanted) {
      describe(record.niche);
    }
    solution.niches.push_back(record.niche);
  }
  if (!records.empty()) {
    const TrackedNiche& nearest = records.front().niche;
    solution.distance = nearest.distance;
    solution.point_a_in_a = nearest.point_a_in_a;
    solution.point_b_in_a = nearest.point_b_in_a;
    solution.status = nearest.distance == 0.0 ? SolveStatus::Penetrating : SolveStatus::Ok;
  }
  // A segment that leaves a closed body inwards and meets no surface ends in that body's material: swallowed.
  // Only the closest pair can be so without a closer crossing of the surfaces.
  if (dark_side_met && (records.empty() || std::sqrt(dark_side.squared_distance) < solution.distance) &&
      isVisible(*geometry.a, *geometry.b, geometry.a_from_b, dark_side)) {
    solution.status = SolveStatus::Penetrating;
    solution.surface_distance = std::sqrt(dark_side.squared_distance);
    solution.distance = 0.0;
    solution.point_a_in_a = dark_side.point_a_in_a;
    solution.point_b_in_a = dark_side.point_b_in_a;
  }
  const double rounding = 1e-9 * geometry.scale();
  solution.search_miss = warm && solution.distance < last_distance - displacement - rounding;
}

void TrackerState::describe(TrackedNiche& niche) {
  if (parameters.accuracy == AccuracyLevel::Nodes) {
    return;
  }
  const double tolerance = 1e-9 * geometry.scale();
  const NicheExtent extent = measureExtent(*geometry.a, *geometry.b, geometry.a_from_b, niche.witness,
                                           tolerance, kExtentPairLimit, geometry.extent);
  niche.kind = extent.kind;
  niche.extent = extent.length;
  if (extent.kind != NicheKind::Point) {
    niche.point_a_in_a = extent.representative.point_a_in_a;
    niche.point_b_in_a = extent.representative.point_b_in_a;
  }
  niche.visible = isVisible(*geometry.a, *geometry.b, geometry.a_from_b, niche.witness);
}

}  // namespace concave_distance

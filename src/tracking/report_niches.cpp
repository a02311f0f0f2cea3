#include <algorithm>
#include <cmath>
#include <limits>

#include "distance/niche_properties.h"
#include "distance/solid_overlap.h"
#include "tracker_state.h"

namespace concave_distance {
namespace {

// Triangle pairs that the extent of a niche is followed over, at most.
constexpr std::size_t kExtentPairLimit = 256;
// The archive holds half as many niches more than are reported, for those that come and go at the edge of the
// list.
constexpr std::size_t archiveCapacity(std::size_t reported) {
  return reported + (reported + 1) / 2;
}

}  // namespace

void TrackerState::describeNiches(PairSolution& solution) {
  if (parameters.accuracy == AccuracyLevel::Nodes || !parameters.niches_wanted) {
    return;
  }
  std::vector<NicheRecord>& records = archive.records();
  for (std::size_t i = 0; i < std::min<std::size_t>(records.size(), parameters.largest_niche_count);) {
    if (records[i].described == cycle + 1 || records[i].niche.distance > parameters.cutoff) {
      ++i;
      continue;
    }
    if (limit.isOver()) return;
    const bool known = cycles_at_rest > 0 && records[i].described == cycle;
    records[i].described = cycle + 1;
    if (known) {
      ++i;
      continue;
    }
    describe(records[i].niche);
    i = uniteOnPlateau(i, solution.events) ? 0 : i + 1;
  }
}

// A plateau is one niche wherever its witnesses were found. True when others were united with record i.
bool TrackerState::uniteOnPlateau(std::size_t i, std::vector<NicheEvent>& events) {
  std::vector<NicheRecord>& records = archive.records();
  if (records[i].niche.kind == NicheKind::Point) {
    return false;
  }
  const double reach = 2.0 * kPlateauTolerance * geometry.scale();
  for (std::size_t k = 0; k < records.size(); ++k) {
    // One at a time: a witness at the rim of the set is known to belong to it only when looked at from there.
    if (k != i && std::abs(records[k].niche.distance - records[i].niche.distance) <= reach &&
        isOnMeasuredSet(geometry.extent, records[k].niche.witness)) {
      archive.unite(std::min(i, k), std::max(i, k), events);
      archive.settle();
      return true;
    }
  }
  return false;
}

void TrackerState::listNiches(PairSolution& solution) {
  std::vector<NicheRecord>& records = archive.records();
  const std::size_t capacity = archiveCapacity(parameters.largest_niche_count);
  while (records.size() > capacity) {
    archive.remove(records.size() - 1, solution.events);
    solution.niches_cut = true;
  }
  if (!records.empty()) {
    records.front().niche.prominence = std::numeric_limits<double>::infinity();
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
    if (&record != &records.front() && std::isinf(record.niche.prominence)) {
      record.niche.prominence = kNotComputed;  // it was the deepest
    }
    if (!record.reported) {
      solution.events.push_back({NicheEvent::Kind::Birth, record.niche.id, 0});
      record.reported = true;
    }
    solution.niches.push_back(record.niche);
  }
}

// After the limit the answer is incomplete, even with a finished proof.
void TrackerState::reportLimit(PairSolution& solution) const {
  if (!limit.hasRefused()) {
    solution.niches_complete =
        parameters.accuracy == AccuracyLevel::Complete && parameters.niches_wanted && !solution.niches_cut;
    return;
  }
  if (solution.accuracy == AccuracyLevel::Complete) solution.accuracy = AccuracyLevel::Certified;
  if (solution.status == SolveStatus::Penetrating) return;
  solution.status = limit.hasRefusedTime() ? SolveStatus::BudgetExhausted : SolveStatus::MemoryExhausted;
}

void TrackerState::reportNearest(double displacement, PairSolution& solution) {
  const std::vector<NicheRecord>& records = archive.records();
  if (!records.empty()) {
    const TrackedNiche& nearest = records.front().niche;
    solution.distance = nearest.distance;
    solution.point_a_in_a = nearest.point_a_in_a;
    solution.point_b_in_a = nearest.point_b_in_a;
    if (nearest.distance == 0.0) {
      solution.status = SolveStatus::Penetrating;
      solution.meeting_triangles = TrianglePair{nearest.witness.triangle_a, nearest.witness.triangle_b};
    }
  }
  if (records.empty() && inward_witness_met && limit.hasRefused()) {
    // Not a niche, but still a bound of the distance: there was no time to find another.
    solution.distance = std::sqrt(inward_witness.squared_distance);
    solution.point_a_in_a = inward_witness.point_a_in_a;
    solution.point_b_in_a = inward_witness.point_b_in_a;
  }
  // A segment that leaves a closed body inwards and meets no surface also ends in its material. Only the
  // closest pair can do that without a closer crossing of the surfaces.
  const bool inward_nearest =
      inward_witness_met &&
      (records.empty() || std::sqrt(inward_witness.squared_distance) < solution.distance);
  const bool overlap =
      solution.status != SolveStatus::Penetrating &&
      (isContained(*geometry.a, *geometry.b, geometry.a_from_b, limit).value_or(false) ||
       (inward_nearest && isVisible(*geometry.a, *geometry.b, geometry.a_from_b, inward_witness)));
  swallowed = overlap && inward_nearest;
  if (overlap) {
    if (swallowed) {
      solution.distance = std::sqrt(inward_witness.squared_distance);
      solution.point_a_in_a = inward_witness.point_a_in_a;
      solution.point_b_in_a = inward_witness.point_b_in_a;
    }
    solution.status = SolveStatus::Penetrating;
    solution.surface_distance = solution.distance;
    solution.distance = 0.0;
  }
  const double rounding = 1e-9 * geometry.scale();
  solution.search_miss = warm && solution.distance < last_distance - displacement - rounding;
}

void TrackerState::describe(TrackedNiche& niche) {
  const double tolerance = kPlateauTolerance * geometry.scale();
  const NicheExtent extent = measureExtent(*geometry.a, *geometry.b, geometry.a_from_b, niche.witness,
                                           tolerance, kExtentPairLimit, geometry.extent, &limit);
  niche.kind = extent.kind;
  niche.extent = extent.length;
  if (extent.kind != NicheKind::Point) {
    niche.point_a_in_a = extent.representative.point_a_in_a;
    niche.point_b_in_a = extent.representative.point_b_in_a;
  }
  niche.visible = isVisible(*geometry.a, *geometry.b, geometry.a_from_b, niche.witness);
}

}  // namespace concave_distance

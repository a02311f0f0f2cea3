#include <algorithm>
#include <cmath>

#include "concave_distance/search/local_descent.h"
#include "concave_distance/tracking/niche_admission.h"
#include "concave_distance/tracking/node_niches.h"
#include "tracker_state.h"

namespace concave_distance {
namespace {

// Warm cycles from one look at a record's prominence to the next record's, in turn.
constexpr std::uint64_t kReviewInterval = 2;
// States a flood looks at, at the most, before a newborn niche counts as one.
constexpr std::uint32_t kColdFloodStates = 4000;
constexpr std::uint32_t kWarmFloodStates = 400;
// Floods from one newborn niche at the most, each from where the last one has led.
constexpr int kFloodsPerNewborn = 4;
// Cycles for which the outcome of a flood is believed without a new one.
constexpr std::uint64_t kDrownedCycles = 16;

}  // namespace

void TrackerState::settleCandidates(PairSolution& solution) {
  orderCandidates();
  admitCandidates(solution.events);
  archive.settle();
  candidates.clear();
}

void TrackerState::orderCandidates() {
  std::sort(candidates.begin(), candidates.end(), [](const NicheCandidate& l, const NicheCandidate& r) {
    return l.witness.squared_distance != r.witness.squared_distance
               ? l.witness.squared_distance < r.witness.squared_distance
               : l.node_pair < r.node_pair;
  });
}

void TrackerState::admitCandidates(std::vector<NicheEvent>& events) {
  const double niche_radius = warm ? warm_radii.niche : cold_radii.niche;
  for (const NicheCandidate& candidate : candidates) {
    AdmissionResult result{Admission::SamePlace, 0};
    if (parameters.accuracy == AccuracyLevel::Nodes) {
      result = admitNodePair(candidate, geometry, niche_radius, cycle, search.metric, archive);
    } else {
      result = verdictOnRipple(candidate);
      if (result.id == 0) {
        result = admitCandidate(candidate, geometry, parameters, niche_radius, cycle, archive, events);
        if (result.outcome == Admission::LowProminence && !isOnPlateauOf(candidate, result.id)) {
          ripples.remember(geometry, candidate.witness, result.id, cycle);
        }
      }
    }
    if (result.outcome == Admission::ThroughMaterial &&
        (!dark_side_met || candidate.witness.squared_distance < dark_side.squared_distance)) {
      dark_side = candidate.witness;
      dark_side_met = true;
    }
    if (candidate.left_by != 0) {
      const bool joined =
          result.outcome == Admission::SamePlace || result.outcome == Admission::LowProminence;
      events.push_back(joined ? NicheEvent{NicheEvent::Kind::Merge, candidate.left_by, result.id}
                              : NicheEvent{NicheEvent::Kind::Death, candidate.left_by, 0});
    }
  }
}

void TrackerState::reviewRecords(PairSolution& solution) {
  // A cold cycle looks at every record, once all are known: neighbours may have come in any order.
  const std::size_t reviews = warm ? cycle % kReviewInterval == 0 : archive.records().size();
  for (std::size_t k = 0; k < reviews && !archive.records().empty(); ++k) {
    next_review = (next_review + archive.records().size() - 1) % archive.records().size();
    if (reviewProminence(next_review, geometry, parameters, archive, solution.events)) {
      archive.settle();
    }
  }
}

// At the niche's own distance: another place of a plateau, from where refinement finds its lowest end by
// itself.
bool TrackerState::isOnPlateauOf(const NicheCandidate& candidate, std::uint64_t id) const {
  const auto& records = archive.records();
  const auto niche =
      std::find_if(records.begin(), records.end(), [&](const NicheRecord& r) { return r.niche.id == id; });
  return niche != records.end() && std::sqrt(candidate.witness.squared_distance) <=
                                       niche->niche.distance + 2.0 * kPlateauTolerance * geometry.scale();
}

// A ripple judged a few cycles ago is believed to be one still, unless it has become the deepest of its
// niche.
AdmissionResult TrackerState::verdictOnRipple(const NicheCandidate& candidate) {
  const Ripple* ripple = ripples.find(geometry, candidate.witness);
  if (ripple == nullptr || ripple->judged + kRippleJudgement <= cycle) {
    return {Admission::LowProminence, 0};
  }
  for (const NicheRecord& record : archive.records()) {
    if (record.niche.id == ripple->owner) {
      const bool deepest = candidate.witness.squared_distance < record.niche.witness.squared_distance;
      return {Admission::LowProminence, deepest ? 0 : ripple->owner};
    }
  }
  return {Admission::LowProminence, 0};
}

// Whether a flood of the grid from a niche's node pair, below its least prominence, leads to a place that is
// closer on the triangles too. What is deeper for the grid only is where the flood goes on from. Appends that
// place.
bool TrackerState::leadsDown(const PairObjective& objective, const TrialPoint& start,
                             const TrackedNiche& niche, PairSolution& solution) {
  const std::uint32_t state_limit = warm ? kWarmFloodStates : kColdFloodStates;
  const auto closer_than = [&](const TrialPoint& end) {
    const WitnessRefinement refined =
        geometry.refine(geometry.a->originalTriangle(end.node_a), geometry.b->originalTriangle(end.node_b));
    if (!(std::sqrt(refined.witness.squared_distance) < niche.distance - geometry.samePlaceTolerance())) {
      return false;
    }
    candidates.push_back({refined.witness, end, refined.proven, 0});
    drowned.push_back({start, cycle});
    return true;
  };
  const TrialPoint corner = geometry.nodePairNear(niche.witness);
  if (std::sqrt(corner.squared_distance) <= (1.0 + parameters.least_prominence) * niche.distance &&
      closer_than(descend(objective, corner, nullptr, search.trail, solution.cost))) {
    return true;
  }
  const double level = (1.0 + parameters.least_prominence) * std::sqrt(start.squared_distance);
  TrialPoint from = start;
  for (int flooded = 0; flooded < kFloodsPerNewborn; ++flooded) {
    const auto deeper = floodForDeeper(objective, from, level, 0.0, state_limit, flood, solution.cost);
    if (!deeper) {
      return false;
    }
    from = descend(objective, *deeper, nullptr, search.trail, solution.cost);
    if (closer_than(from)) {
      return true;
    }
  }
  return false;
}

// A newborn niche that a flood of the grid leads out of below the least prominence is part of what it leads
// to.
void TrackerState::drownNewborns(const PairObjective& objective, PairSolution& solution) {
  drowned.erase(std::remove_if(drowned.begin(), drowned.end(),
                               [&](const Drowned& entry) { return cycle - entry.cycle > kDrownedCycles; }),
                drowned.end());
  candidates.clear();
  for (std::size_t i = archive.records().size(); i-- > 0;) {
    const NicheRecord& record = archive.records()[i];
    if (record.reported || record.niche.distance == 0.0 || i == 0) {
      continue;  // the deepest has nowhere to lead to
    }
    const TrialPoint start = descend(objective, record.niche.node_pair, nullptr, search.trail, solution.cost);
    const bool known = std::any_of(drowned.begin(), drowned.end(),
                                   [&](const Drowned& entry) { return samePlace(entry.start, start); });
    if (!known && !leadsDown(objective, start, record.niche, solution)) {
      continue;
    }
    archive.remove(i, solution.events);
  }
  settleCandidates(solution);
}

}  // namespace concave_distance

#include <algorithm>
#include <cmath>
#include <limits>

#include "node_niches.h"
#include "tracker_state.h"

namespace concave_distance {
namespace {

// Triangle pairs that a flood visits, at most, before its start counts as a niche.
constexpr std::size_t kColdFlood = 20000;
constexpr std::size_t kWarmFlood = 400;
constexpr std::size_t kNearestFlood = 128;  // of the nearest niche, in every warm cycle
// The nearest niche is flooded this many times as far as its prominence asks: a deeper place may be beyond a
// ridge of its own.
constexpr double kNearestReach = 5.0;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// The result for a candidate without time left.
constexpr AdmissionResult kGivenUp{Admission::ThroughMaterial, 0};

// Hysteresis: a niche that users know is given up only at half the least prominence.
double leastProminenceOf(const NicheRecord& record, const TrackerParameters& parameters) {
  return (record.reported ? 0.5 : 1.0) * parameters.least_prominence;
}

}  // namespace

void TrackerState::settleCandidates(PairSolution& solution) {
  std::sort(candidates.begin(), candidates.end(), [](const NicheCandidate& l, const NicheCandidate& r) {
    return l.witness.squared_distance != r.witness.squared_distance
               ? l.witness.squared_distance < r.witness.squared_distance
               : l.node_pair < r.node_pair;
  });
  if (parameters.accuracy == AccuracyLevel::Nodes) {
    const double niche_radius = warm ? warm_radii.niche : cold_radii.niche;
    for (const NicheCandidate& candidate : candidates) {
      report(candidate, admitNodePair(candidate, geometry, niche_radius, cycle, search.metric, archive),
             solution.events);
    }
  } else {
    judging.records.assign(archive.records().size(), 0);
    judge(solution);
  }
  archive.settle();
  candidates.clear();
}

void TrackerState::reviewRecords(PairSolution& solution) {
  // A warm cycle looks at the nearest niche, which has to be the deepest of its basin, and as the bodies move
  // at the others in turn; a cold one at all.
  if (limit.isOver()) return;
  const std::size_t count = archive.records().size();
  judging.records.assign(count, warm ? 0 : 1);
  if (warm && count > 0 && (cycles_at_rest == 0 || cycles_at_rest < count)) {
    judging.records[0] = 1;
    due_reviews = std::min(due_reviews + due_share * parameters.reviewed_niches, static_cast<double>(count));
    for (; due_reviews >= 1.0; due_reviews -= 1.0) {
      next_review = (next_review + 1) % count;
      judging.records[next_review] = 1;
    }
  }
  if (std::find(judging.records.begin(), judging.records.end(), 1) == judging.records.end()) return;
  judge(solution);
  archive.settle();
}

// What became of a candidate that a reported niche has run on to.
void TrackerState::report(const NicheCandidate& candidate, const AdmissionResult& result,
                          std::vector<NicheEvent>& events) {
  if (candidate.left_by == 0) return;
  const bool joined = result.outcome == Admission::SamePlace || result.outcome == Admission::LowProminence;
  events.push_back(joined ? NicheEvent{NicheEvent::Kind::Merge, candidate.left_by, result.id}
                          : NicheEvent{NicheEvent::Kind::Death, candidate.left_by, 0});
}

// Through material: not a niche, but what shows that a body is swallowed.
bool TrackerState::isDark(const WitnessPair& witness, Outwardness outward) {
  if (outward != Outwardness::ThroughMaterial || parameters.keep_through_material) return false;
  if (!inward_witness_met || witness.squared_distance < inward_witness.squared_distance) {
    inward_witness = witness;
    inward_witness_met = true;
  }
  return true;
}

// A candidate at a known place, through material or known for a ripple; empty when it is to be judged.
std::optional<AdmissionResult> TrackerState::knownVerdict(const NicheCandidate& candidate,
                                                          Outwardness& outward) {
  const WitnessPair& witness = candidate.witness;
  const Eigen::Vector3d point_b_in_b = geometry.b_from_a * witness.point_b_in_a;
  const NicheRecord* known =
      archive.findSamePlace(witness.point_a_in_a, point_b_in_b, geometry.samePlaceTolerance());
  if (known == nullptr && witness.squared_distance == 0.0) {
    // Touching or crossing surfaces meet in whole curves of pairs at distance 0: one niche per neighbourhood.
    known =
        archive.findTouching(witness.point_a_in_a, point_b_in_b, warm ? warm_radii.niche : cold_radii.niche);
  }
  if (known != nullptr) return AdmissionResult{Admission::SamePlace, known->niche.id};
  if (const auto owner = ripples.ownerOf(witness.triangle_a, witness.triangle_b, cycle)) {
    const NicheRecord* record = archive.find(*owner);
    // One that has become the deepest of its niche is no ripple any more.
    if (record != nullptr && record->niche.witness.squared_distance <= witness.squared_distance) {
      return AdmissionResult{Admission::LowProminence, *owner};
    }
  }
  outward = classifyOutwardness(*geometry.a, *geometry.b, geometry.a_from_b, witness);
  if (isDark(witness, outward)) return AdmissionResult{Admission::ThroughMaterial, 0};
  return std::nullopt;
}

std::uint64_t TrackerState::addNiche(const NicheCandidate& candidate, Outwardness outward) {
  NicheRecord newborn;
  newborn.niche.id = archive.takeId();
  newborn.niche.birth_cycle = cycle;
  newborn.niche.node_pair = candidate.node_pair;
  newborn.niche.proven_local_minimum = candidate.proven;
  newborn.niche.outward = outward;
  placeRecord(newborn, geometry, candidate.witness);
  archive.records().push_back(newborn);
  return newborn.niche.id;
}

bool TrackerState::isNearest(const NicheCandidate& candidate) const {
  const std::vector<NicheRecord>& records = archive.records();
  return std::all_of(records.begin(), records.end(), [&](const NicheRecord& record) {
    return candidate.witness.squared_distance < record.niche.witness.squared_distance;
  });
}

// Floods from the candidates, and from the records that are marked, say which of them are niches of their own
// (judgeBasins): candidates become records, are dropped, or a record turns out to be part of one.
void TrackerState::judge(PairSolution& solution) {
  std::vector<BasinSeed>& seeds = judging.seeds;
  seeds.clear();
  const std::size_t known = archive.records().size();
  for (std::size_t i = 0; i < known; ++i) {
    const NicheRecord& record = archive.records()[i];
    const WitnessPair& witness = record.niche.witness;
    const double reach =
        i == 0 ? kNearestReach * parameters.least_prominence : leastProminenceOf(record, parameters);
    seeds.push_back({witness.triangle_a, witness.triangle_b, record.niche.distance, reach,
                     judging.records[i] != 0 && record.niche.distance > 0.0,
                     !warm    ? kColdFlood
                     : i == 0 ? kNearestFlood
                              : kWarmFlood});
  }
  judging.pending.clear();
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const NicheCandidate& candidate = candidates[k];
    Outwardness outward{};
    if (k > 0 && limit.isOver()) {
      report(candidate, kGivenUp, solution.events);
      continue;
    }
    if (const auto verdict = knownVerdict(candidate, outward)) {
      report(candidate, *verdict, solution.events);
      continue;
    }
    const WitnessPair& witness = candidate.witness;
    if (witness.squared_distance == 0.0) {
      report(candidate, {Admission::Born, addNiche(candidate, outward)}, solution.events);
      continue;
    }
    judging.pending.push_back({k, outward});
    seeds.push_back({witness.triangle_a, witness.triangle_b, std::sqrt(witness.squared_distance),
                     parameters.least_prominence, true, warm ? kWarmFlood : kColdFlood});
  }
  if (std::none_of(seeds.begin(), seeds.end(), [](const BasinSeed& seed) { return seed.judged; })) return;
  judgeBasins(*geometry.a, *geometry.b, geometry.a_from_b, seeds, judging.verdicts, &limit);
  solution.cost.evaluations += judging.verdicts.floodedPairs();
  settleVerdicts(known, solution);
}

void TrackerState::settleVerdicts(std::size_t known, PairSolution& solution) {
  const BasinVerdicts& verdicts = judging.verdicts;
  const std::vector<Basin>& basins = verdicts.basins();
  // The niche of every root: a record's id, 0 for what is none.
  std::vector<std::uint64_t>& ids = judging.ids;
  ids.assign(basins.size(), 0);
  judging.seeded.assign(basins.size(), kNone);
  for (std::size_t i = judging.seeds.size(); i-- > 0;) {
    const std::uint32_t basin = verdicts.basinOf(i);
    judging.seeded[basin] = i;
    if (i < known) ids[basin] = archive.records()[i].niche.id;
  }
  judging.record_ids.clear();
  for (std::size_t i = 0; i < known; ++i) judging.record_ids.push_back(archive.records()[i].niche.id);
  for (std::uint32_t basin = 0; basin < basins.size(); ++basin) {
    if (basins[basin].owner != basin || ids[basin] != 0) continue;
    const std::size_t seed = judging.seeded[basin];
    if (seed != kNone) {
      const Pending& pending = judging.pending[seed - known];
      // Undecided, it may be a ripple; the nearest of all is still reported.
      if (basins[basin].refused && !isNearest(candidates[pending.candidate])) continue;
      ids[basin] = addNiche(candidates[pending.candidate], pending.outward);
      continue;
    }
    // A place that no candidate but a flood has found.
    const WitnessRefinement refined = geometry.refine(basins[basin].a, basins[basin].b);
    const NicheCandidate found{refined.witness, geometry.nodePairNear(refined.witness), refined.proven, 0};
    Outwardness outward{};
    const auto verdict = knownVerdict(found, outward);
    ids[basin] = verdict ? verdict->id : addNiche(found, outward);
  }
  for (std::size_t k = 0; k < judging.pending.size(); ++k) {
    const NicheCandidate& candidate = candidates[judging.pending[k].candidate];
    const std::uint32_t basin = verdicts.basinOf(known + k);
    const std::uint32_t root = verdicts.rootOf(basin);
    const bool born = root == basin && judging.seeded[basin] == known + k && ids[root] != 0;
    const Admission outcome = born             ? Admission::Born
                              : ids[root] == 0 ? Admission::ThroughMaterial
                                               : Admission::LowProminence;
    if (outcome == Admission::LowProminence) {
      ripples.remember(candidate.witness.triangle_a, candidate.witness.triangle_b, ids[root], cycle);
    }
    report(candidate, {outcome, ids[root]}, solution.events);
  }
  for (std::size_t i = 0; i < known; ++i) {
    const std::uint32_t root = verdicts.rootOf(verdicts.basinOf(i));
    const std::uint64_t id = judging.record_ids[i];
    if (ids[root] == 0 || ids[root] == id) continue;
    const NicheRecord* record = archive.find(id);
    const NicheRecord* owner = archive.find(ids[root]);
    if (record == nullptr || owner == nullptr) continue;
    const Basin& own = basins[verdicts.basinOf(i)];
    if (own.pass >= (1.0 + leastProminenceOf(*record, parameters)) * own.distance) continue;  // seen far off
    const std::uint64_t living =
        archive.unite(static_cast<std::size_t>(owner - archive.records().data()),
                      static_cast<std::size_t>(record - archive.records().data()), solution.events);
    // The older id may have moved to the deeper place.
    const std::uint64_t gone = living == id ? ids[root] : id;
    std::replace(ids.begin(), ids.end(), gone, living);
  }
}

}  // namespace concave_distance

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracker_state.h"

namespace concave_distance {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// The niche of a local minimum; identity, birth and speed are the caller's.
void placeMinimum(NicheRecord& record, const PairGeometry& geometry, const LocalMinimum& minimum) {
  placeRecord(record, geometry, minimum.witness);
  TrackedNiche& niche = record.niche;
  niche.distance = minimum.distance;
  niche.node_pair = geometry.nodePairNear(minimum.witness);
  niche.kind = minimum.kind;
  niche.extent = minimum.extent;
  niche.outward = minimum.outward;
  niche.visible = minimum.visible;
  niche.prominence = std::isfinite(minimum.prominence) ? minimum.prominence : kNotComputed;
  niche.proven_local_minimum = true;
}

}  // namespace

// Level `complete`: every niche there is, without a search. A niche that is known goes on as the one whose
// basin its triangles lie in now.
void TrackerState::completeNiches(double displacement, double elapsed, PairSolution& solution) {
  std::vector<NicheRecord>& records = archive.records();
  if (warm && displacement == 0.0 && completeness.current) {
    for (NicheRecord& record : records) record.niche.closing_speed = elapsed > 0.0 ? 0.0 : kNotComputed;
    solution.niches_cut = completeness.cut;
    return;
  }
  LocalMinimaRequest request;
  request.limit = &limit;
  request.cutoff = parameters.cutoff;
  request.least_prominence = parameters.least_prominence;
  request.prominence_limit = parameters.prominence_limit;
  request.largest_count = parameters.largest_niche_count;
  request.through_material = parameters.keep_through_material;
  for (const NicheRecord& record : records) {
    request.asked_pairs.emplace_back(record.niche.witness.triangle_a, record.niche.witness.triangle_b);
  }
  if (proof.seeded) request.certain_distance = proof.certificate.lower_bound - displacement;
  const LocalMinima found =
      findLocalMinima(*geometry.a, *geometry.b, geometry.a_from_b, request, &completeness.memory);
  completeness.current = found.finished;
  if (!found.finished && warm) {
    carryNiches(solution);
    return;
  }
  solution.niches_cut = completeness.cut = found.cut;
  solution.cost.evaluations += found.cost.feature_pairs + found.cost.candidates + found.cost.flooded_pairs;

  // The lowest value of a basin cannot fall by more than any point of B has moved: who did has run on into
  // another basin and is not its heir.
  const double rounding = kPlateauTolerance * geometry.scale();
  std::vector<std::size_t> heirs(found.niches.size(), kNone);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::size_t owner = found.owners[i];
    if (owner == LocalMinima::kNoOwner) continue;
    const TrackedNiche& known_niche = records[i].niche;
    if (!records[i].carried &&
        found.niches[owner].distance < known_niche.distance - displacement - rounding) {
      continue;
    }
    if (heirs[owner] == kNone || known_niche.id < records[heirs[owner]].niche.id) heirs[owner] = i;
  }
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::size_t owner = found.owners[i];
    const std::size_t heir = owner == LocalMinima::kNoOwner ? kNone : heirs[owner];
    if (heir == i || !records[i].reported) continue;
    if (heir == kNone) {
      solution.events.push_back({NicheEvent::Kind::Death, records[i].niche.id, 0});
    } else {
      solution.events.push_back({NicheEvent::Kind::Merge, records[i].niche.id, records[heir].niche.id});
    }
  }
  std::vector<NicheRecord>& next = completeness.records;
  next.clear();
  for (std::size_t k = 0; k < found.niches.size(); ++k) {
    NicheRecord record;
    if (heirs[k] != kNone) {
      record = records[heirs[k]];
    } else {
      record.niche.id = archive.takeId();
      record.niche.birth_cycle = cycle;
    }
    const double before = record.niche.distance;
    placeMinimum(record, geometry, found.niches[k]);
    record.carried = false;
    record.niche.closing_speed =
        heirs[k] != kNone && elapsed > 0.0 ? (before - record.niche.distance) / elapsed : kNotComputed;
    next.push_back(record);
  }
  records.swap(next);
  archive.settle();
}

// A list cut by time or memory is no evidence against niches missing from it: known ones stay, each at the
// minimum around its triangles.
void TrackerState::carryNiches(PairSolution& solution) {
  for (NicheRecord& record : archive.records()) {
    if (!limit.isOver()) {
      placeRecord(record, geometry,
                  geometry.refine(record.niche.witness.triangle_a, record.niche.witness.triangle_b).witness);
    }
    carryRecord(record, geometry);
  }
  archive.settle();
  uniteSamePlaces(geometry, archive, solution.events);
}

}  // namespace concave_distance

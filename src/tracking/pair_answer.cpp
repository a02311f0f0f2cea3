#include "pair_answer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "distance/bound/round_certificate.h"
#include "distance/bound/solid_overlap.h"

namespace concave_distance {

void clearAnswer(const TrackerParameters& parameters, std::uint64_t cycle, bool is_warm,
                 PairSolution& solution) {
  solution.status = SolveStatus::Ok;
  solution.accuracy = parameters.accuracy;
  solution.distance = solution.lower_bound = solution.surface_distance = kNotComputed;
  solution.signed_distance = kNotComputed;
  solution.point_a_in_a.setConstant(kNotComputed);
  solution.point_b_in_a.setConstant(kNotComputed);
  solution.normal_in_a.setConstant(kNotComputed);
  solution.closing_speed = kNotComputed;
  solution.meeting_triangles.reset();
  solution.niches.clear();
  solution.events.clear();
  solution.niches_cut = solution.niches_complete = solution.search_miss = false;
  solution.niches_beyond_cutoff = 0;
  solution.cycle = cycle;
  solution.warm = is_warm;
  solution.seed = parameters.seed;
  solution.cost = {};
  solution.proof_cost = {};
  solution.stages = {};
}

void listNiches(const TrackerParameters& parameters, std::vector<NicheRecord>& records,
                PairSolution& solution) {
  if (!records.empty()) {
    records.front().niche.prominence = std::numeric_limits<double>::infinity();
  }
  for (NicheRecord& record : records) {
    if (record.niche.distance > parameters.cutoff + parameters.margin()) {
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

void answerByNearest(const PairFrame& frame, const std::vector<NicheRecord>& records,
                     const MinimumCandidate* known, bool is_round, PairSolution& solution, WorkLimit& limit) {
  if (!records.empty()) {
    const TrackedNiche& nearest = records.front().niche;
    solution.distance = nearest.distance;
    solution.point_a_in_a = nearest.point_a_in_a;
    solution.point_b_in_a = nearest.point_b_in_a;
    if (nearest.distance == 0.0) {
      solution.status = SolveStatus::Penetrating;
      solution.meeting_triangles = TrianglePair{nearest.witness.triangle_a, nearest.witness.triangle_b};
      return;
    }
  }
  const bool overlap = is_round ? isRoundContained(frame.a, frame.b, frame.a_from_b)
                                : isContained(frame.a, frame.b, frame.a_from_b, limit).value_or(false);
  const bool is_known_alone = records.empty() && limit.hasRefused();
  if (known != nullptr && (overlap || is_known_alone)) {
    // Not a niche, but still a bound of the distance: through material, or there was no time to find one.
    const WitnessPair witness =
        is_round ? refineRoundWitness(frame.a, frame.b, frame.a_from_b, {known->a, known->b})
                 : frame.witnessOf(*known);
    solution.distance = is_round ? std::sqrt(witness.squared_distance) : known->distance;
    solution.point_a_in_a = witness.point_a_in_a;
    solution.point_b_in_a = witness.point_b_in_a;
  }
  if (overlap) {
    solution.status = SolveStatus::Penetrating;
    solution.surface_distance = solution.distance;
    solution.distance = 0.0;
  }
}

void answerByVertices(const TrackerParameters& parameters, const BodyMesh& a, const BodyMesh& b,
                      const Eigen::Isometry3d& a_from_b, PairSolution& solution) {
  solution.accuracy = AccuracyLevel::Nodes;
  if (provesDistance(parameters.accuracy)) solution.lower_bound = 0.0;
  solution.point_a_in_a = a.surface().vertex(NodeIndex{0});
  solution.point_b_in_a = a_from_b * b.surface().vertex(NodeIndex{0});
  solution.distance = (solution.point_b_in_a - solution.point_a_in_a).norm();
}

bool hasMissedNiche(const std::vector<TrackedNiche>& niches) {
  return std::any_of(niches.begin(), niches.end(), [](const TrackedNiche& niche) {
    return niche.origin == NicheOrigin::FromCones || niche.origin == NicheOrigin::Proven;
  });
}

}  // namespace concave_distance

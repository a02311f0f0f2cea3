#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "distance/solid_overlap.h"
#include "tracker_state.h"

namespace concave_distance {
namespace {

// Niches whose triangle pairs a proof starts from: the nearest gives the bound that everything is compared
// with, and further ones cost a refinement each.
constexpr std::size_t kSeedNiches = 1;

TrianglePair trianglesOf(const WitnessPair& witness) {
  return {witness.triangle_a, witness.triangle_b};
}

}  // namespace

void TrackerState::proveDistance(double displacement) {
  DistanceCertificate& certificate = proof.certificate;
  if (displacement == 0.0 && proof.current && certificate.status != CertificateStatus::Budget) {
    certificate.cost = {};
    return;
  }
  std::array<TrianglePair, kSeedNiches + 1> seeds{};
  std::size_t count = 0;
  for (const NicheRecord& record : archive.records()) {
    if (count == kSeedNiches) break;
    seeds[count++] = trianglesOf(record.niche.witness);
  }
  const auto is_last = [last = trianglesOf(certificate.witness)](const TrianglePair& seed) {
    return seed.a == last.a && seed.b == last.b;
  };
  if (proof.seeded && std::none_of(seeds.begin(), seeds.begin() + count, is_last)) {
    seeds[count++] = trianglesOf(certificate.witness);
  }
  const double last_bound = proof.seeded ? certificate.lower_bound : 0.0;
  CertificateRequest request;
  request.absolute_tolerance = parameters.absolute_tolerance;
  request.relative_tolerance = parameters.relative_tolerance;
  request.limit = &limit;
  certificate = certifyDistance(*geometry.a, *geometry.b, geometry.a_from_b, seeds.data(), count, request,
                                proof.workspace, &proof.front);
  if (certificate.status == CertificateStatus::Budget || certificate.status == CertificateStatus::Tolerance) {
    // Stopped on the way down.
    const WitnessRefinement refined =
        geometry.refine(certificate.witness.triangle_a, certificate.witness.triangle_b);
    if (refined.witness.squared_distance < certificate.witness.squared_distance) {
      certificate.witness = refined.witness;
      certificate.distance = std::sqrt(refined.witness.squared_distance);
    }
  }
  proof.error = kProofError * proofScale(*geometry.a, *geometry.b, geometry.a_from_b);
  proof.seeded = proof.current = true;
  // Who holds whom cannot change while no point comes as far as the other surface.
  if (!(displacement + proof.error < last_bound)) {
    const std::optional<bool> holds = isContained(*geometry.a, *geometry.b, geometry.a_from_b, limit);
    proof.swallowed = holds.value_or(false);
    // Until it is known whether one body is inside the other, nothing is certain.
    if (!holds) {
      certificate.lower_bound = 0.0;
      certificate.status = CertificateStatus::Budget;
    }
  }
}

// A pair closer than every niche becomes one, and the search has missed it.
void TrackerState::admitClosest(PairSolution& solution) {
  std::vector<NicheRecord>& records = archive.records();
  const DistanceCertificate& certificate = proof.certificate;
  if (!records.empty() && !(certificate.distance < records.front().niche.distance - proof.error)) {
    return;
  }
  NicheCandidate candidate;
  candidate.witness = certificate.witness;
  const WitnessRefinement refined =
      geometry.refine(certificate.witness.triangle_a, certificate.witness.triangle_b);
  candidate.proven = refined.proven || certificate.status == CertificateStatus::Proven;
  if (refined.witness.squared_distance < candidate.witness.squared_distance) {
    candidate.witness = refined.witness;
  }
  candidate.node_pair = geometry.nodePairNear(candidate.witness);
  const double missed = candidate.witness.squared_distance;
  candidates.assign(1, candidate);
  settleCandidates(solution);
  uniteSamePlaces(geometry, archive, solution.events);
  // At a place that is known the proof's witness may be the closer one by rounding.
  if (records.empty() || records.front().niche.witness.squared_distance > missed) {
    NicheRecord* known = archive.findSamePlace(candidate.witness.point_a_in_a,
                                               geometry.b_from_a * candidate.witness.point_b_in_a,
                                               geometry.samePlaceTolerance());
    if (known == nullptr) return;  // through material
    known->niche.proven_local_minimum = candidate.proven;
    placeRecord(*known, geometry, candidate.witness);
    archive.settle();
  }
  solution.search_miss = true;
}

void TrackerState::reportProven(PairSolution& solution) {
  const DistanceCertificate& certificate = proof.certificate;
  solution.proof_cost = certificate.cost;
  solution.distance = certificate.distance;
  solution.lower_bound = certificate.lower_bound;
  solution.point_a_in_a = certificate.witness.point_a_in_a;
  solution.point_b_in_a = certificate.witness.point_b_in_a;
  // Equally near but for the error of the proof: on a plateau the niche has the steadier points.
  if (!archive.records().empty() &&
      archive.records().front().niche.distance <= certificate.distance + proof.error) {
    const TrackedNiche& nearest = archive.records().front().niche;
    solution.distance = std::min(nearest.distance, certificate.distance);
    solution.point_a_in_a = nearest.point_a_in_a;
    solution.point_b_in_a = nearest.point_b_in_a;
    if (!solution.niches.empty()) {
      solution.niches.front().distance = solution.distance;
    }
  }
  switch (certificate.status) {
    case CertificateStatus::Proven:
      solution.status = SolveStatus::Ok;
      break;
    case CertificateStatus::Tolerance:
      solution.status = SolveStatus::WithinTolerance;
      break;
    case CertificateStatus::Budget:
      solution.status = SolveStatus::BudgetExhausted;
      solution.accuracy = AccuracyLevel::Refined;
      break;
    case CertificateStatus::Penetrating:
      solution.status = SolveStatus::Penetrating;
      solution.meeting_triangles = trianglesOf(certificate.witness);
      return;
  }
  if (proof.swallowed) {
    solution.status = SolveStatus::Penetrating;
    solution.accuracy = parameters.accuracy;
    solution.surface_distance = solution.distance;
    solution.distance = solution.lower_bound = 0.0;
  }
}

// Without niches: nothing is searched.
void TrackerState::proveAlone(double displacement, double elapsed, PairSolution& solution) {
  const double before = proof.certificate.distance;
  proveDistance(displacement);
  reportProven(solution);
  if (proof.swallowed && !parameters.keep_through_material) return;
  const DistanceCertificate& certificate = proof.certificate;
  NicheRecord nearest;
  placeRecord(nearest, geometry, certificate.witness);
  solution.normal_in_a = nearest.niche.normal_in_a;
  if (elapsed > 0.0) solution.closing_speed = (before - certificate.distance) / elapsed;
}

}  // namespace concave_distance

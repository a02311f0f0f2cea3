#include "distance_proof.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "distance/bound/round_certificate.h"
#include "distance/bound/solid_overlap.h"

namespace concave_distance {
namespace {

// Room for the pairs that a usual proof opens.
constexpr std::size_t kUsualOpenPairs = 256;

TrianglePair trianglesOf(const WitnessPair& witness) {
  return {witness.triangle_a, witness.triangle_b};
}

}  // namespace

DistanceProof::DistanceProof() {
  workspace_.open.reserve(kUsualOpenPairs);
}

void DistanceProof::prove(const PairFrame& frame, const TrackerParameters& parameters,
                          const std::optional<TrianglePair>& nearest, double displacement, WorkLimit& limit) {
  if (displacement == 0.0 && current_ && certificate_.status != CertificateStatus::Budget) {
    certificate_.cost = {};
    return;
  }
  std::array<TrianglePair, 2> starts{};
  std::size_t count = 0;
  if (nearest) starts[count++] = *nearest;
  const TrianglePair last = trianglesOf(certificate_.witness);
  if (has_last_ && !(nearest && nearest->a == last.a && nearest->b == last.b)) starts[count++] = last;
  const double last_bound = has_last_ ? certificate_.lower_bound : 0.0;
  CertificateRequest request;
  request.absolute_tolerance = parameters.absolute_tolerance;
  request.relative_tolerance = parameters.relative_tolerance;
  request.margin = parameters.margin();
  request.limit = &limit;
  const bool is_round = hasRound(frame.a, frame.b);
  certificate_ = is_round
                     ? certifyRoundDistance(frame.a, frame.b, frame.a_from_b, starts.data(), count, request)
                     : certifyDistance(frame.a, frame.b, frame.a_from_b, starts.data(), count, request,
                                       workspace_, &front_);
  if (is_round) {
    // Its closest points are a local minimum already.
  } else if (certificate_.status == CertificateStatus::Budget ||
             certificate_.status == CertificateStatus::Tolerance) {
    // Stopped on the way down.
    const WitnessRefinement refined =
        frame.refine(certificate_.witness.triangle_a, certificate_.witness.triangle_b, refinement_);
    if (refined.witness.squared_distance < certificate_.witness.squared_distance) {
      certificate_.witness = refined.witness;
      certificate_.distance = std::sqrt(refined.witness.squared_distance);
    }
  }
  error_ = kProofError * proofScale(frame.a, frame.b, frame.a_from_b);
  has_last_ = current_ = true;
  // Neither body can come inside the other while no point comes as far as its surface.
  if (!(displacement + error_ < last_bound)) {
    const std::optional<bool> holds = is_round ? isRoundContained(frame.a, frame.b, frame.a_from_b)
                                               : isContained(frame.a, frame.b, frame.a_from_b, limit);
    swallowed_ = holds.value_or(false);
    // Until it is known whether one body is inside the other, nothing is certain.
    if (!holds) {
      certificate_.lower_bound = 0.0;
      certificate_.status = CertificateStatus::Budget;
    }
  }
}

void DistanceProof::report(PairSolution& solution) const {
  solution.proof_cost = certificate_.cost;
  solution.distance = certificate_.distance;
  solution.lower_bound = certificate_.lower_bound;
  solution.point_a_in_a = certificate_.witness.point_a_in_a;
  solution.point_b_in_a = certificate_.witness.point_b_in_a;
  // Equally near but for the error of the proof: on a plateau the niche has the steadier points.
  if (!solution.niches.empty() && solution.niches.front().distance <= certificate_.distance + error_) {
    TrackedNiche& nearest = solution.niches.front();
    nearest.distance = solution.distance = std::min(nearest.distance, certificate_.distance);
    solution.point_a_in_a = nearest.point_a_in_a;
    solution.point_b_in_a = nearest.point_b_in_a;
  }
  switch (certificate_.status) {
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
      solution.meeting_triangles = trianglesOf(certificate_.witness);
      return;
  }
  if (swallowed_) {
    solution.status = SolveStatus::Penetrating;
    solution.accuracy = AccuracyLevel::Certified;
    solution.surface_distance = solution.distance;
    solution.distance = solution.lower_bound = 0.0;
  }
}

void DistanceProof::clear() {
  front_.clear();
  has_last_ = current_ = swallowed_ = false;
}

}  // namespace concave_distance

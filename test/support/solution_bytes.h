#pragma once

#include "concave_distance/tracking/pair_solution.h"
#include "support/body_bytes.h"

namespace concave_distance::test {

inline void appendWitness(const WitnessPair& witness, Bytes& bytes) {
  appendBytes(witness.squared_distance, bytes);
  appendBytes(witness.point_a_in_a, bytes);
  appendBytes(witness.point_b_in_a, bytes);
  appendBytes(witness.triangle_a, bytes);
  appendBytes(witness.triangle_b, bytes);
  appendBytes(witness.feature_a, bytes);
  appendBytes(witness.feature_b, bytes);
}

inline void appendNiche(const TrackedNiche& niche, Bytes& bytes) {
  appendBytes(niche.id, bytes);
  appendBytes(niche.distance, bytes);
  appendBytes(niche.point_a_in_a, bytes);
  appendBytes(niche.point_b_in_a, bytes);
  appendBytes(niche.normal_in_a, bytes);
  appendBytes(niche.closing_speed, bytes);
  appendBytes(niche.kind, bytes);
  appendBytes(niche.extent, bytes);
  appendBytes(niche.outward, bytes);
  appendBytes(niche.visible, bytes);
  appendBytes(niche.prominence, bytes);
  appendBytes(niche.proven_local_minimum, bytes);
  appendBytes(niche.birth_cycle, bytes);
  appendWitness(niche.witness, bytes);
  appendBytes(niche.node_pair.node_a, bytes);
  appendBytes(niche.node_pair.node_b, bytes);
  appendBytes(niche.node_pair.squared_distance, bytes);
}

/// Everything but the time it took.
inline void appendSolution(const PairSolution& solution, Bytes& bytes) {
  appendBytes(solution.status, bytes);
  appendBytes(solution.accuracy, bytes);
  appendBytes(solution.distance, bytes);
  appendBytes(solution.lower_bound, bytes);
  appendBytes(solution.point_a_in_a, bytes);
  appendBytes(solution.point_b_in_a, bytes);
  appendBytes(solution.normal_in_a, bytes);
  appendBytes(solution.closing_speed, bytes);
  appendBytes(solution.surface_distance, bytes);
  if (solution.meeting_triangles) {
    appendBytes(solution.meeting_triangles->a, bytes);
    appendBytes(solution.meeting_triangles->b, bytes);
  }
  for (const TrackedNiche& niche : solution.niches) appendNiche(niche, bytes);
  for (const NicheEvent& event : solution.events) {
    appendBytes(event.kind, bytes);
    appendBytes(event.id, bytes);
    appendBytes(event.into_id, bytes);
  }
  appendBytes(solution.niches_cut, bytes);
  appendBytes(solution.niches_beyond_cutoff, bytes);
  appendBytes(solution.cycle, bytes);
  appendBytes(solution.warm, bytes);
  appendBytes(solution.search_miss, bytes);
  appendBytes(solution.seed, bytes);
  appendBytes(solution.cost.evaluations, bytes);
  appendBytes(solution.cost.descents, bytes);
  appendBytes(solution.cost.descents_joined, bytes);
  appendBytes(solution.cost.descent_steps, bytes);
  appendBytes(solution.proof_cost.box_bounds, bytes);
  appendBytes(solution.proof_cost.leaf_pairs, bytes);
  appendBytes(solution.proof_cost.triangle_pairs, bytes);
}

}  // namespace concave_distance::test

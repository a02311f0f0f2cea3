#pragma once

#include "concave_distance/tracking/pair_solution.h"
#include "support/body_bytes.h"

namespace concave_distance::test {

inline void appendWitness(const WitnessPair& witness, Bytes& bytes) {
  appendAll(bytes, witness.squared_distance, witness.point_a_in_a, witness.point_b_in_a, witness.triangle_a,
            witness.triangle_b, witness.feature_a, witness.feature_b);
}

inline void appendNiche(const TrackedNiche& niche, Bytes& bytes) {
  appendAll(bytes, niche.id, niche.distance, niche.signed_distance, niche.point_a_in_a, niche.point_b_in_a,
            niche.normal_in_a, niche.closing_speed, niche.kind, niche.extent, niche.outward, niche.visible,
            niche.prominence, niche.proven_local_minimum, niche.birth_cycle, niche.origin);
  appendWitness(niche.witness, bytes);
  appendAll(bytes, niche.node_pair.node_a, niche.node_pair.node_b, niche.node_pair.squared_distance);
}

/// Everything but the time it took.
inline void appendSolution(const PairSolution& solution, Bytes& bytes) {
  appendAll(bytes, solution.status, solution.accuracy, solution.distance, solution.lower_bound,
            solution.point_a_in_a, solution.point_b_in_a, solution.normal_in_a, solution.closing_speed,
            solution.surface_distance, solution.signed_distance);
  if (solution.meeting_triangles) {
    appendAll(bytes, solution.meeting_triangles->a, solution.meeting_triangles->b);
  }
  for (const TrackedNiche& niche : solution.niches) appendNiche(niche, bytes);
  for (const NicheEvent& event : solution.events) {
    appendAll(bytes, event.kind, event.id, event.into_id);
  }
  appendAll(bytes, solution.niches_cut, solution.niches_beyond_cutoff, solution.cycle, solution.warm,
            solution.niches_complete, solution.a_from_b.matrix(), solution.cost.generations,
            solution.cost.inherited, solution.cost.children, solution.search_miss, solution.seed,
            solution.cost.evaluations, solution.cost.descents, solution.cost.descents_joined,
            solution.cost.descent_steps, solution.proof_cost.box_bounds, solution.proof_cost.leaf_pairs,
            solution.proof_cost.triangle_pairs);
}

}  // namespace concave_distance::test

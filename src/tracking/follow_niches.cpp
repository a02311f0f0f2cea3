#include <limits>

#include "distance/surface_walk.h"
#include "niche_admission.h"
#include "search/local_descent.h"
#include "tracker_state.h"

namespace concave_distance {

void TrackerState::followNiches(double displacement, double elapsed, SearchCost& cost,
                                std::vector<NicheEvent>& events) {
  const PairObjective objective(*geometry.a, *geometry.b, geometry.a_from_b);
  const double rounding = 1e-9 * geometry.scale();
  std::vector<NicheRecord>& records = archive.records();
  for (std::size_t i = 0; i < records.size();) {
    NicheRecord& record = records[i];
    if (limit.isOver()) {
      carryRecord(record, geometry);
      ++i;
      continue;
    }
    const double before = record.niche.distance;
    // A minimum that was not descended may be far below its points.
    record.least_distance =
        record.carried ? -std::numeric_limits<double>::infinity() : before - displacement - rounding;
    record.carried = false;
    record.niche.node_pair = descend(
        objective, objective.evaluate(record.niche.node_pair.node_a, record.niche.node_pair.node_b, cost),
        &search.basins, search.trail, cost);
    if (cycles_at_rest > 0 && parameters.accuracy != AccuracyLevel::Nodes) {
      record.niche.closing_speed = elapsed > 0.0 ? 0.0 : kNotComputed;
      record.velocity_a_in_a.setZero();
      record.velocity_b_in_b.setZero();
      ++i;
      continue;
    }
    follow(record, elapsed);
    // No surviving minimum can fall by more than any point of B has moved: the basin is gone and the descent
    // has run on into another one.
    if (record.niche.distance < record.least_distance) {
      candidates.push_back({record.niche.witness, record.niche.node_pair, record.niche.proven_local_minimum,
                            record.reported ? record.niche.id : 0});
      records[i] = records.back();
      records.pop_back();
      continue;
    }
    record.niche.closing_speed = elapsed > 0.0 ? (before - record.niche.distance) / elapsed : kNotComputed;
    if (parameters.accuracy != AccuracyLevel::Nodes && !parameters.keep_through_material) {
      record.niche.outward =
          classifyOutwardness(*geometry.a, *geometry.b, geometry.a_from_b, record.niche.witness);
      if (record.niche.outward == Outwardness::ThroughMaterial) {
        if (!inward_witness_met || record.niche.witness.squared_distance < inward_witness.squared_distance) {
          inward_witness = record.niche.witness;
          inward_witness_met = true;
        }
        archive.remove(i, events);
        continue;
      }
    }
    ++i;
  }
}

// What shows that a body is swallowed is in no archive: it is followed from cycle to cycle like a niche.
// Where it has become one (keep_through_material, or the body has come out), it is admitted as such.
void TrackerState::followInwardWitness() {
  const WitnessRefinement refined = geometry.refine(inward_witness.triangle_a, inward_witness.triangle_b);
  candidates.push_back({refined.witness, geometry.nodePairNear(refined.witness), refined.proven, 0});
}

void TrackerState::follow(NicheRecord& record, double elapsed) {
  if (parameters.accuracy == AccuracyLevel::Nodes) {
    placeRecord(record, geometry, geometry.nodeWitness(record.niche.node_pair));
    return;
  }
  TriangleIndex start_a = record.niche.witness.triangle_a;
  TriangleIndex start_b = record.niche.witness.triangle_b;
  const Eigen::Vector3d before_a = record.niche.point_a_in_a;
  const Eigen::Vector3d before_b = record.point_b_in_b;
  // On a plateau witnesses wander without coming nearer: no way to go on with.
  if (parameters.extrapolate && elapsed > 0.0 && record.niche.kind == NicheKind::Point) {
    const Eigen::Vector3d displacement_a = record.velocity_a_in_a * elapsed;
    const Eigen::Vector3d displacement_b = record.velocity_b_in_b * elapsed;
    if (displacement_a.squaredNorm() + displacement_b.squaredNorm() > 0.0) {
      const SurfacePoint on_a = walkTowards(*geometry.a, start_a, before_a + displacement_a);
      const SurfacePoint on_b = walkTowards(*geometry.b, start_b, before_b + displacement_b);
      const double extrapolated = (geometry.a_from_b * on_b.point - on_a.point).norm();
      const double gain = (geometry.a_from_b * before_b - before_a).norm() - extrapolated;
      if (gain > kPlateauTolerance * geometry.scale()) {
        start_a = on_a.triangle;
        start_b = on_b.triangle;
      }
    }
  }
  const WitnessRefinement refined = geometry.refine(start_a, start_b);
  record.niche.proven_local_minimum = refined.proven;
  placeRecord(record, geometry, refined.witness);
  if (elapsed > 0.0) {
    record.velocity_a_in_a = (record.niche.point_a_in_a - before_a) / elapsed;
    record.velocity_b_in_b = (record.point_b_in_b - before_b) / elapsed;
  }
}

}  // namespace concave_distance

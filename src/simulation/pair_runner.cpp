#include "pair_runner.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <numeric>
#include <string>

#include "concave_distance/base/error.h"

namespace concave_distance::detail {
namespace {

class StageTimer {
 public:
  StageTimer(SimulationStage stage, SimulationCounters& counters)
      : seconds_(counters.seconds[static_cast<std::size_t>(stage)]), start_(Clock::now()) {}
  ~StageTimer() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_;
};

void requireProof(const ScenePair& pair) {
  const AccuracyLevel accuracy = pair.settings.tracker.accuracy;
  if (provesDistance(accuracy)) return;
  throw Error(
      "pair '" + pair.name + "'",
      "accuracy is " + std::string(toString(accuracy)) + ", and a simulation's steps need a proven distance",
      "allowed: certified, complete");
}

// B's velocity against A at A's origin, A's axes.
RelativeTwist relativeTwist(const SimulatedBody& a, const SimulatedBody& b) {
  const Eigen::Vector3d origin = a.world_from_body.translation();
  const Eigen::Vector3d velocity_a = a.velocity + a.angular_velocity.cross(origin - a.centre);
  const Eigen::Vector3d velocity_b = b.velocity + b.angular_velocity.cross(origin - b.centre);
  const Eigen::Matrix3d into_a = a.world_from_body.linear().transpose();
  return {into_a * (velocity_b - velocity_a), into_a * (b.angular_velocity - a.angular_velocity)};
}

// About the world's origin, its axes; the wrench is about A's.
Wrench inWorld(const Wrench& in_a, const Eigen::Isometry3d& world_from_a) {
  const Eigen::Vector3d force = world_from_a.linear() * in_a.force;
  return {force, world_from_a.linear() * in_a.torque + world_from_a.translation().cross(force)};
}

}  // namespace

PairRunner::PairRunner(const Scene& scene, std::size_t index, const SimulationSettings& settings)
    : tracked_(scene, index, 0),
      follows_niches_(settings.tracking != SimulationTracking::SingleMinimum),
      material_(inContact(tracked_.body_a->material, tracked_.body_b->material)) {
  requireProof(*tracked_.origin);
  // Contact follows the bare bodies.
  tracked_.settings.tracker.margin_a = tracked_.settings.tracker.margin_b = 0.0;
  const std::string where = "pair '" + tracked_.origin->name + "'";
  tracked_.settings.tracker.validate(where);
  tracked_.settings.effects.validate(where);
  tracked_.demand = {true, true, follows_niches_, true};
  if (settings.tracking != SimulationTracking::Niches) {
    single_.emplace(tracked_.body_a->mesh, tracked_.body_b->mesh);
  }
}

void PairRunner::update(double time, double step, const SimulatedBody& a, const SimulatedBody& b,
                        SimulatedPair& pair, SimulationCounters& counters) {
  pair.a_from_b = a.world_from_body.inverse(Eigen::Isometry) * b.world_from_body;
  PairInput input;
  input.a_from_b = pair.a_from_b;
  input.time = time;
  input.step = step;
  input.b_in_a = relativeTwist(a, b);
  if (!tracked_.locate(input, nullptr) && tracked_.box_bound) {
    pair.contacts = PairContacts();
    if (hasForces()) pair.contacts.on_b_in_a = Wrench{};
    pair.solved = false;
    pair.lower_bound = *tracked_.box_bound;
    pair.single_distance = kNotComputed;
    pair.single_point_a_in_a = pair.single_point_b_in_a = Eigen::Vector3d::Constant(kNotComputed);
    pair.single_is_wrong = false;
    ++counters.broad_phase_only;
    return;
  }
  tracked_.solve();
  pair.solved = true;
  pair.solution = tracked_.solution;
  pair.lower_bound = std::max(0.0, pair.solution.lower_bound);  // NaN: 0
  if (tracked_.effects.contacts() != nullptr) pair.contacts = *tracked_.effects.contacts();
  countSolve(pair, counters);
  if (single_) {
    const StageTimer timer(SimulationStage::Single, counters);
    followSingle(pair);
  }
}

void PairRunner::countSolve(SimulatedPair& pair, SimulationCounters& counters) {
  ++counters.solves;
  const EffectCounts effects = tracked_.effects.takeCounts();
  counters.seconds[static_cast<std::size_t>(SimulationStage::Solve)] += tracked_.solution.solve_seconds;
  const double seconds = std::accumulate(std::begin(effects.seconds), std::end(effects.seconds), 0.0);
  counters.seconds[static_cast<std::size_t>(SimulationStage::Effects)] += seconds;
  pair.seconds += tracked_.solution.solve_seconds + seconds;
}

void PairRunner::followSingle(SimulatedPair& pair) {
  if (!single_->started()) {
    TrackerParameters parameters = tracked_.settings.tracker;
    parameters.niches_wanted = true;
    const PairSolution first = solveOnce(tracked_.origin->name, tracked_.body_a->mesh, tracked_.body_b->mesh,
                                         parameters, pair.a_from_b);
    if (first.niches.empty()) return;
    const WitnessPair& witness = first.niches.front().witness;
    single_->start(witness.triangle_a, witness.triangle_b);
  }
  const WitnessPair& witness = single_->update(pair.a_from_b);
  pair.single_distance = single_->distance();
  pair.single_point_a_in_a = witness.point_a_in_a;
  pair.single_point_b_in_a = witness.point_b_in_a;
  pair.single_is_wrong = single_->wrong(pair.solution);
}

ContactWrenches PairRunner::wrenchesOnB(const SimulatedPair& pair, const Eigen::Isometry3d& world_from_a) {
  ContactWrenches wrenches;
  for (const ContactRegion& region : pair.contacts.regions) {
    if (!(region.normal_force >= 0.0)) continue;
    wrenches.normal += inWorld(region.normal_on_b_in_a, world_from_a);
    if (region.rubbing_on_b_in_a.force.allFinite())
      wrenches.friction += inWorld(region.rubbing_on_b_in_a, world_from_a);
  }
  return wrenches;
}

CouplingForce PairRunner::forceOnB(const SimulatedPair& pair, const SimulatedBody& a,
                                   const SimulatedBody& b) {
  const PairContacts& contacts = pair.contacts;
  CouplingForce force;
  force.acts = std::any_of(contacts.regions.begin(), contacts.regions.end(),
                           [](const ContactRegion& region) { return region.normal_force >= 0.0; });
  if (!force.acts) return force;
  const RelativeTwist twist = relativeTwist(a, b);
  force.twist << twist.linear, twist.angular;
  force.wrench << contacts.on_b_in_a.force, contacts.on_b_in_a.torque;
  force.linearisation = contacts.linearisation;
  return force;
}

double PairRunner::expectedDepth(const ContactLoad& load, double size) const {
  if (!hasForces()) return 0.0;
  return concave_distance::expectedDepth(*tracked_.settings.effects.normal_force, material_, load, size);
}

}  // namespace concave_distance::detail

#include "pair_runner.h"

#include <algorithm>
#include <chrono>

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

TrackerParameters parametersOf(const ScenePair& pair, SimulationTracking tracking) {
  TrackerParameters parameters = pair.settings.tracker;
  if (!provesDistance(parameters.accuracy)) {
    throw Error("pair '" + pair.name + "'",
                "accuracy is " + std::string(toString(parameters.accuracy)) +
                    ", and a simulation's steps need a proven distance",
                "allowed: certified, complete");
  }
  parameters.niches_wanted = tracking != SimulationTracking::SingleMinimum;
  return parameters;
}

// B's velocity against A at A's origin, A's axes.
RelativeTwist relativeTwist(const SimulatedBody& a, const SimulatedBody& b) {
  const Eigen::Vector3d origin = a.world_from_body.translation();
  const Eigen::Vector3d velocity_a = a.velocity + a.angular_velocity.cross(origin - a.centre);
  const Eigen::Vector3d velocity_b = b.velocity + b.angular_velocity.cross(origin - b.centre);
  const Eigen::Matrix3d into_a = a.world_from_body.linear().transpose();
  return {into_a * (velocity_b - velocity_a), into_a * (b.angular_velocity - a.angular_velocity)};
}

}  // namespace

PairRunner::PairRunner(const Scene& scene, const ScenePair& pair, const SimulationSettings& settings)
    : name_(pair.name),
      mesh_a_(scene.bodies[pair.body_a].mesh),
      mesh_b_(scene.bodies[pair.body_b].mesh),
      bounds_a_(scene.bodies[pair.body_a].bounds),
      bounds_b_(scene.bodies[pair.body_b].bounds),
      parameters_(parametersOf(pair, settings.tracking)),
      settings_(pair.settings.effects),
      material_(inContact(scene.bodies[pair.body_a].material, scene.bodies[pair.body_b].material)),
      tracker_(name_, mesh_a_, mesh_b_, parameters_),
      effects_(mesh_a_, mesh_b_, settings_, material_) {
  if (settings.tracking != SimulationTracking::Niches) single_.emplace(mesh_a_, mesh_b_);
}

void PairRunner::update(double time, double step, const SimulatedBody& a, const SimulatedBody& b,
                        SimulatedPair& pair, SimulationCounters& counters) {
  pair.a_from_b = a.world_from_body.inverse(Eigen::Isometry) * b.world_from_body;
  const double apart = distanceLowerBound(bounds_a_, bounds_b_, pair.a_from_b);
  const bool solve = !(apart > parameters_.cutoff);
  if (!solve) {
    if (pair.solved) {  // what was tracked is of another place by the time the bodies come back
      tracker_.reset();
      effects_.reset();
      pair.contacts = PairContacts();
    }
    pair.solved = false;
    pair.lower_bound = apart;
    pair.single_distance = kNotComputed;
    pair.single_point_a_in_a = pair.single_point_b_in_a = Eigen::Vector3d::Constant(kNotComputed);
    pair.single_is_wrong = false;
    ++counters.broad_phase_only;
    return;
  }
  {
    const StageTimer timer(SimulationStage::Solve, counters);
    tracker_.update(pair.a_from_b, time, pair.solution);
    pair.solved = true;
    pair.lower_bound = std::max(0.0, pair.solution.lower_bound);  // NaN: 0
    ++counters.solves;
  }
  if (!effects_.plan().empty()) {
    const StageTimer timer(SimulationStage::Effects, counters);
    effects_.update(pair.solution, pair.a_from_b, relativeTwist(a, b), step, pair.contacts);
  }
  if (single_) {
    const StageTimer timer(SimulationStage::Single, counters);
    followSingle(pair);
  }
}

void PairRunner::followSingle(SimulatedPair& pair) {
  if (!single_->started()) {
    TrackerParameters parameters = parameters_;
    parameters.niches_wanted = true;
    const PairSolution first = solveOnce(name_, mesh_a_, mesh_b_, parameters, pair.a_from_b);
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
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  for (const ContactRegion& region : pair.contacts.regions) {
    if (!(region.normal_force > 0.0)) continue;
    const Eigen::Vector3d point = world_from_a * region.point_in_a;
    const Eigen::Vector3d normal = world_from_a.linear() * region.overlap.normal_in_a;
    wrenches.normal += wrenchAbout(region.normal_force * normal, point, origin);
    if (region.friction_on_b_in_a.allFinite()) {
      wrenches.friction += wrenchAbout(world_from_a.linear() * region.friction_on_b_in_a, point, origin);
    }
  }
  return wrenches;
}

ContactRates PairRunner::ratesOf(const ContactRegion& region, double step) const {
  if (!settings_.normal_force) return {};
  const ContactGeometry geometry{region.overlap.depth, region.depth_rate, region.overlap.contact_area,
                                 region.overlap.volume};
  return contactRates(*settings_.normal_force, settings_.friction, material_, geometry, region.normal_force,
                      step);
}

}  // namespace concave_distance::detail

// An arm of four joints reaches into a shelf and comes to rest against it: Simbody has the joints, this
// package the contact (doc/multibody_engines.md). Prints CSV, then what the equilibrium and the energy come
// to; exit status 1 when either does not hold.
//   arm_and_shelf [seconds]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "arm_model.h"

namespace {

using namespace concave_distance;

constexpr double kAccuracy = 1e-3;
constexpr double kLargestStep = 2e-3;      // s
constexpr double kRowEvery = 0.05;         // s
constexpr double kTorqueTolerance = 5e-3;  // of the largest torque in a joint
constexpr double kEnergyTolerance = 1e-3;  // of the energy at the beginning

/// Energy over the accepted steps, trapezoidal rule.
class EnergyBook {
 public:
  EnergyBook(const ArmModel& arm, const SimTK::State& state)
      : arm_(arm), begin_(arm.system().calcEnergy(state)), time_(state.getTime()) {}

  void add(const SimTK::State& state) {
    const double damping = arm_.dampingPower(state);
    const double contact = arm_.contactPower(state);
    const double half = 0.5 * (state.getTime() - time_);
    damped_ += half * (damping + damping_power_);
    contact_work_ += half * (contact + contact_power_);
    damping_power_ = damping;
    contact_power_ = contact;
    time_ = state.getTime();
    largest_contact_work_ = std::max(largest_contact_work_, contact_work_);
    const double missing = arm_.system().calcEnergy(state) + damped_ - contact_work_ - begin_;
    largest_error_ = std::max(largest_error_, std::abs(missing));
  }

  double begin() const { return begin_; }
  double contactWork() const { return contact_work_; }
  double largestContactWork() const {
    return largest_contact_work_;
  }  ///< > 0: contacts gave more than they took
  double largestError() const { return largest_error_; }

 private:
  const ArmModel& arm_;
  double begin_;
  double time_;
  double damping_power_ = 0.0;
  double contact_power_ = 0.0;
  double damped_ = 0.0;
  double contact_work_ = 0.0;
  double largest_contact_work_ = 0.0;
  double largest_error_ = 0.0;
};

void printRow(const ArmModel& arm, const SimTK::State& state) {
  const SimbodyContact& contact = arm.contact();
  std::size_t regions = 0;
  double depth = 0.0;
  double pressure = 0.0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (std::size_t pair = 0; pair < contact.pairCount(); ++pair) {
    force += contact.contacts(pair).on_b_in_a.force;
    for (const ContactRegion& region : contact.contacts(pair).regions) {
      ++regions;
      depth = std::max(depth, region.overlap.depth);
      if (region.largest_pressure > pressure) pressure = region.largest_pressure;
    }
  }
  std::printf("%.3f", state.getTime());
  for (std::size_t k = 0; k < kJoints; ++k) std::printf(",%.5f", arm.angle(state, k));
  std::printf(",%zu,%.2f,%.3f,%.1f\n", regions, force.norm(), 1e3 * depth, 1e-3 * pressure);
}

bool isAtRest(const ArmModel& arm, const SimTK::State& state) {
  const JointTorques torques = arm.torques(state);
  double largest = 0.0;
  double rest = 0.0;
  for (std::size_t k = 0; k < kJoints; ++k) {
    std::printf("%-10s contact %+8.3f, gravity %+8.3f, drive %+8.3f N m\n", kJointNames[k],
                torques.contact[k], torques.gravity[k], torques.drive[k]);
    largest = std::max({largest, std::abs(torques.contact[k]), std::abs(torques.drive[k])});
    rest = std::max(rest, std::abs(torques.contact[k] + torques.gravity[k] + torques.drive[k]));
  }
  const bool holds = rest < kTorqueTolerance * largest;
  std::printf("equilibrium %s: %.2e of the largest torque is left\n", holds ? "holds" : "FAILS",
              rest / largest);
  return holds;
}

bool isPassive(const EnergyBook& book) {
  const double allowed = kEnergyTolerance * book.begin();
  const bool holds = book.largestContactWork() < allowed && book.largestError() < allowed;
  std::printf(
      "energy %s: %.2f J at first, contacts took %.3f J and never gave more than %.1e J, error %.1e J\n",
      holds ? "holds" : "FAILS", book.begin(), -book.contactWork(), book.largestContactWork(),
      book.largestError());
  return holds;
}

}  // namespace

int main(int argc, char** argv) try {
  const double end = argc > 1 ? std::atof(argv[1]) : 2.0;
  ArmModel arm;
  SimTK::RungeKuttaMersonIntegrator integrator(arm.system());
  integrator.setAccuracy(kAccuracy);
  integrator.setMaximumStepSize(kLargestStep);
  integrator.setReturnEveryInternalStep(true);
  integrator.setAllowInterpolation(false);
  integrator.initialize(arm.start());
  EnergyBook book(arm, integrator.getState());

  std::printf("time,turret,shoulder,elbow,wrist,regions,force_N,depth_mm,largest_pressure_kPa\n");
  double next_row = 0.0;
  while (integrator.getTime() < end) {
    integrator.stepTo(end);
    const SimTK::State& state = integrator.getState();
    arm.system().realize(state, SimTK::Stage::Velocity);
    arm.contact().accept(state);
    book.add(state);
    if (state.getTime() < next_row) continue;
    printRow(arm, state);
    next_row += kRowEvery;
  }
  std::printf("%d steps, %d tried\n", integrator.getNumStepsTaken(), integrator.getNumStepsAttempted());
  const bool rests = isAtRest(arm, integrator.getState());
  const bool passive = isPassive(book);
  return rests && passive ? 0 : 1;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "arm_and_shelf: %s\n", problem.what());
  return 2;
}

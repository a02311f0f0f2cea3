#include <cmath>

#include "benchmark/contact_scenes.h"
#include "benchmark/support/contact_stage.h"
#include "concave_distance/mesh/surface/primitives.h"

namespace concave_distance::benchmark {
namespace {

using test::at;

/// A cube that tumbles in the cavity of another, both free: they meet again and again.
void momentum(SceneReport& report) {
  const std::uint64_t wanted = 100000;
  ContactStage stage;
  stage.effects = effectsOf(NormalForceModel::HuntCrossley, FrictionModel::Bristle);
  const Eigen::Vector3d slow(0.1, -0.2, 0.05);
  const Eigen::Vector3d fast(2.0, 1.0, -0.7);
  SimulatedBodySettings& outer = stage.addFree("hollow", makeHollowCube(0.4, 0.3), 2.0, at(0, 0, 0));
  outer.velocity = slow;
  outer.angular_velocity = {0.3, 0.1, -0.2};
  SimulatedBodySettings& inner = stage.addFree("inside", makeBox({0.1, 0.1, 0.1}), 1.0, at(0.02, 0.01, 0.0));
  inner.velocity = fast;
  inner.angular_velocity = {3.0, -5.0, 2.0};
  stage.letMeet("hollow", "inside");
  stage.settings.gravity.setZero();
  SceneRun run(stage.simulation(), 1e6, report);
  const Eigen::Vector3d linear = run.simulation().momentum();
  const Eigen::Vector3d angular = run.simulation().angularMomentum();
  const double scale = 2.0 * slow.norm() + fast.norm();
  double largest = 0.0;
  double largest_angular = 0.0;
  while (run.step()) {
    largest = std::max(largest, (run.simulation().momentum() - linear).norm());
    largest_angular = std::max(largest_angular, (run.simulation().angularMomentum() - angular).norm());
    if (run.simulation().counters().steps == wanted) run.stop("1e5 steps");
  }
  const RunFigures figures = run.figures();
  report.atMost({"change of momentum in 1e5 steps over all m v", "1", largest / scale}, 1e-11,
                "no outer force; roundings", figures);
  // Far from the origin it is the roundings of place times momentum that show.
  const double reach = 0.1 + run.body(0).centre.norm();
  report.atMost(
      {"change of angular momentum over all m v times the path", "1", largest_angular / (scale * reach)},
      1e-11, "no outer torque; roundings", figures);
  report.note({"steps in contact", "1", static_cast<double>(run.simulation().counters().contact_steps)},
              figures);
}

/// Largest error against z0 cos(w t) of a box that swings on a bed of springs, at constant steps.
double swingError(double step, const SceneReport& report) {
  const double side = 0.1;
  const double foundation = 1e7;
  ContactStage stage;
  stage.material.dissipation = 0.0;
  stage.effects = effectsOf(NormalForceModel::ElasticFoundation);
  stage.effects.normal_force->foundation_stiffness = foundation;
  stage.addGround();
  const double stiffness = foundation * side * side;
  const double settled = kGravity / stiffness;  // 1 kg
  const double rest = 0.5 * side - settled;
  stage.addFree("box", makeBox({side, side, side}), 1.0, at(0, 0, rest + 0.5 * settled));
  stage.letMeet("ground", "box");
  stage.settings.largest_step = step;
  stage.settings.step_fraction = 1.0;
  stage.settings.allowed_penetration = 1.0;
  const double frequency = std::sqrt(stiffness);
  const double duration = 4.0 * kPi / frequency;
  SceneRun run(stage.simulation(), duration, report);
  double largest = 0.0;
  while (run.step()) {
    const double expected = rest + 0.5 * settled * std::cos(frequency * run.time());
    largest = std::max(largest, std::abs(run.body(1).centre.z() - expected));
  }
  return run.figures().end == RunEnd::Complete ? largest : kNotComputed;
}

void order(SceneReport& report) {
  const double step = 4e-4;  // a fiftieth of the period
  const double coarse = swingError(step, report);
  const double fine = swingError(0.5 * step, report);
  report.equals({"order of convergence; a box that swings on springs", "1", std::log2(coarse / fine)}, 2.0,
                0.1, "log2 of the errors at h and h/2");
  report.note({"largest error at a fiftieth of the period", "um", 1e6 * coarse});
}

/// A box that is pulled over the ground by a load and a drive, with friction and damping.
void works(SceneReport& report) {
  ContactStage stage;
  stage.material.dissipation = 20.0;
  stage.effects = effectsOf(NormalForceModel::ElasticFoundation, FrictionModel::Bristle);
  stage.effects.normal_force->foundation_stiffness = 2e6;
  stage.addGround();
  SimulatedBodySettings& box = stage.addFree("box", makeBox({0.2, 0.2, 0.1}), 1.0, at(0, 0, 0.055));
  AppliedLoad load;
  load.force = {8.0, 0.0, 0.0};
  load.until = 0.5;
  box.loads = {load};
  CompliantDrive drive;
  drive.stiffness = {0.0, 50.0, 0.0};
  drive.damping = {0.0, 2.0, 0.0};
  drive.target = {{0.0, at(0, 0, 0)}, {1.0, at(0, 0.5, 0)}};
  box.drive = drive;
  stage.letMeet("ground", "box");
  SceneRun run(stage.simulation(), 1.5, report);
  while (run.step()) continue;
  const RunFigures figures = run.figures();
  report.atMost({"energy balance over the energy turned over", "1", figures.balance_share}, 1e-3,
                "every work booked; order 2", figures);
}

}  // namespace

ContactScenes balanceScenes() {
  return {{"momentum", "a cube that tumbles in the cavity of another", momentum},
          {"order_of_convergence", "a box that swings on a bed of springs", order},
          {"works", "a box pulled by a load and a drive", works}};
}

}  // namespace concave_distance::benchmark

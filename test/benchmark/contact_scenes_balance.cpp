#include <algorithm>
#include <cmath>
#include <vector>

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

constexpr double kCoarse = 6e-4;  // a hundredth of the period

/// Heights of an exact ball of 1 kg that swings on a bed of springs, at constant steps, after each kCoarse.
std::vector<double> swing(double step, const SceneReport& report) {
  const double radius = 0.1;
  const double foundation = 1e7;
  ContactStage stage;
  stage.material.dissipation = 0.0;
  stage.effects = effectsOf(NormalForceModel::ElasticFoundation);
  stage.effects.normal_force->foundation_stiffness = foundation;
  stage.addGround();
  // The foundation times the cap's volume, about pi R d^2, bears the weight.
  const double settled = std::sqrt(kGravity / (foundation * kPi * radius));
  const double stiffness = 2.0 * kGravity / settled;
  RoundShape ball;
  ball.radius = radius;
  ball.chord_error = 0.01 * radius;
  stage.addFree("ball", ball, 1.0, at(0, 0, radius - 0.7 * settled));
  stage.letMeet("ground", "ball");
  stage.settings.largest_step = step;
  stage.settings.step_fraction = 1.0;
  stage.settings.allowed_penetration = 1.0;
  const double duration = 4.0 * kPi / std::sqrt(stiffness);
  SceneRun run(stage.simulation(), duration, report);
  std::vector<double> heights;
  while (run.step()) {
    while (run.time() > (static_cast<double>(heights.size()) + 0.999) * kCoarse) {
      heights.push_back(run.body(1).centre.z());
    }
  }
  return heights;
}

double largestDifference(const std::vector<double>& l, const std::vector<double>& r) {
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(l.size(), r.size()); ++i)
    largest = std::max(largest, std::abs(l[i] - r[i]));
  return largest;
}

/// Each against half of its step.
void order(SceneReport& report) {
  const std::vector<double> coarse = swing(kCoarse, report);
  const std::vector<double> middle = swing(0.5 * kCoarse, report);
  const std::vector<double> fine = swing(0.25 * kCoarse, report);
  const double difference = largestDifference(coarse, middle);
  report.equals({"order of convergence; a ball that swings on springs", "1",
                 std::log2(difference / largestDifference(middle, fine))},
                2.0, 0.1, "log2 of the differences between h and h/2 and between h/2 and h/4");
  report.note(
      {"largest difference between a hundredth and a two-hundredth of the period", "um", 1e6 * difference});
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
          {"order_of_convergence", "a ball that swings on a bed of springs", order},
          {"works", "a box pulled by a load and a drive", works}};
}

}  // namespace concave_distance::benchmark

#include <cmath>

#include "benchmark/contact_scenes.h"
#include "benchmark/support/contact_stage.h"
#include "concave_distance/mesh/surface/primitives.h"

namespace concave_distance::benchmark {
namespace {

using test::at;

constexpr double kFriction = 0.4;
constexpr double kLastShare = 0.01;  // of the spin at the start: then a body counts as stopped

struct Stop {
  double halfway = kNotComputed;  ///< share of the spin that is left at a given time
  double time = kNotComputed;     ///< when the spin falls to its last share; NaN if it does not
  RunFigures figures;
};

/// Of a body that spins about the vertical.
Stop stopOf(const ContactStage& stage, std::size_t body, double halfway, const SceneReport& report) {
  SceneRun run(stage.simulation(), 1.0, report);
  const double spin = run.body(body).angular_velocity.z();
  Stop stop;
  run.advanceTo(halfway);
  stop.halfway = run.body(body).angular_velocity.z() / spin;
  double time_before = run.time();
  double before = run.body(body).angular_velocity.z();
  while (run.step()) {
    const double now = run.body(body).angular_velocity.z();
    if (now <= kLastShare * spin) {
      // It falls linearly within the step.
      const double share = before > now ? (before - kLastShare * spin) / (before - now) : 1.0;
      stop.time = time_before + share * (run.time() - time_before);
      run.stop("it has stopped");
    }
    time_before = run.time();
    before = now;
  }
  stop.figures = run.figures();
  return stop;
}

void reportStop(const Stop& stop, double expected, double bound, const std::string& formula,
                SceneReport& report) {
  report.equals({"spin left after half of the expected time", "1", stop.halfway}, 0.5, 0.5 * bound,
                "it falls linearly", stop.figures);
  const double last = (1.0 - kLastShare) * expected;
  report.equals({"until 99 % of the spin is lost", "s", stop.time}, last, bound * last, formula,
                stop.figures);
}

/// Uniform pressure p = m g / (pi R^2): the torque is mu p times the integral of r over the disc, 2/3 mu m g
/// R; with I = m R^2 / 2 it stops after 3/4 R w / (mu g).
void spinningDisc(SceneReport& report, FrictionModel friction) {
  const double radius = 0.1;
  const double height = 0.02;
  const double mass = 1.0;
  const double spin = 10.0;
  ContactStage stage = bedStage(friction);
  stage.material.static_friction = stage.material.dynamic_friction = kFriction;
  stage.addGround();
  const double settled =
      mass * kGravity / (stage.effects.normal_force->foundation_stiffness * kPi * radius * radius);
  stage.addFree("disc", makeCylinder(radius, height, 1e-4), mass, at(0, 0, 0.5 * height - settled))
      .angular_velocity = {0.0, 0.0, spin};
  stage.letMeet("ground", "disc");
  const double expected = 0.75 * radius * spin / (kFriction * kGravity);
  reportStop(stopOf(stage, 1, 0.5 * expected, report), expected, 0.02, "3/4 R w / (mu g) of 99 %", report);
}

/// Of a square of side a the mean distance from its middle is a (sqrt 2 + ln(1 + sqrt 2)) / 6.
double meanRadiusOfSquare(double side) {
  return side * (std::sqrt(2.0) + std::log(1.0 + std::sqrt(2.0))) / 6.0;
}

/// From flush faces, or from where the boxes rest on their beds.
void twistingBoxes(SceneReport& report, bool settled) {
  const double side = 0.1;
  const double spin = 5.0;
  ContactStage stage = bedStage(FrictionModel::Bristle);
  stage.material.static_friction = stage.material.dynamic_friction = kFriction;
  stage.addGround();
  stage.addTower(2, side, 1.0);
  if (settled) {
    SceneRun run(stage.simulation(), 1.0, report);
    run.advanceTo(1.0);
    for (std::size_t k = 1; k <= 2; ++k) stage.settings.bodies[k].pose = run.body(k).world_from_body;
  }
  stage.settings.bodies.back().angular_velocity = {0.0, 0.0, spin};
  const double inertia = side * side / 6.0;  // over the mass
  const double expected = inertia * spin / (kFriction * kGravity * meanRadiusOfSquare(side));
  reportStop(stopOf(stage, 2, 0.5 * expected, report), expected, 0.05,
             settled ? "I w / (mu m g mean r) of 99 %; the lower box: 5 %"
                     : "I w / (mu m g mean r) of 99 %; settling and the lower box: 5 %",
             report);
}

/// Pulled by 2 N +- 1 N at 25 Hz where the bristles hold 4.9 N. The load is constant within a millisecond.
void swingingLoad(SceneReport& report) {
  const double duration = 20.0;
  const double settling = 2.0;
  ContactStage stage = bedStage(FrictionModel::Bristle);
  stage.addGround();
  stage.addTower(1, 0.1, 1.0);
  SceneRun run(stage.simulation(), duration, report);
  // Whole periods of the load.
  MeanPlace settled(settling, settling + 1.0);
  MeanPlace last(duration - 1.0, duration);
  for (int i = 0; i < std::lround(1e3 * duration); ++i) {
    Wrench pull;
    pull.force.x() = 2.0 + std::sin(2.0 * kPi * 25.0 * (1e-3 * i + 0.5e-3));
    run.simulation().setExternalWrench(1, pull);
    while (run.time() < 1e-3 * (i + 1) && run.step(1e-3 * (i + 1))) {
      settled.add(run.time(), run.lastStep(), run.body(1).centre);
      last.add(run.time(), run.lastStep(), run.body(1).centre);
    }
  }
  run.step();
  const RunFigures figures = run.figures();
  const double seconds = duration - settling - 1.0;
  report.atMost({"creep rate under 2 N +- 1 N at 25 Hz; limit 4.9 N", "um/s",
                 1e6 * (last.mean() - settled.mean()).x() / seconds},
                1.0, "held", run.figures());
}

}  // namespace

ContactScenes frictionScenes() {
  ContactScenes scenes;
  for (const FrictionModel friction : {FrictionModel::RegularisedCoulomb, FrictionModel::Bristle}) {
    scenes.push_back({"spinning_disc_" + std::string(toString(friction)), "a disc on a plane",
                      [friction](SceneReport& report) { spinningDisc(report, friction); }});
  }
  for (const bool settled : {false, true}) {
    scenes.push_back(
        {settled ? "twisting_boxes_settled" : "twisting_boxes",
         settled ? "a box that rests on another and begins to spin" : "a box spinning on another",
         [settled](SceneReport& report) { twistingBoxes(report, settled); }});
  }
  scenes.push_back({"swinging_load", "bristles under a load that swings", swingingLoad});
  return scenes;
}

}  // namespace concave_distance::benchmark

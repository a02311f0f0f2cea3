#include <algorithm>
#include <cmath>
#include <string>

#include "benchmark/contact_scenes.h"
#include "benchmark/support/contact_stage.h"
#include "simulation/elastic_ball.h"

namespace concave_distance::benchmark {
namespace {

using test::ElasticBall;

std::string scaleOf(const ElasticBall& ball) {
  if (ball.radius < 1e-2) return "1mm";
  return ball.radius > 10.0 ? "100m" : "1m";
}

std::string nameOf(const std::string& scene, const ElasticBall& ball) {
  return scene + "_" + scaleOf(ball) + "_" + std::string(toString(ball.friction));
}

void bounces(SceneReport& report, const ElasticBall& ball) {
  const double fall = 3.0 * ball.radius;
  SceneRun run(ball.overPlane(fall).simulation(), 12.0 * std::sqrt(8.0 * fall / kGravity), report);
  int count = 0;
  double height = kNotComputed;
  double before = 0.0;
  while (count < 10 && run.step()) {
    const SimulatedBody& body = run.body(1);
    if (before > 0.0 && !(body.velocity.z() > 0.0)) {
      ++count;
      // Steps end beside the top.
      height = body.centre.z() + 0.5 * body.velocity.z() * body.velocity.z() / kGravity - ball.radius;
    }
    before = body.velocity.z();
    if (count == 10) run.stop("all bounces");
  }
  report.equals(
      {"height of the tenth bounce over the first", "1", count == 10 ? height / fall : kNotComputed}, 1.0,
      0.01, "no loss", run.figures());
}

/// Reports what body `rolling`, given half the root of its radius as its speed, keeps of that for 10 s.
template <typename Build>
void keepsItsSpeed(SceneReport& report, const ElasticBall& ball, std::size_t rolling, const Build& build) {
  const double speed = 0.5 * std::sqrt(ball.radius);
  const double duration = 10.0;
  SceneRun run(build(speed, duration).simulation(), duration, report);
  run.advanceTo(duration);
  const double kept = run.step() ? kNotComputed : run.body(rolling).velocity.x() / speed;
  report.equals({"speed after 10 s over the first", "1", kept}, 1.0, 0.01, "no loss", run.figures());
}

void rolls(SceneReport& report, const ElasticBall& ball) {
  keepsItsSpeed(report, ball, 1, [&](double speed, double time) { return ball.rollingOnPlane(speed, time); });
}

/// Swings: the largest kinetic energy of the last quarter over that of the first. A swing in a bowl for a
/// ball of 100 m takes longer than 10 s.
void rollsInBowl(SceneReport& report, const ElasticBall& ball) {
  const double duration = 10.0 * std::max(1.0, std::sqrt(ball.radius));
  SceneRun run(ball.inBowl(0.3).simulation(), duration, report);
  double first = 0.0;
  double last = 0.0;
  while (run.step()) {
    const double kinetic = run.simulation().energy().kinetic;
    if (run.time() < 0.25 * duration) first = std::max(first, kinetic);
    if (run.time() > 0.75 * duration) last = std::max(last, kinetic);
  }
  report.equals({"largest kinetic energy in a bowl; last quarter over the first", "1", last / first}, 1.0,
                0.01, "no loss", run.figures());
  report.atMost({"energy balance over the largest kinetic energy", "1",
                 run.simulation().energy().balanceError() / run.simulation().energy().largest_kinetic},
                0.01, "1 %", run.figures());
}

/// Of the energy before: what is left after two free balls met off their centres by this share of their
/// diameter, turning like gears.
double keptInCollision(SceneReport& report, const ElasticBall& ball, double share, bool fine,
                       RunFigures& figures) {
  const double speed = 0.1 * std::sqrt(6.0 * kGravity * ball.radius);
  test::SceneBuilder builder = ball.meeting(3.0 * ball.radius, 2.0 * share * ball.radius, speed);
  if (fine) {
    builder.settings.step_fraction = 0.02;
    builder.settings.work_tolerance = 1e-5;
    builder.settings.largest_step = 1e-3 * ball.radius / speed;
  }
  const double duration = 4.0 * ball.radius / speed;
  SceneRun run(builder.simulation(), duration, report);
  const double energy = run.simulation().energy().kinetic;
  run.advanceTo(duration);
  if (!fine) figures = run.figures();
  return run.simulation().energy().kinetic / energy;
}

/// The contact sinks in, so that something slides: friction's own loss is that of short steps.
void collidesOffCentre(SceneReport& report, const ElasticBall& ball) {
  double largest = 0.0;
  RunFigures figures;
  for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const double kept = keptInCollision(report, ball, share, false, figures);
    const double expected = keptInCollision(report, ball, share, true, figures);
    largest = std::max(largest, std::abs(kept - expected));
  }
  report.atMost({"largest difference of five collisions from short steps over the energy", "1", largest},
                1e-3, "1 % in ten", figures);
}

void rollsOnFree(SceneReport& report, const ElasticBall& ball) {
  keepsItsSpeed(report, ball, 2,
                [&](double speed, double time) { return ball.rollingOnFreePlate(speed, time); });
}

}  // namespace

ContactScenes elasticScenes() {
  ContactScenes scenes;
  for (const double radius : {1e-3, 1.0, 100.0}) {
    for (const FrictionModel friction :
         {FrictionModel::None, FrictionModel::Bristle, FrictionModel::RegularisedCoulomb}) {
      const ElasticBall ball{radius, friction};
      scenes.push_back({nameOf("elastic_bounces", ball), "an exact ball that falls by three times its radius",
                        [ball](SceneReport& report) { bounces(report, ball); }});
      scenes.push_back({nameOf("elastic_rolling", ball), "an exact ball on a plane",
                        [ball](SceneReport& report) { rolls(report, ball); }});
      scenes.push_back({nameOf("elastic_free_collisions", ball),
                        "two free exact balls that meet off their centres",
                        [ball](SceneReport& report) { collidesOffCentre(report, ball); }});
      scenes.push_back({nameOf("elastic_free_rolling", ball), "an exact ball on a free plate on a floor",
                        [ball](SceneReport& report) { rollsOnFree(report, ball); }});
      if (friction == FrictionModel::RegularisedCoulomb) continue;  // it creeps where it is held back
      const ElasticBall scaled{radius, friction, 0.1 / radius};
      scenes.push_back({nameOf("elastic_bowl", scaled),
                        "an exact ball that swings in a bowl, with bristles to scale",
                        [scaled](SceneReport& report) { rollsInBowl(report, scaled); }});
    }
  }
  return scenes;
}

}  // namespace concave_distance::benchmark

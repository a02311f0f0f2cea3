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

void rolls(SceneReport& report, const ElasticBall& ball) {
  const double speed = 0.5 * std::sqrt(ball.radius);
  const double duration = 10.0;
  SceneRun run(ball.rollingOnPlane(speed, duration).simulation(), duration, report);
  run.advanceTo(duration);
  const bool complete = !run.step();
  report.equals(
      {"speed after 10 s over the first", "1", complete ? run.body(1).velocity.x() / speed : kNotComputed},
      1.0, 0.01, "no loss", run.figures());
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
  report.equals({"largest kinetic energy in a bowl, last quarter over the first", "1", last / first}, 1.0,
                0.01, "no loss", run.figures());
  report.atMost({"energy balance over the largest kinetic energy", "1",
                 run.simulation().energy().balanceError() / run.simulation().energy().largest_kinetic},
                0.01, "1 %", run.figures());
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

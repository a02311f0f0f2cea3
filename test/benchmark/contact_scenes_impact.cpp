#include <cmath>
#include <vector>

#include "benchmark/contact_scenes.h"
#include "benchmark/support/contact_stage.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/hunt_crossley_rebound.h"

namespace concave_distance::benchmark {
namespace {

using test::at;

/// A ball of 0.5 kg and 50 mm radius against a wall of 1 mm, without gravity. @return where it ends
SimulatedBody throwAtWall(NormalForceModel model, double speed, const SceneReport& report,
                          RunFigures& figures) {
  ContactStage stage;
  stage.effects = effectsOf(model);
  stage.addFixed("wall", makeBox({1.0, 1.0, 0.001}), at(0, 0, 0));
  stage.addFree("ball", makeSphere(0.05, 0.0005), 0.5, at(0, 0, 0.06)).velocity = {0.0, 0.0, -speed};
  stage.letMeet("wall", "ball");
  stage.settings.gravity.setZero();
  SceneRun run(stage.simulation(), 0.1, report);
  while (run.step()) {
    if (std::abs(run.body(1).centre.z()) > 0.07) run.stop("the ball has left the wall");
  }
  figures = run.figures();
  return run.body(1);
}

void thinWall(SceneReport& report, double speed) {
  RunFigures figures;
  for (const NormalForceModel model : {NormalForceModel::HuntCrossley, NormalForceModel::SpringDashpot,
                                       NormalForceModel::ElasticFoundation}) {
    const SimulatedBody ball = throwAtWall(model, speed, report, figures);
    const std::string with = "; " + std::string(toString(model));
    report.atMost({"passes the wall" + with, "1", ball.centre.z() < 0.0 ? 1.0 : 0.0}, 0.0,
                  "a wall stops what it can carry", figures);
    if (model == NormalForceModel::ElasticFoundation) continue;  // no closed form where the ball is so deep
    const double expected = model == NormalForceModel::SpringDashpot
                                ? speed
                                : test::huntCrossleyRebound(speed, Material().dissipation);
    report.equals({"speed of the rebound" + with, "m/s", ball.velocity.z()}, expected, 0.05 * expected,
                  "the force law", figures);
  }
}

/// Highest places of the centre after each bounce.
struct Bounces {
  std::vector<double> heights;
  double highest = 0.0;
};

Bounces bounce(SceneRun& run, std::size_t wanted) {
  Bounces bounces;
  double before = run.body(1).velocity.z();
  while (run.step()) {
    const SimulatedBody& ball = run.body(1);
    bounces.highest = std::max(bounces.highest, ball.centre.z());
    if (before > 0.0 && !(ball.velocity.z() > 0.0)) bounces.heights.push_back(ball.centre.z());
    before = ball.velocity.z();
    if (bounces.heights.size() == wanted) run.stop("all bounces");
  }
  return bounces;
}

enum class Ball { Mesh, Solid };

ContactStage steelStage(double radius, double height, Ball kind = Ball::Mesh) {
  ContactStage stage;
  stage.material.youngs_modulus = 2.1e11;
  stage.material.poissons_ratio = 0.3;
  stage.effects = effectsOf(NormalForceModel::Hertz);
  stage.addGround();
  const double mass = 7850.0 * 4.0 / 3.0 * kPi * radius * radius * radius;
  if (kind == Ball::Mesh) {
    stage.addFree("ball", makeSphere(radius, 0.01 * radius), mass, at(0, 0, height));
  } else {
    RoundShape shape;
    shape.radius = radius;
    shape.chord_error = 0.01 * radius;
    stage.addFree("ball", shape, mass, at(0, 0, height));
  }
  stage.letMeet("ground", "ball");
  return stage;
}

/// Steel falls onto steel, without loss.
void steelBall(SceneReport& report, double radius, double fall, Ball kind) {
  const std::size_t wanted = 10;
  const ContactStage stage = steelStage(radius, radius + fall, kind);
  SceneRun run(stage.simulation(), 20.0, report);
  const Bounces bounces = bounce(run, wanted);
  double largest_gain = 0.0;
  double largest_loss = 0.0;
  double before = radius + fall;
  for (const double height : bounces.heights) {
    largest_gain = std::max(largest_gain, height - before);
    largest_loss = std::max(largest_loss, before - height);
    before = height;
  }
  const RunFigures figures = run.figures();
  const double last = bounces.heights.size() == wanted ? bounces.heights.back() - radius : kNotComputed;
  report.equals({"height of the tenth bounce; hertz", "m", last}, fall, 0.01 * fall,
                "no loss: the height before", figures);
  const double weight = *stage.settings.bodies.back().mass * kGravity;
  const std::string bound = "0.1 % of the " + std::to_string(weight * fall) + " J that it fell with";
  report.atMost({"largest gain in one bounce", "J", weight * largest_gain}, 1e-3 * weight * fall, bound,
                figures);
  report.atMost({"largest loss in one bounce", "J", weight * largest_loss}, 1e-3 * weight * fall, bound,
                figures);
  report.atMost({"energy balance at the end", "J", run.simulation().energy().balanceError()},
                1e-2 * weight * fall, "1 % of what it fell with", figures);
}

/// Without an overlap and at rest there is no energy to hop with.
void flushBoxes(SceneReport& report) {
  ContactStage stage;
  stage.effects = effectsOf(NormalForceModel::Hertz);
  stage.addGround();
  stage.addTower(3, 0.1, 1.0);
  SceneRun run(stage.simulation(), 2.0, report);
  double hop = 0.0;
  while (run.step()) {
    for (std::size_t i = 1; i <= 3; ++i) {
      hop = std::max(hop, run.body(i).centre.z() - 0.1 * (static_cast<double>(i) - 0.5));
    }
  }
  report.atMost({"largest hop; three flush boxes of 1 kg; hertz", "mm", 1e3 * hop}, 0.01,
                "at rest without overlap", run.figures());
}

/// A ball of steel whose steps may go 0.05 m too far.
void wideAllowance(SceneReport& report) {
  const double height = 0.4;
  ContactStage stage = steelStage(0.1, height);
  stage.settings.allowed_penetration = 0.05;
  SceneRun run(stage.simulation(), 5.0, report);
  double highest = 0.0;
  while (run.step()) highest = std::max(highest, run.body(1).centre.z());
  report.equals({"highest place; allowed_penetration 0.05", "m", highest}, height, 0.01 * height,
                "where it began", run.figures());
}

}  // namespace

ContactScenes impactScenes() {
  ContactScenes scenes;
  for (const int speed : {5, 10, 20}) {
    const std::string text = std::to_string(speed) + " m/s";
    scenes.push_back({"thin_wall_" + std::to_string(speed), "a ball of 0.5 kg against 1 mm at " + text,
                      [speed](SceneReport& report) { thinWall(report, speed); }});
  }
  scenes.push_back({"steel_ball", "ten bounces of a ball of 50 mm radius that falls by 1.8 m: 73 J",
                    [](SceneReport& report) { steelBall(report, 0.05, 1.8, Ball::Mesh); }});
  scenes.push_back({"small_steel_ball", "ten bounces of a ball of 20 mm radius that falls by 0.38 m: 1 J",
                    [](SceneReport& report) { steelBall(report, 0.02, 0.38, Ball::Mesh); }});
  scenes.push_back({"steel_ball_exact", "the same of 50 mm radius as an exact sphere",
                    [](SceneReport& report) { steelBall(report, 0.05, 1.8, Ball::Solid); }});
  scenes.push_back({"small_steel_ball_exact", "the same of 20 mm radius as an exact sphere",
                    [](SceneReport& report) { steelBall(report, 0.02, 0.38, Ball::Solid); }});
  scenes.push_back({"three_flush_boxes", "hop as they settle", flushBoxes});
  scenes.push_back({"wide_allowance", "a steel ball whose steps may go 0.05 m too far", wideAllowance});
  return scenes;
}

}  // namespace concave_distance::benchmark

#include <cmath>
#include <vector>

#include "benchmark/contact_scenes.h"
#include "benchmark/support/contact_stage.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/hunt_crossley_rebound.h"

namespace concave_distance::benchmark {
namespace {

using test::at;
using test::PressedBall;
using test::pressureRebound;

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

/// Of the wall as thick as need be: how much is left depends on the law of damping alone, not on the
/// stiffness.
void reportRebound(SceneReport& report, NormalForceModel model, double speed, double found,
                   const RunFigures& figures) {
  const std::string what = "speed of the rebound; " + std::string(toString(model));
  if (model == NormalForceModel::SpringDashpot) {
    report.equals({what, "m/s", found}, speed, 0.05 * speed, "no loss", figures);
    return;
  }
  const double lumped = test::huntCrossleyRebound(speed, Material().dissipation);
  report.equals({what, "m/s", found}, lumped, 0.05 * lumped, "m v dv/dx = -f(x) (1 + 3/2 c v) in closed form",
                figures);
  const PressedBall ball{0.05, 0.5, ContactStage().contactMaterial().contact_modulus};
  const double by_place = pressureRebound(ball, speed, Material().dissipation);
  report.equals({what + " by place", "m/s", found}, by_place, 0.05 * by_place,
                "the same of pressures on ball and plane; integrated", figures);
}

void thinWall(SceneReport& report, double speed) {
  RunFigures figures;
  for (const NormalForceModel model : {NormalForceModel::HuntCrossley, NormalForceModel::SpringDashpot,
                                       NormalForceModel::ElasticFoundation}) {
    const SimulatedBody ball = throwAtWall(model, speed, report, figures);
    report.atMost(
        {"passes the wall; " + std::string(toString(model)), "1", ball.centre.z() < 0.0 ? 1.0 : 0.0}, 0.0,
        "a wall stops what it can carry", figures);
    if (model == NormalForceModel::ElasticFoundation) continue;  // no closed form where the ball is so deep
    reportRebound(report, model, speed, ball.velocity.z(), figures);
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

/// Steel that falls onto steel.
struct Ball {
  double radius;
  double fall;         ///< metres
  double chord_error;  ///< over the radius: of its mesh
  bool exact;          ///< the mesh is for drawing alone
};

ContactStage steelStage(const Ball& ball) {
  ContactStage stage;
  stage.material.youngs_modulus = 2.1e11;
  stage.material.poissons_ratio = 0.3;
  stage.effects = effectsOf(NormalForceModel::Hertz);
  stage.addGround();
  const double radius = ball.radius;
  const double mass = 7850.0 * 4.0 / 3.0 * kPi * radius * radius * radius;
  const Eigen::Isometry3d pose = at(0, 0, radius + ball.fall);
  if (!ball.exact) {
    stage.addFree("ball", makeSphere(radius, ball.chord_error * radius), mass, pose);
  } else {
    RoundShape shape;
    shape.radius = radius;
    shape.chord_error = ball.chord_error * radius;
    stage.addFree("ball", shape, mass, pose);
  }
  stage.letMeet("ground", "ball");
  return stage;
}

/// Joules of a ball that spins and drifts sideways.
double energyAside(const SimulatedBody& ball, double mass, double radius) {
  return 0.5 * mass * ball.velocity.head<2>().squaredNorm() +
         0.2 * mass * radius * radius * ball.angular_velocity.squaredNorm();
}

/// A mesh meets the ground at a vertex up to b = sqrt(2 e R) beside its centre, e the chord error: a shock
/// there pushes a body of m / (1 + m b^2 / I) = m / (1 + 5 e / R), which leaves 1 - 20 e / R of the height.
double shareIntoSpin(const Ball& ball) {
  return ball.exact ? 0.0 : 20.0 * ball.chord_error;
}

/// Ten bounces without loss.
void steelBall(SceneReport& report, const Ball& ball) {
  const std::size_t wanted = 10;
  const ContactStage stage = steelStage(ball);
  SceneRun run(stage.simulation(), 20.0, report);
  const Bounces bounces = bounce(run, wanted);
  const double radius = ball.radius;
  const double fall = ball.fall;
  const double mass = *stage.settings.bodies.back().mass;
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
  const double aside = energyAside(run.body(1), mass, radius) / (mass * kGravity);
  report.equals({"height of the tenth bounce; hertz", "m", last}, fall, 0.01 * fall,
                "no loss: the height before", figures);
  report.equals({"the same with what is spin and motion aside", "m", last + aside}, fall, 0.01 * fall,
                "no loss: the height before", figures);
  const double weight = mass * kGravity;
  const std::string bound = "0.1 % of the " + std::to_string(weight * fall) + " J that it fell with" +
                            (ball.exact ? "" : " and 20 e/R of it into spin");
  const double most = (1e-3 + shareIntoSpin(ball)) * weight * fall;
  report.atMost({"largest gain in one bounce", "J", weight * largest_gain}, most, bound, figures);
  report.atMost({"largest loss in one bounce", "J", weight * largest_loss}, most, bound, figures);
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
  ContactStage stage = steelStage({0.1, height - 0.1, 0.01, false});
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
  const Ball large{0.05, 1.8, 0.01, false};
  const Ball small{0.02, 0.38, 0.01, false};
  scenes.push_back({"steel_ball", "ten bounces of a ball of 50 mm radius that falls by 1.8 m: 73 J",
                    [large](SceneReport& report) { steelBall(report, large); }});
  scenes.push_back({"small_steel_ball", "ten bounces of a ball of 20 mm radius that falls by 0.38 m: 1 J",
                    [small](SceneReport& report) { steelBall(report, small); }});
  for (const int finer : {10, 100}) {
    const Ball fine{small.radius, small.fall, small.chord_error / finer, false};
    scenes.push_back({"small_steel_ball_" + std::to_string(finer) + "_times_finer",
                      "the same of 20 mm with a smaller chord error",
                      [fine](SceneReport& report) { steelBall(report, fine); }});
  }
  for (const Ball& ball : {large, small}) {
    const Ball exact{ball.radius, ball.fall, ball.chord_error, true};
    scenes.push_back({ball.radius < large.radius ? "small_steel_ball_exact" : "steel_ball_exact",
                      "the same as an exact sphere",
                      [exact](SceneReport& report) { steelBall(report, exact); }});
  }
  scenes.push_back({"three_flush_boxes", "hop as they settle", flushBoxes});
  scenes.push_back({"wide_allowance", "a steel ball whose steps may go 0.05 m too far", wideAllowance});
  return scenes;
}

}  // namespace concave_distance::benchmark

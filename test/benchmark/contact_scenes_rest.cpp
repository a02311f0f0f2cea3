#include <algorithm>
#include <cmath>

#include "benchmark/contact_scenes.h"
#include "benchmark/support/contact_stage.h"
#include "concave_distance/mesh/surface/primitives.h"

namespace concave_distance::benchmark {
namespace {

using test::at;

constexpr double kSide = 0.1;     // of every cube here, metres
constexpr double kSettled = 5.0;  // s: from then on nothing may move

/// What a law makes of a flat square contact, N/m: the springs of a bed, else 4/3 E* sqrt(A / (2 pi)).
double flatStiffness(const ContactStage& stage) {
  const NormalForceSettings& normal = *stage.effects.normal_force;
  const double area = kSide * kSide;
  if (normal.model == NormalForceModel::ElasticFoundation) return normal.foundation_stiffness * area;
  return 4.0 / 3.0 * stage.contactMaterial().contact_modulus * std::sqrt(area / (2.0 * kPi));
}

/// A material and a force law for bodies that lie flat.
struct Lying {
  std::string name;
  ContactStage stage;
};

std::vector<Lying> lyingInCorner() {
  std::vector<Lying> all(4);
  all[0].name = "defaults_quasi_static";
  all[0].stage.effects = effectsOf(NormalForceModel::QuasiStatic, FrictionModel::Bristle);
  all[1].name = "quasi_static";
  all[1].stage.material.youngs_modulus = 1e7;
  all[1].stage.effects = effectsOf(NormalForceModel::QuasiStatic, FrictionModel::Bristle);
  all[1].stage.effects.normal_force->damping = 500.0;
  all[2].name = "hunt_crossley";
  all[2].stage.material.youngs_modulus = 1e7;
  all[2].stage.material.dissipation = 20.0;
  all[2].stage.effects = effectsOf(NormalForceModel::HuntCrossley, FrictionModel::Bristle);
  all[3].name = "elastic_foundation";
  all[3].stage = bedStage(FrictionModel::Bristle);
  return all;
}

/// Floor and wall in one mesh or in two, and a cube in their corner.
void addCorner(bool one_mesh, double mass, ContactStage& stage) {
  if (one_mesh) {
    stage.addFixed("corner", makeInnerCorner(), at(0, 0, 0));
  } else {
    stage.addFixed("corner", makeBox({0.6, 0.6, 0.1}), at(0.2, 0, -0.05));
    stage.addFixed("wall", makeBox({0.1, 0.6, 0.4}), at(-0.05, 0, 0.2));
  }
  stage.addFree("box", makeBox({kSide, kSide, kSide}), mass, at(0.5 * kSide, 0, 0.5 * kSide));
  stage.letMeet("corner", "box");
  if (!one_mesh) stage.letMeet("wall", "box");
}

/// 4 kg in an inner corner, pushed towards the wall with 20 N.
void corner(SceneReport& report, ContactStage stage, bool one_mesh) {
  const double duration = 30.0;
  const double mass = 4.0;
  addCorner(one_mesh, mass, stage);
  AppliedLoad load;
  load.force = {-20.0, 0.0, 0.0};
  stage.settings.bodies.back().loads = {load};
  SceneRun run(stage.simulation(), duration, report);
  const std::size_t box = stage.scene.findBody("box").value();
  MeanPlace settled(kSettled - 1.0, kSettled);
  MeanPlace last(duration - 1.0, duration);
  double sink = 0.0;
  double kinetic = 0.0;
  while (run.step()) {
    const Eigen::Vector3d& centre = run.body(box).centre;
    settled.add(run.time(), run.lastStep(), centre);
    last.add(run.time(), run.lastStep(), centre);
    sink = std::max({sink, 0.5 * kSide - centre.x(), 0.5 * kSide - centre.z()});
    kinetic = std::max(kinetic, run.simulation().energy().kinetic);
    if (centre.norm() > 1.0) run.giveUp("the box has left");
  }
  const RunFigures figures = run.figures();
  // From rest without overlap a spring is pressed in by twice what it is in equilibrium.
  const double twice = 2.0 * mass * kGravity / flatStiffness(stage);
  report.atMost({"largest sink into floor or wall", "mm", 1e3 * sink}, 1e3 * 1.1 * twice,
                "twice m g / k and a tenth", figures);
  report.atMost({"largest kinetic energy", "J", kinetic}, mass * kGravity * twice, "twice m g m g / k",
                figures);
  report.atMost({"drift from 5 s to 30 s", "um", 1e6 * (last.mean() - settled.mean()).norm()}, 1.0, "at rest",
                figures);
}

struct Rest {
  double drift = 0.0;  ///< largest of all boxes, metres
  double turn = 0.0;   ///< largest of all boxes, rad
  RunFigures figures;
};

/// Lets the free bodies, all after the ground, settle for `settling` seconds and then stand.
Rest standStill(const ContactStage& stage, double settling, double duration, const SceneReport& report) {
  SceneRun run(stage.simulation(), duration, report);
  const std::size_t count = stage.scene.bodies.size();
  std::vector<MeanPlace> settled(count, MeanPlace(settling - 0.5, settling));
  std::vector<MeanPlace> last(count, MeanPlace(duration - 0.5, duration));
  std::vector<Eigen::Quaterniond> turned(count, Eigen::Quaterniond::Identity());
  Rest rest;
  while (run.step()) {
    const bool settles = run.time() < settling;
    for (std::size_t i = 1; i < count; ++i) {
      settled[i].add(run.time(), run.lastStep(), run.body(i).centre);
      last[i].add(run.time(), run.lastStep(), run.body(i).centre);
      const Eigen::Quaterniond now(run.body(i).world_from_body.linear());
      if (settles) turned[i] = now;
      rest.turn = std::max(rest.turn, now.angularDistance(turned[i]));
      if (run.body(i).centre.norm() > 1.0) run.giveUp("a box has left");
    }
  }
  rest.figures = run.figures();
  for (std::size_t i = 1; i < count; ++i) {
    const double drift = (last[i].mean() - settled[i].mean()).norm();
    rest.drift = std::isnan(drift) ? drift : std::max(rest.drift, drift);
  }
  return rest;
}

/// Cubes of 1 kg on each other, flush.
void tower(SceneReport& report, ContactStage stage, int count, double duration, double wanted_speed) {
  stage.addGround();
  stage.addTower(count, kSide, 1.0);
  const Rest rest = standStill(stage, 2.0, duration, report);
  const std::string span = std::to_string(std::lround(duration - 2.0)) + " s";
  report.atMost({"largest drift of a box over " + span, "um", 1e6 * rest.drift}, 1.0, "at rest",
                rest.figures);
  report.atMost({"largest turn of a box over " + span, "mrad", 1e3 * rest.turn}, 0.01, "at rest",
                rest.figures);
  report.realTimeFactor(rest.figures, wanted_speed);
}

/// Stiffness of the beds, Pa/m, below which a tower of cubes buckles: a chain of links on springs K = k a^4 /
/// 12 has as many as there are joints, and of its shapes that for which the weights do most against the
/// springs' work. Power iteration with the chain's flexibility min(i, j).
double bucklingStiffness(int count, double side, double mass) {
  std::vector<double> shape(static_cast<std::size_t>(count), 1.0);
  double largest = 0.0;
  for (int iteration = 0; iteration < 1000; ++iteration) {
    std::vector<double> next(shape.size(), 0.0);
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j)
        next[static_cast<std::size_t>(i)] +=
            (std::min(i, j) + 1) * (count - j - 0.5) * shape[static_cast<std::size_t>(j)];
    }
    largest = *std::max_element(next.begin(), next.end());
    for (std::size_t i = 0; i < shape.size(); ++i) shape[i] = next[i] / largest;
  }
  return 12.0 * mass * kGravity * side * largest / std::pow(side, 4);
}

/// Five cubes on beds of a share of that stiffness, the topmost nudged.
void buckling(SceneReport& report, ContactStage stage, double share) {
  const double critical = bucklingStiffness(5, kSide, 1.0);
  stage.effects.normal_force->foundation_stiffness = share * critical;
  stage.addGround();
  stage.addTower(5, kSide, 1.0);
  stage.settings.bodies.back().angular_velocity = {0.0, 0.01, 0.0};
  SceneRun run(stage.simulation(), 20.0, report);
  double turn = 0.0;
  while (run.step() && turn < 0.2) {
    const Eigen::Quaterniond now(run.body(5).world_from_body.linear());
    turn = now.angularDistance(Eigen::Quaterniond::Identity());
  }
  report.equals(
      {"falls within 20 s on " + std::to_string(std::lround(100.0 * share)) + " % of the buckling stiffness",
       "1", turn < 0.2 ? 0.0 : 1.0},
      share < 1.0 ? 1.0 : 0.0, 0.0, "chain of links on springs", turn < 0.2 ? run.figures() : RunFigures());
}

/// The same where every niche is followed, which is the default, for its speed.
void towerWithNiches(SceneReport& report, ContactStage stage, int count, double wanted_speed) {
  stage.addGround();
  stage.addTower(count, kSide, 1.0);
  stage.settings.tracking = SimulationTracking::Niches;
  SceneRun run(stage.simulation(), 2.0, report);
  while (run.step()) continue;
  report.realTimeFactor(run.figures(), wanted_speed);
}

/// A cube of 100 kg on one of 0.1 kg.
void heavyOnLight(SceneReport& report, ContactStage stage) {
  stage.addGround();
  stage.addTower(1, kSide, 0.1);
  stage.addFree("heavy", makeBox({kSide, kSide, kSide}), 100.0, at(0, 0, 1.5 * kSide));
  stage.letMeet("box_0", "heavy");
  const Rest rest = standStill(stage, 2.0, 4.0, report);
  report.realTimeFactor(rest.figures, 1.0);
  report.atMost({"largest drift of a box over 2 s", "um", 1e6 * rest.drift}, 1.0, "at rest", rest.figures);
}

/// @param tall for five on each other @param heavy for 1 kN on a face
void addStanding(const std::string& with, const ContactStage& stage, const ContactStage& tall,
                 const ContactStage& heavy, ContactScenes& scenes) {
  scenes.push_back({"resting_box_" + with, "1 kg on the ground for 10 s",
                    [=](SceneReport& report) { tower(report, stage, 1, 10.0, 100.0); }});
  scenes.push_back({"stack_of_three_" + with, "three of 1 kg for 60 s",
                    [=](SceneReport& report) { tower(report, stage, 3, 60.0, 20.0); }});
  scenes.push_back({"stack_of_five_" + with, "five of 1 kg for 60 s",
                    [=](SceneReport& report) { tower(report, tall, 5, 60.0, kNotComputed); }});
  scenes.push_back({"heavy_on_light_" + with, "100 kg on 0.1 kg",
                    [=](SceneReport& report) { heavyOnLight(report, heavy); }});
}

}  // namespace

ContactScenes restScenes() {
  ContactScenes scenes;
  for (const bool one_mesh : {true, false}) {
    for (const Lying& lying : lyingInCorner()) {
      scenes.push_back({(one_mesh ? "corner_" : "two_body_corner_") + lying.name,
                        one_mesh ? "4 kg in the corner of one mesh" : "4 kg between a floor and a wall",
                        [=](SceneReport& report) { corner(report, lying.stage, one_mesh); }});
    }
  }
  ContactStage defaults;
  defaults.effects = effectsOf(NormalForceModel::HuntCrossley, FrictionModel::Bristle);
  addStanding("defaults", defaults, defaults, defaults, scenes);
  const ContactStage bed = bedStage(FrictionModel::Bristle);
  ContactStage stiff = bed;
  stiff.effects.normal_force->foundation_stiffness *= 100.0;
  // Five buckle on a bed of 2.5e6 Pa/m or less.
  ContactStage stiffer = bed;
  stiffer.effects.normal_force->foundation_stiffness *= 4.0;
  addStanding("bed", bed, stiffer, stiff, scenes);
  scenes.push_back({"tower_buckling", "five of 1 kg on softer and stiffer beds", [=](SceneReport& report) {
                      for (const double share : {0.8, 0.9, 1.1, 1.25}) buckling(report, bed, share);
                    }});
  scenes.push_back({"resting_box_niches", "the same with every niche",
                    [=](SceneReport& report) { towerWithNiches(report, bed, 1, 100.0); }});
  scenes.push_back({"stack_of_three_niches", "the same with every niche",
                    [=](SceneReport& report) { towerWithNiches(report, bed, 3, 20.0); }});
  return scenes;
}

}  // namespace concave_distance::benchmark

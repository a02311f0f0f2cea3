#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "concave_distance/loading/load_scene.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "simulation/scene_builder.h"

namespace concave_distance::contact_scenes_test {
namespace {

using test::at;
using test::SceneBuilder;

Scene loadConfig(const std::string& name) {
  SceneLoadOptions options;
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  Scene scene = loadSceneFile(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/config/" + name, options);
  EXPECT_TRUE(scene.problems.empty());
  return scene;
}

const TrackedNiche* findNiche(const PairSolution& solution, std::uint64_t id) {
  const auto found = std::find_if(solution.niches.begin(), solution.niches.end(),
                                  [id](const TrackedNiche& niche) { return niche.id == id; });
  return found == solution.niches.end() ? nullptr : &*found;
}

// Carretero, fig. 4.1 and sec. 4.1: the first foot hits, the body bounces and turns, the other foot hits.
TEST(ContactScenes, AfterTheBounceTheSingleMinimumIsWrongAndTheNicheOfTheOtherFootIsReady) {
  Simulation simulation(loadConfig("two_feet.yaml"));
  const SimulatedPair& pair = simulation.pairs().at(0);
  const std::uint64_t first = pair.solution.niches.at(0).id;
  const std::uint64_t second = pair.solution.niches.at(1).id;
  EXPECT_GT(pair.solution.niches[0].point_b_in_a.x(), 0.0);
  EXPECT_LT(pair.solution.niches[1].point_b_in_a.x(), 0.0);
  double first_contact = 0.0;
  double second_contact = 0.0;
  double wrong_since = 0.0;
  double known_before_contact = 0.0;
  int ready_at_the_change = -1;
  while (second_contact == 0.0 && simulation.time() < 0.2) {
    const double time_before = simulation.time();
    const bool second_was_known = findNiche(pair.solution, second) != nullptr;
    if (second_was_known && first_contact > 0.0 && known_before_contact == 0.0)
      known_before_contact = time_before;
    simulation.step();
    for (const ContactRegion& region : pair.contacts.regions) {
      if (region.id == first && first_contact == 0.0) first_contact = simulation.time();
      if (region.id == second) second_contact = simulation.time();
    }
    if (pair.single_is_wrong && wrong_since == 0.0) {
      wrong_since = simulation.time();
      ready_at_the_change = second_was_known ? 1 : 0;
      EXPECT_GT(pair.single_point_b_in_a.x(), 0.0);
      EXPECT_LT(pair.solution.point_b_in_a.x(), 0.0);
    }
  }
  EXPECT_GT(first_contact, 0.0);
  EXPECT_GT(wrong_since, first_contact);
  EXPECT_GT(second_contact, wrong_since);
  EXPECT_TRUE(pair.single_is_wrong);
  EXPECT_GT(pair.single_distance, 0.01);  // while the other foot touches
  EXPECT_EQ(ready_at_the_change, 1);
}

TEST(ContactScenes, TheTiltedPegBearsOnTwoPlacesAtOnce) {
  Simulation simulation(loadConfig("peg_in_hole.yaml"));
  simulation.advanceTo(0.15);
  const SimulatedPair& pair = simulation.pairs().at(0);
  const std::vector<ContactRegion>& regions = pair.contacts.regions;
  ASSERT_GE(regions.size(), 2U);
  // The rim's facets may divide a place; the places are on both sides of the rim, which has a radius of 20
  // mm.
  const auto across = [](const ContactRegion& l, const ContactRegion& r) {
    return l.point_in_a.y() < r.point_in_a.y();
  };
  const auto [a, b] = std::minmax_element(regions.begin(), regions.end(), across);
  EXPECT_GT((a->point_in_a - b->point_in_a).norm(), 0.01);
  EXPECT_GT(a->normal_force, 0.0);
  EXPECT_GT(b->normal_force, 0.0);
  EXPECT_NE(a->id, b->id);
  EXPECT_LT(simulation.bodies()[1].drive_wrench.force.z(), -1.0);
}

// A box on a plane under inclined gravity, with the friction angle atan 0.45.
Simulation boxOnSlope(double tangent) {
  SceneBuilder builder;
  Material material;
  material.dissipation = 20.0;
  material.static_friction = material.dynamic_friction = 0.45;
  builder.addBody("slope", makeBox({4.0, 1.0, 0.1})).material = material;
  builder.addBody("box", makeBox({0.2, 0.2, 0.1})).material = material;
  EffectSettings& effects = builder.addPair().effects;
  effects.normal_force.emplace();
  effects.normal_force->model = NormalForceModel::ElasticFoundation;
  effects.normal_force->foundation_stiffness = 2e6;
  effects.friction.model = FrictionModel::Bristle;
  builder.setFree("box", 1.0).pose = at(-1.0, 0.0, 0.1 - 1e-4);
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  builder.settings.largest_step = 1e-3;  // bristles that creep have a time scale of 3 ms
  const double angle = std::atan(tangent);
  builder.settings.gravity = 9.81 * Eigen::Vector3d(std::sin(angle), 0.0, -std::cos(angle));
  return builder.simulation();
}

TEST(ContactScenes, BelowTheFrictionAngleTheBoxStaysForGood) {
  Simulation simulation = boxOnSlope(0.45 * 0.98);
  simulation.advanceTo(0.5);
  const double place = simulation.bodies()[1].centre.x();
  simulation.advanceTo(1.0);
  // The bristles bend to 0.98 of what they bear and creep into that: ever more slowly.
  EXPECT_LT(std::abs(simulation.bodies()[1].centre.x() - place), 1e-5);
  EXPECT_LT(simulation.bodies()[1].velocity.norm(), 1e-6);
}

// With steps far longer than the bristles' time scale, which is 3 ms.
TEST(ContactScenes, ABoxOnASlopeStandsStillInDefaultSteps) {
  Simulation simulation(loadConfig("box_sticks.yaml"));
  simulation.advanceTo(1.0);
  const Eigen::Vector3d place = simulation.bodies()[1].centre;
  simulation.advanceTo(10.0);
  EXPECT_LT((simulation.bodies()[1].centre - place).norm(), 1e-12);
  EXPECT_LT(simulation.bodies()[1].velocity.norm(), 1e-12);
}

TEST(ContactScenes, AboveTheFrictionAngleItSlidesAsCoulombSays) {
  for (const double factor : {1.02, 1.5}) {
    const double tangent = 0.45 * factor;
    Simulation simulation = boxOnSlope(tangent);
    simulation.advanceTo(0.5);
    const double before = simulation.bodies()[1].velocity.x();
    simulation.advanceTo(1.0);
    const double acceleration = (simulation.bodies()[1].velocity.x() - before) / 0.5;
    const double angle = std::atan(tangent);
    const double expected = 9.81 * (std::sin(angle) - 0.45 * std::cos(angle));
    // Where it slides it rocks on its springs by a few hundredths of the normal force, which averages out.
    EXPECT_NEAR(acceleration, expected, 0.02 * expected + 0.01) << factor;
    EXPECT_LT(std::abs(simulation.energy().balanceError()),
              1e-4 * std::abs(simulation.energy().friction_work) + 1e-5);
  }
}

// Flat faces rock on each other, without damping. @return the most that the contact has given, as a share of
// the energy that the box has fallen with
double energyGivenByRocking(NormalForceModel model, ForceDistribution distribution) {
  SceneBuilder builder;
  Material material;
  material.dissipation = 0.0;
  builder.addBody("ground", makeBox({4.0, 1.0, 0.1})).material = material;
  builder.addBody("box", makeBox({0.2, 0.2, 0.1})).material = material;
  EffectSettings& effects = builder.addPair().effects;
  effects.normal_force.emplace();
  effects.normal_force->model = model;
  effects.normal_force->distribution = distribution;
  effects.normal_force->foundation_stiffness = 2e6;
  effects.normal_force->stiffness = 2e6 * 0.2 * 0.2;  // of the whole face
  builder.setFree("box", 1.0).pose = at(0.0, 0.0, 0.105) * Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitX()) *
                                     Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitY());
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  Simulation simulation = builder.simulation();
  double most = 0.0;
  while (simulation.time() < 0.5) {
    simulation.step(0.5);
    most = std::max(most, simulation.energy().normal_work);
  }
  const double fallen = 9.81 * 0.005;
  EXPECT_LT(std::abs(simulation.energy().balanceError()), 0.05 * fallen);
  return most / fallen;
}

TEST(ContactScenes, ARockingBoxIsGivenEnergyByTheGreatestDepthAndNoneByAnElasticFoundation) {
  EXPECT_GT(energyGivenByRocking(NormalForceModel::SpringDashpot, ForceDistribution::Lumped), 0.2);
  EXPECT_LT(energyGivenByRocking(NormalForceModel::ElasticFoundation, ForceDistribution::Lumped), 0.02);
  EXPECT_LT(energyGivenByRocking(NormalForceModel::ElasticFoundation, ForceDistribution::Pressure), 0.02);
}

TEST(ContactScenes, EveryFileLoadsAndMoves) {
  for (const char* name :
       {"bouncing_ball.yaml", "box_sticks.yaml", "box_slides.yaml", "insertion_simulation.yaml"}) {
    Simulation simulation(loadConfig(name));
    EXPECT_EQ(simulation.advanceTo(0.05), SimulationStatus::Ok) << name;
    EXPECT_EQ(simulation.pairs().size(), 1U) << name;
    EXPECT_GT(simulation.counters().solves, 0U) << name;
  }
}

}  // namespace
}  // namespace concave_distance::contact_scenes_test

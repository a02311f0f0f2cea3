// Meshes wholly inside exact round solids or with faces through their centre or axis (test/data/round), whose
// overlaps once had from 0 to 33 times their volume: each with its volume, through a scene and a pair's
// effects.
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

#include "concave_distance/loading/load_scene.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "support/csv_table.h"
#include "support/round_bodies.h"

namespace concave_distance::round_cases_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Body = std::shared_ptr<const BodyMesh>;

constexpr double kFoundation = 1e6;  // Pa/m
constexpr double kPromised = 1e-5;   // of the volume: doc/interference.md

const std::string& folder() {
  static const std::string path = CONCAVE_DISTANCE_TEST_DATA "/round/";
  return path;
}

Body bodyOf(const std::string& scene_file, const std::string& name) {
  static std::map<std::string, Scene> scenes;
  const auto known = scenes.find(scene_file);
  const Scene& scene =
      known != scenes.end()
          ? known->second
          : scenes.emplace(scene_file, loadSceneFile(folder() + scene_file, {})).first->second;
  return scene.bodies[scene.findBody(name).value()].mesh;
}

/// From a text "x y z qx qy qz qw".
Isometry3d poseOf(const std::string& text) {
  std::istringstream stream(text);
  Vector3d position;
  Eigen::Quaterniond turn;
  for (double& coordinate : position) stream >> coordinate;
  for (double& coordinate : turn.coeffs()) stream >> coordinate;
  EXPECT_TRUE(stream) << text;
  Isometry3d pose(turn.normalized());
  pose.translation() = position;
  return pose;
}

PairContacts contactsOf(const Body& a, const Body& b, const Isometry3d& a_from_b) {
  TrackerParameters parameters;
  parameters.niches_wanted = false;
  EffectSettings settings;
  settings.normal_force.emplace();
  settings.normal_force->model = NormalForceModel::ElasticFoundation;
  settings.normal_force->distribution = ForceDistribution::Lumped;
  settings.normal_force->foundation_stiffness = kFoundation;
  PairEffects effects(a, b, settings, inContact(Material(), Material()));
  PairContacts contacts;
  effects.update(solveOnce("case", a, b, parameters, a_from_b), {}, 0.0, contacts);
  return contacts;
}

/// Inside both, which are convex but for the L's box around it.
bool contains(const BodyMesh& body, const Vector3d& point) {
  constexpr double kRounding = 1e-9;  // m
  if (body.shape() == nullptr) {
    return body.bounds().squaredExteriorDistance(point) <= kRounding * kRounding;
  }
  return test::wideSignedDistance(*body.shape(), point.cast<long double>()) <= kRounding;
}

TEST(RoundCases, EveryOverlapHasItsVolumeAndTheForceOfItsFoundation) {
  const std::vector<test::Row> lines = test::readTable(folder() + "volumes.csv");
  ASSERT_EQ(lines.size(), 80U);
  for (const test::Row& line : lines) {
    const double volume = test::number(line, "volume");
    for (const bool swapped : {false, true}) {
      const std::string a = swapped ? "b" : "a";
      const std::string b = swapped ? "a" : "b";
      SCOPED_TRACE(line.at("body_" + a) + " and " + line.at("body_" + b) + " at " + line.at("pose_a") + ", " +
                   line.at("pose_b"));
      const Body body_a = bodyOf(line.at("scene"), line.at("body_" + a));
      const Body body_b = bodyOf(line.at("scene"), line.at("body_" + b));
      const Isometry3d a_from_b = poseOf(line.at("pose_" + a)).inverse() * poseOf(line.at("pose_" + b));
      const PairContacts contacts = contactsOf(body_a, body_b, a_from_b);
      double found = 0.0;
      double force = 0.0;
      for (const ContactRegion& region : contacts.regions) {
        found += region.overlap.volume;
        force += region.normal_force;
        const Vector3d centroid = region.overlap.centroid_in_a;
        EXPECT_TRUE(contains(*body_a, centroid)) << centroid.transpose();
        EXPECT_TRUE(contains(*body_b, a_from_b.inverse() * centroid)) << centroid.transpose();
      }
      EXPECT_NEAR(found, volume, kPromised * volume);
      EXPECT_NEAR(force, kFoundation * volume, kPromised * kFoundation * volume);
    }
  }
}

}  // namespace
}  // namespace concave_distance::round_cases_test

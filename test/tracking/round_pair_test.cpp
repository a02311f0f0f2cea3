// Pairs with an exact round solid: distance, niches and identity are those of the solid and not of its mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/loading/load_scene.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/bound/round_certificate.h"
#include "distance/kernels/triangle_distance.h"
#include "support/body_pairs.h"
#include "support/brute_force_minima.h"
#include "support/count_allocations.h"
#include "support/csv_table.h"
#include "support/round_bodies.h"

namespace concave_distance::round_pair_test {
namespace {

using Body = std::shared_ptr<const BodyMesh>;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using test::translation;
using test::turned;

TrackerParameters atLevel(AccuracyLevel level, bool niches = true) {
  TrackerParameters parameters;
  parameters.accuracy = level;
  parameters.niches_wanted = niches;
  return parameters;
}

const Body& ball() {
  static const Body kBall = test::makeRoundBody(test::sphereOf(0.1));
  return kBall;
}

TEST(RoundPair, ABallThatRollsKeepsItsDistanceAndItsNiche) {
  const Body table = makeBody(makeBox({2.0, 2.0, 0.1}));
  for (const AccuracyLevel level : {AccuracyLevel::Certified, AccuracyLevel::Refined}) {
    PairTracker tracker("roll", table, ball(), atLevel(level));
    PairSolution solution;
    std::uint64_t id = 0;
    for (int i = 0; i < 200; ++i) {
      const double x = -0.5 + 0.005 * i;
      tracker.update(turned(x / 0.1, Vector3d(0.1, 1.0, 0.02), {x, 0.1, 0.16}), 0.01 * i, solution);
      ASSERT_EQ(solution.status, SolveStatus::Ok);
      ASSERT_NEAR(solution.distance, 0.01, 1e-15);
      ASSERT_NEAR((solution.point_a_in_a - Vector3d(x, 0.1, 0.05)).norm(), 0.0, 1e-13);
      ASSERT_NEAR((solution.point_b_in_a - Vector3d(x, 0.1, 0.06)).norm(), 0.0, 1e-13);
      ASSERT_EQ(solution.niches.size(), 1U) << i;
      ASSERT_EQ(solution.niches[0].kind, NicheKind::Point);
      ASSERT_NEAR((solution.niches[0].normal_in_a - Vector3d::UnitZ()).norm(), 0.0, 1e-12);
      if (i == 0) id = solution.niches[0].id;
      ASSERT_EQ(solution.niches[0].id, id) << i;
      ASSERT_EQ(solution.events.size(), i == 0 ? 1U : 0U) << i;
      if (i > 0) {
        ASSERT_NEAR(solution.closing_speed, 0.0, 1e-11);
      }
    }
  }
}

TEST(RoundPair, ABallInACornerHasOneNicheForEachFace) {
  const Body corner = makeBody(test::makeLShape(0.6, 0.15, 0.2));
  // The inner faces are at x = 0.15 and y = 0.15.
  PairTracker tracker("corner", corner, ball(), atLevel(AccuracyLevel::Certified));
  PairSolution solution;
  tracker.update(translation({0.27, 0.30, 0.1}), 0.0, solution);
  ASSERT_GE(solution.niches.size(), 2U);
  EXPECT_NEAR(solution.distance, 0.02, 1e-15);
  EXPECT_NEAR(solution.niches[0].distance, 0.02, 1e-15);
  EXPECT_NEAR(solution.niches[1].distance, 0.05, 1e-15);
  EXPECT_TRUE(solution.niches_complete);
}

TEST(RoundPair, OverlapIsThatOfTheSolid) {
  const Body table = makeBody(makeBox({2.0, 2.0, 0.1}));
  // Rests on a facet: the mesh is 1e-3 above its sphere's lowest point.
  const Body coarse = test::makeRoundBody(test::roundShape(RoundKind::Sphere, 0.1, 0.0, 0.01));
  const Body mesh = test::makeRoundBody(test::roundShape(RoundKind::Sphere, 0.1, 0.0, 0.01), false);
  const Isometry3d pose = turned(0.37, Vector3d(0.3, 1.0, 0.2), {0.0, 0.0, 0.15 - 1e-6});
  const PairSolution of_mesh = solveOnce("mesh", table, mesh, atLevel(AccuracyLevel::Certified), pose);
  EXPECT_EQ(of_mesh.status, SolveStatus::Ok);
  for (const AccuracyLevel level : {AccuracyLevel::Certified, AccuracyLevel::Refined}) {
    for (const bool swapped : {false, true}) {
      const PairSolution found = swapped ? solveOnce("ball", coarse, table, atLevel(level), pose.inverse())
                                         : solveOnce("ball", table, coarse, atLevel(level), pose);
      EXPECT_EQ(found.status, SolveStatus::Penetrating);
      EXPECT_EQ(found.distance, 0.0);
      ASSERT_EQ(found.niches.size(), 1U);
      EXPECT_EQ(found.niches[0].distance, 0.0);
      ASSERT_TRUE(found.meeting_triangles.has_value());
    }
  }
}

TEST(RoundPair, ASwallowedBallPenetrates) {
  const Body hall = makeBody(makeBox({2.0, 2.0, 2.0}));
  const PairSolution found =
      solveOnce("hall", hall, ball(), atLevel(AccuracyLevel::Certified), translation({0.5, 0.0, 0.0}));
  EXPECT_EQ(found.status, SolveStatus::Penetrating);
  EXPECT_NEAR(found.surface_distance, 0.4, 1e-15);
}

TEST(RoundPair, AnyPoseIsBracketedAndSwapsAndEveryNicheIsALocalMinimum) {
  RandomEngine engine(23);
  const std::vector<RoundShape> shapes{test::sphereOf(0.2), test::roundShape(RoundKind::Capsule, 0.1, 0.2),
                                       test::roundShape(RoundKind::Cylinder, 0.15, 0.1)};
  for (std::uint32_t i = 0; i < 36; ++i) {
    const RoundShape& shape = shapes[i % 3];
    const Body round = test::makeRoundBody(shape);
    const Body mesh = makeBody(test::concaveShape(i));
    const Isometry3d pose = test::randomPose(engine, 1.0);
    const PairSolution found = solveOnce("any", mesh, round, atLevel(AccuracyLevel::Certified), pose);
    const DistanceCertificate truth = certifyRoundDistance(*mesh, *round, pose, nullptr, 0, {});
    const RoundAndMesh pair(shape, *mesh, pose);
    EXPECT_EQ(found.status == SolveStatus::Penetrating,
              truth.status == CertificateStatus::Penetrating || isRoundContained(*mesh, *round, pose));
    if (found.status == SolveStatus::Penetrating) continue;
    EXPECT_NEAR(found.distance, truth.distance, 1e-14);
    EXPECT_LE(found.lower_bound, found.distance);
    ASSERT_FALSE(found.niches.empty());
    EXPECT_NEAR(found.niches[0].distance, found.distance, 1e-14);
    const PairSolution swapped =
        solveOnce("any", round, mesh, atLevel(AccuracyLevel::Certified), pose.inverse());
    EXPECT_NEAR(swapped.distance, found.distance, 1e-14);
    double before = 0.0;
    for (const TrackedNiche& niche : found.niches) {
      EXPECT_GE(niche.distance, before);
      before = niche.distance;
      const RoundMinimum again = descendOnMesh(pair, niche.witness.triangle_a);
      EXPECT_NEAR(again.lowest.value, niche.distance, 1e-14);
      EXPECT_NEAR((niche.point_b_in_a - niche.point_a_in_a).norm(), niche.distance, 1e-13);
    }
  }
}

/// A tetrahedron or a prism in place of the centre or the axis, turned otherwise than the package's own.
SurfaceMesh thinCore(const RoundShape& shape) {
  const double thin = 1e-9 * shape.radius;
  std::vector<Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  const auto add = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    triangles.push_back({NodeIndex{x}, NodeIndex{y}, NodeIndex{z}});
  };
  if (shape.half_length == 0.0) {
    vertices = {{thin, 0.0, 0.0}, {-thin, thin, 0.0}, {-thin, -thin, 0.0}, {0.0, 0.0, thin}};
    add(0, 2, 1), add(0, 1, 3), add(1, 2, 3), add(2, 0, 3);
  } else {
    for (const double z : {-shape.half_length, shape.half_length}) {
      for (int k = 0; k < 3; ++k)
        vertices.push_back({thin * std::cos(1.0 + 2.1 * k), thin * std::sin(1.0 + 2.1 * k), z});
    }
    add(0, 2, 1), add(3, 4, 5);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t next = (k + 1) % 3;
      add(k, next, next + 3), add(k, next + 3, k + 3);
    }
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "core");
}

TrianglePoints cornersOf(const SurfaceMesh& mesh, std::uint32_t triangle) {
  return {mesh.corner(TriangleIndex{triangle}, 0), mesh.corner(TriangleIndex{triangle}, 1),
          mesh.corner(TriangleIndex{triangle}, 2)};
}

/// Returns whether a segment meets a triangle of the mesh elsewhere than at its beginning.
bool isBlocked(const SurfaceMesh& mesh, const Vector3d& from, const Vector3d& to) {
  const Vector3d way = to - from;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TrianglePoints corners = cornersOf(mesh, static_cast<std::uint32_t>(t));
    const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double along = normal.dot(way);
    if (std::abs(along) < 1e-14 * normal.norm()) continue;
    const double at = normal.dot(corners[0] - from) / along;
    if (at < 1e-6 || at > 1.0) continue;
    const Vector3d point = from + at * way;
    bool is_inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      is_inside =
          is_inside && (corners[(k + 1) % 3] - corners[k]).cross(point - corners[k]).dot(normal) >= 0.0;
    }
    if (is_inside) return true;
  }
  return false;
}

// Every local minimum between the mesh and the centre or axis, by brute force, whose segment no triangle
// meets.
TEST(RoundPair, TheListIsThatOfBruteForceForTheCore) {
  RandomEngine engine(29);
  int listed = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const RoundShape shape =
        i % 2 == 0 ? test::sphereOf(0.15) : test::roundShape(RoundKind::Capsule, 0.08, 0.2);
    const Body round = test::makeRoundBody(shape);
    const Body core = makeBody(thinCore(shape));
    const Body mesh = makeBody(test::concaveShape(i));
    const Isometry3d pose = test::randomPose(engine, 1.0);
    const PairSolution found = solveOnce("list", mesh, round, atLevel(AccuracyLevel::Certified), pose);
    if (found.status == SolveStatus::Penetrating || found.distance < 0.01) continue;
    ASSERT_TRUE(found.niches_complete) << i;
    std::vector<double> expected;
    double doubtful = 0.0;
    for (const test::BruteForceMinimum& minimum :
         test::bruteForceMinima(*mesh, *core, pose, 10.0, 0.0095, 1e-12, 1e-9, shape.radius)) {
      const TrianglePoints on_core = cornersOf(core->surface(), minimum.triangle_b);
      const TrianglePairDistance closest =
          triangleDistance(cornersOf(mesh->surface(), minimum.triangle_a),
                           {pose * on_core[0], pose * on_core[1], pose * on_core[2]});
      if (isBlocked(mesh->surface(), closest.point_a, closest.point_b)) continue;
      if (minimum.prominence < 0.0105) {
        doubtful = 1.0;
        continue;
      }
      expected.push_back(minimum.distance - shape.radius);
    }
    if (doubtful > 0.0) continue;
    ASSERT_EQ(found.niches.size(), expected.size()) << i;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(found.niches[k].distance, expected[k], 2e-9 * shape.radius) << i;
    }
    listed += static_cast<int>(expected.size());
  }
  EXPECT_GT(listed, 60);
}

TEST(RoundPair, ABallThatSinksInAndComesOutKeepsItsNiche) {
  const Body table = makeBody(makeBox({2.0, 2.0, 0.5}));
  for (const Body& round : {ball(), test::makeRoundBody(test::roundShape(RoundKind::Capsule, 0.1, 0.2))}) {
    PairTracker tracker("sink", table, round, atLevel(AccuracyLevel::Certified));
    PairSolution solution;
    for (int i = 0; i < 120; ++i) {
      const double height = 0.03 * std::cos(0.1 * i);
      tracker.update(turned(0.5 * 3.14159265358979323846, Vector3d::UnitY(), {0.1, 0.2, 0.35 + height}),
                     0.01 * i, solution);
      ASSERT_EQ(solution.status, height > 1e-12 ? SolveStatus::Ok : SolveStatus::Penetrating) << i;
      ASSERT_NEAR(solution.distance, std::max(0.0, height), 1e-14);
      ASSERT_EQ(solution.niches.size(), 1U) << i;
      ASSERT_EQ(solution.niches[0].id, 1U) << i;
      ASSERT_TRUE(solution.niches_complete) << i;
    }
  }
}

TEST(RoundPair, TwoSolidsHaveOneProvenNiche) {
  const Body capsule = test::makeRoundBody(test::roundShape(RoundKind::Capsule, 0.1, 0.3));
  PairTracker tracker("solids", capsule, ball(), atLevel(AccuracyLevel::Certified));
  PairSolution solution;
  for (int i = 0; i < 50; ++i) {
    const double x = 0.5 - 0.008 * i;
    tracker.update(translation({x, 0.0, 0.1}), 0.01 * i, solution);
    ASSERT_EQ(solution.niches.size(), 1U);
    EXPECT_EQ(solution.niches[0].id, 1U);
    EXPECT_TRUE(solution.niches_complete);
    EXPECT_NEAR(solution.distance, std::max(0.0, x - 0.2), 1e-15);
    EXPECT_EQ(solution.status, x > 0.2 + 1e-12 ? SolveStatus::Ok : SolveStatus::Penetrating);
  }
}

TEST(RoundPair, TheCutoffIsThatOfTheSolid) {
  const Body table = makeBody(makeBox({2.0, 2.0, 0.1}));
  TrackerParameters parameters = atLevel(AccuracyLevel::Certified);
  parameters.cutoff = 0.0201;
  const Isometry3d pose = turned(0.37, Vector3d(0.3, 1.0, 0.2), {0.0, 0.0, 0.17});
  EXPECT_EQ(solveOnce("cutoff", table, ball(), parameters, pose).niches.size(), 1U);
  parameters.cutoff = 0.0199;
  EXPECT_TRUE(solveOnce("cutoff", table, ball(), parameters, pose).niches.empty());
}

TEST(RoundPair, ABudgetThatRunsOutLeavesABracket) {
  const Body comb = std::make_shared<BodyMesh>("comb", test::makeComb(40), BodyMeshOptions());
  const Body cylinder = test::makeRoundBody(test::roundShape(RoundKind::Cylinder, 0.06, 0.2));
  TrackerParameters parameters = atLevel(AccuracyLevel::Certified);
  const Isometry3d pose = turned(0.3, Vector3d(1.0, 0.2, 0.0), {4.0, 0.6, 0.1});
  const PairSolution all = solveOnce("budget", comb, cylinder, parameters, pose);
  EXPECT_EQ(all.status, SolveStatus::Ok);
  for (const double budget : {1e-9, 1e-5, 1e-4}) {
    parameters.time_budget = budget;
    const PairSolution found = solveOnce("budget", comb, cylinder, parameters, pose);
    EXPECT_LE(found.lower_bound, all.distance);
    EXPECT_GE(found.distance, all.distance - 1e-14);
    if (found.status == SolveStatus::BudgetExhausted) {
      EXPECT_FALSE(found.niches_complete);
    }
  }
}

TEST(RoundPair, APoseThatIsNoneIsRefused) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation().x() = kNotComputed;
  const PairSolution found =
      solveOnce("pose", ball(), makeBody(makeBox({1.0, 1.0, 1.0})), atLevel(AccuracyLevel::Certified), pose);
  EXPECT_EQ(found.status, SolveStatus::InvalidPose);
  EXPECT_TRUE(std::isnan(found.distance));
}

TEST(RoundPair, AWarmCycleAllocatesNothing) {
  const Body comb = std::make_shared<BodyMesh>("comb", test::makeComb(5), BodyMeshOptions());
  const Body cylinder = test::makeRoundBody(test::roundShape(RoundKind::Cylinder, 0.06, 0.2));
  const Body capsule = test::makeRoundBody(test::roundShape(RoundKind::Capsule, 0.02, 0.1));
  for (const auto& [other, round_body] : {std::pair{comb, cylinder},
                                          {ball(), cylinder},
                                          {comb, test::makeRoundBody(test::sphereOf(0.02))},
                                          {capsule, comb}}) {
    PairTracker tracker("warm", other, round_body, atLevel(AccuracyLevel::Certified));
    PairSolution solution;
    std::size_t before = 0;
    for (int round = 0; round < 4; ++round) {
      if (round == 3) before = allocations.load();
      for (int k = 0; k < 100; ++k) {
        const double t = 2.0 * 3.14159265358979323846 * k / 100.0;
        tracker.update(turned(0.3 * std::sin(t), Vector3d(1.0, 0.2, 0.0),
                              {0.5 + 0.2 * std::cos(t), 0.6 + 0.05 * std::sin(t), 0.1}),
                       round + 0.01 * k, solution);
      }
    }
    EXPECT_EQ(allocations.load() - before, 0U);
  }
}

// Meshes wholly inside exact round solids or with faces through their centre or axis (test/data/round), whose
// overlaps once had from 0 to 33 times their volume: each with its volume, through a scene and a pair's
// effects.
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
  stream >> position.x() >> position.y() >> position.z();
  stream >> turn.x() >> turn.y() >> turn.z() >> turn.w();
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
}  // namespace concave_distance::round_pair_test

#include "concave_distance/tracking/pair_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "concave_distance/mesh/surface/primitives.h"
#include "distance/kernels/pair_motion.h"
#include "support/body_pairs.h"
#include "support/concave_shapes.h"
#include "support/enumeration.h"

namespace concave_distance::pair_tracker_test {
namespace {

std::shared_ptr<const BodyMesh> body(const std::string& name, SurfaceMesh surface) {
  return std::make_shared<BodyMesh>(name, std::move(surface), BodyMeshOptions());
}

Eigen::Isometry3d at(double x, double y, double z, double angle = 0.0,
                     const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ()) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(angle, axis.normalized()));
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

struct CombScene {
  const std::shared_ptr<const BodyMesh>& a = test::fiveTeeth();
  const std::shared_ptr<const BodyMesh>& b = test::fiveTeeth();
  static Eigen::Isometry3d pose(double t) { return test::swayingComb(t); }
};

TEST(PairTracker, TwoBoxesFaceToFaceAreOnePatch) {
  PairTracker tracker("boxes", body("a", makeBox({1.0, 1.0, 1.0})), body("b", makeBox({0.5, 0.5, 0.5})),
                      TrackerParameters());
  PairSolution solution;
  tracker.update(at(0.1, 0.0, 1.0), 0.0, solution);
  EXPECT_EQ(solution.status, SolveStatus::Ok);
  EXPECT_NEAR(solution.distance, 0.25, 1e-12);
  ASSERT_EQ(solution.niches.size(), 1U);
  EXPECT_EQ(solution.niches[0].kind, NicheKind::Patch);
  EXPECT_EQ(solution.niches[0].outward, Outwardness::Outward);
  EXPECT_TRUE(solution.niches[0].visible);
  // The middle of the overlap, not a corner of some triangle.
  EXPECT_NEAR((solution.niches[0].point_a_in_a - Eigen::Vector3d(0.1, 0.0, 0.5)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((solution.niches[0].point_b_in_a - Eigen::Vector3d(0.1, 0.0, 0.75)).norm(), 0.0, 1e-9);
}

TEST(PairTracker, EveryNicheHasItsPointsInOneFrameAtItsDistance) {
  const CombScene scene;
  PairTracker tracker("combs", scene.a, scene.b, TrackerParameters());
  PairSolution solution;
  for (int k = 0; k < 20; ++k) {
    tracker.update(CombScene::pose(0.05 * k), 0.05 * k, solution);
    ASSERT_GT(solution.niches.size(), 1U);
    for (const TrackedNiche& niche : solution.niches) {
      EXPECT_NEAR((niche.point_b_in_a - niche.point_a_in_a).norm(), niche.distance, 1e-12);
      EXPECT_NEAR(niche.normal_in_a.norm(), 1.0, 1e-12);
      EXPECT_TRUE(niche.proven_local_minimum);
    }
  }
}

TEST(PairTracker, TheDistanceIsTheBruteForceDistanceAlongAMotion) {
  const CombScene scene;
  PairTracker tracker("combs", scene.a, scene.b, TrackerParameters());
  PairSolution solution;
  for (int k = 0; k < 60; ++k) {
    const Eigen::Isometry3d pose = CombScene::pose(0.02 * k);
    tracker.update(pose, 0.02 * k, solution);
    const double exact = std::sqrt(test::enumerateTrianglePairs(*scene.a, *scene.b, pose).squared_distance);
    EXPECT_NEAR(solution.distance, exact, 1e-12) << "cycle " << k;
  }
}

TEST(PairTracker, TheDistanceChangesNoMoreThanAnyPointMoves) {
  const CombScene scene;
  PairTracker tracker("combs", scene.a, scene.b, TrackerParameters());
  PairSolution solution;
  std::map<std::uint64_t, double> before;
  for (int k = 0; k < 60; ++k) {
    tracker.update(CombScene::pose(0.02 * k), 0.02 * k, solution);
    std::map<std::uint64_t, double> now;
    for (const TrackedNiche& niche : solution.niches) {
      now[niche.id] = niche.distance;
    }
    if (k > 0) {
      const double displacement =
          detail::PairMotion(CombScene::pose(0.02 * (k - 1)), CombScene::pose(0.02 * k))
              .largestIn(scene.b->surface().boundingBox());
      for (const auto& [id, distance] : now) {
        const auto known = before.find(id);
        if (known != before.end()) {
          // A merge gives the older id the deeper place, which its event says.
          bool merged = false;
          for (const NicheEvent& event : solution.events) {
            merged = merged || (event.kind == NicheEvent::Kind::Merge && event.into_id == id);
          }
          if (!merged) {
            EXPECT_LE(std::abs(distance - known->second), displacement + 1e-9)
                << "niche " << id << " cycle " << k;
          }
        }
      }
    }
    before = std::move(now);
  }
}

TEST(PairTracker, EveryIdIsBornOnceAndEndsWithAnEvent) {
  const CombScene scene;
  PairTracker tracker("combs", scene.a, scene.b, TrackerParameters());
  PairSolution solution;
  std::set<std::uint64_t> living;
  std::set<std::uint64_t> ever;
  for (int k = 0; k < 100; ++k) {
    tracker.update(CombScene::pose(0.1 * k), 0.1 * k, solution);
    for (const NicheEvent& event : solution.events) {
      if (event.kind == NicheEvent::Kind::Birth) {
        EXPECT_TRUE(ever.insert(event.id).second) << "id " << event.id << " born twice";
        living.insert(event.id);
      } else {
        EXPECT_EQ(living.erase(event.id), 1U) << "id " << event.id << " ended but did not live";
      }
    }
    std::set<std::uint64_t> reported;
    for (const TrackedNiche& niche : solution.niches) {
      EXPECT_TRUE(reported.insert(niche.id).second) << "id " << niche.id << " reported twice";
    }
    EXPECT_EQ(reported, living) << "cycle " << k;
  }
}

TEST(PairTracker, OneSeedGivesOneAnswer) {
  const CombScene scene;
  PairTracker one("combs", scene.a, scene.b, TrackerParameters());
  PairTracker two("combs", scene.a, scene.b, TrackerParameters());
  PairSolution first;
  PairSolution second;
  for (int k = 0; k < 30; ++k) {
    one.update(CombScene::pose(0.05 * k), 0.05 * k, first);
    two.update(CombScene::pose(0.05 * k), 0.05 * k, second);
    ASSERT_EQ(first.niches.size(), second.niches.size());
    for (std::size_t i = 0; i < first.niches.size(); ++i) {
      EXPECT_EQ(first.niches[i].id, second.niches[i].id);
      EXPECT_EQ(first.niches[i].distance, second.niches[i].distance);
      EXPECT_EQ(first.niches[i].point_a_in_a, second.niches[i].point_a_in_a);
    }
  }
}

TEST(PairTracker, IdsGoOnCountingAfterAReset) {
  const CombScene scene;
  PairTracker tracker("combs", scene.a, scene.b, TrackerParameters());
  PairSolution solution;
  tracker.update(CombScene::pose(0.0), 0.0, solution);
  std::uint64_t largest = 0;
  for (const TrackedNiche& niche : solution.niches) {
    largest = std::max(largest, niche.id);
  }
  tracker.reset();
  tracker.update(CombScene::pose(0.0), 1.0, solution);
  EXPECT_FALSE(solution.warm);
  for (const TrackedNiche& niche : solution.niches) {
    EXPECT_GT(niche.id, largest);
  }
}

TEST(PairTracker, ASwallowedBodyPenetrates) {
  const auto big = body("big", makeBox({2.0, 2.0, 2.0}));
  const auto small = body("small", makeBox({0.2, 0.2, 0.2}));
  const PairSolution solution =
      solveOnce("swallowed", big, small, TrackerParameters(), at(0.5, 0.0, 0.0, 0.3));
  EXPECT_EQ(solution.status, SolveStatus::Penetrating);
  EXPECT_EQ(solution.distance, 0.0);
  EXPECT_NEAR(solution.surface_distance, 0.5 - 0.1 * (std::cos(0.3) + std::sin(0.3)), 1e-12);
}

TEST(PairTracker, CrossingSurfacesPenetrate) {
  const auto a = body("a", makeBox({1.0, 1.0, 1.0}));
  const auto b = body("b", makeBox({1.0, 1.0, 1.0}));
  const PairSolution solution = solveOnce("crossing", a, b, TrackerParameters(), at(0.7, 0.2, 0.1, 0.3));
  EXPECT_EQ(solution.status, SolveStatus::Penetrating);
  EXPECT_EQ(solution.distance, 0.0);
}

TEST(PairTracker, ABodyInTheHollowOfAnotherIsApart) {
  // The inner shell of a hollow box faces inwards of the hollow.
  const SurfaceMesh inner = test::makeTurned(makeBox({1.0, 1.0, 1.0}));
  const auto hollow = body("hollow box", test::makeJoined(makeBox({2.0, 2.0, 2.0}), inner));
  const auto ball = body("cube", makeBox({0.2, 0.2, 0.2}));
  const PairSolution solution = solveOnce("hollow", hollow, ball, TrackerParameters(), at(0.1, 0.0, 0.0));
  EXPECT_EQ(solution.status, SolveStatus::Ok);
  EXPECT_NEAR(solution.distance, 0.3, 1e-12);
}

TEST(PairTracker, RefusesAPoseThatIsNoPoseAndGoesOn) {
  const CombScene scene;
  PairTracker tracker("combs", scene.a, scene.b, TrackerParameters());
  PairSolution solution;
  tracker.update(CombScene::pose(0.0), 0.0, solution);
  const double distance = solution.distance;
  const std::uint64_t id = solution.niches.front().id;
  Eigen::Isometry3d broken = CombScene::pose(0.0);
  broken.translation().y() = std::numeric_limits<double>::quiet_NaN();
  tracker.update(broken, 0.1, solution);
  EXPECT_EQ(solution.status, SolveStatus::InvalidPose);
  EXPECT_TRUE(std::isnan(solution.distance));
  EXPECT_TRUE(solution.niches.empty());
  tracker.update(CombScene::pose(0.0), 0.2, solution);
  EXPECT_NEAR(solution.distance, distance, 1e-12);
  EXPECT_EQ(solution.niches.front().id, id);
}

TEST(PairTracker, SaysWhenTheListIsCut) {
  const CombScene scene;
  TrackerParameters parameters;
  parameters.largest_niche_count = 2;
  const PairSolution solution = solveOnce("combs", scene.a, scene.b, parameters, CombScene::pose(0.0));
  EXPECT_EQ(solution.niches.size(), 2U);
  EXPECT_TRUE(solution.niches_cut);
  parameters.largest_niche_count = 1000;
  EXPECT_FALSE(solveOnce("combs", scene.a, scene.b, parameters, CombScene::pose(0.0)).niches_cut);
}

TEST(PairTracker, LevelNodesGivesTheEnumeratedOptimum) {
  const CombScene scene;
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Nodes;
  PairTracker tracker("combs", scene.a, scene.b, parameters);
  PairSolution solution;
  for (int k = 0; k < 20; ++k) {
    // Askew and apart: between parallel walls the nodes' distances make a staircase of shallow minima.
    Eigen::Isometry3d pose = at(1.4, 0.9 + 0.01 * k, 0.1, 0.5 + 0.05 * k, {1.0, 2.0, 3.0});
    tracker.update(pose, 0.05 * k, solution);
    const double exact = std::sqrt(test::enumerateNodePairs(*scene.a, *scene.b, pose).squared_distance);
    EXPECT_NEAR(solution.distance, exact, 1e-12) << "cycle " << k;
  }
}

TEST(PairTracker, ClosingSpeedIsTheSpeedOfApproach) {
  PairTracker tracker("boxes", body("a", makeBox({1.0, 1.0, 1.0})), body("b", makeBox({0.5, 0.5, 0.5})),
                      TrackerParameters());
  PairSolution solution;
  tracker.update(at(0.0, 0.0, 1.0, 0.2, {1.0, 1.0, 0.0}), 0.0, solution);
  EXPECT_TRUE(std::isnan(solution.niches.front().closing_speed));
  tracker.update(at(0.0, 0.0, 0.98, 0.2, {1.0, 1.0, 0.0}), 0.1, solution);
  EXPECT_NEAR(solution.niches.front().closing_speed, 0.2, 1e-9);
}

}  // namespace
}  // namespace concave_distance::pair_tracker_test

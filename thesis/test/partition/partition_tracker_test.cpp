#include "thesis/src/partition/partition_tracker.h"
#include "search/grid/node_graph.h"

#include <gtest/gtest.h>

#include "concave_distance/base/error.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/bound/certificate.h"
#include "search/grid/body_grid.h"
#include "support/body_pairs.h"
#include "support/thesis_scenes.h"
#include "thesis/src/partition/convex_partition.h"
#include "thesis/src/partition/hybrid_distance.h"
#include "thesis/test/support/partition_checks.h"
#include "thesis/test/support/read_pieces.h"

namespace concave_distance::partition_tracker_test {
namespace {

using PartitionPointer = std::shared_ptr<const ConvexPartition>;

PartitionPointer handPartition(const std::string& body) {
  return std::make_shared<const ConvexPartition>(test::readPieces(test::thesisFile(body + "_pieces.obj")));
}

PartitionPointer automaticPartition(const BodyMesh& body) {
  return std::make_shared<const ConvexPartition>(partitionMesh(body.surface(), body.name()).partition);
}

PartitionTrackerOptions optionsOf(PieceSolver solver, bool warm = true, bool cull = false) {
  PartitionTrackerOptions options;
  options.solver = solver;
  options.warm_start = warm;
  options.cull = cull;
  return options;
}

double certifiedDistance(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& pose) {
  CertificateWorkspace workspace;
  const DistanceCertificate proof = certifyDistance(a, b, pose, nullptr, 0, {}, workspace);
  return proof.status == CertificateStatus::Penetrating ? 0.0 : proof.distance;
}

struct Manoeuvre {
  std::shared_ptr<const BodyMesh> fixture = test::loadThesisBody("fixture", 0.1);
  std::shared_ptr<const BodyMesh> battery = test::loadThesisBody("battery", 0.1);
  PartitionPointer fixture_by_hand = handPartition("fixture");
  PartitionPointer battery_by_hand = handPartition("battery");
  std::vector<Eigen::Isometry3d> poses = test::readThesisPoses("manoeuvre_200.csv");
};

const Manoeuvre& manoeuvre() {
  static const Manoeuvre scene;
  return scene;
}

TEST(PartitionTracker, FollowsTheManoeuvreAtTheCertifiedDistanceWithEverySolver) {
  const Manoeuvre& m = manoeuvre();
  std::vector<PartitionTracker> trackers;
  for (const bool cull : {false, true}) {
    trackers.emplace_back(m.fixture_by_hand, m.battery_by_hand,
                          optionsOf(PieceSolver::QuadraticProgram, true, cull));
    trackers.emplace_back(m.fixture_by_hand, m.battery_by_hand, optionsOf(PieceSolver::Gjk, true, cull));
  }
  for (const Eigen::Isometry3d& pose : m.poses) {
    const double exact = certifiedDistance(*m.fixture, *m.battery, pose);
    for (PartitionTracker& tracker : trackers) {
      const PartitionSolution solution = tracker.update(pose);
      EXPECT_NEAR(solution.distance, exact, 1e-9);
      EXPECT_LE(solution.lower_bound, exact + 1e-12);
      EXPECT_NEAR((solution.point_b_in_a - solution.point_a_in_a).norm(), solution.distance, 1e-12);
      EXPECT_EQ(solution.unproven, 0u) << exact << " " << solution.distance - solution.lower_bound;
    }
  }
}

TEST(PartitionTracker, WarmStartsTakeFewerIterationsForTheSameDistances) {
  const Manoeuvre& m = manoeuvre();
  PartitionTracker cold(m.fixture_by_hand, m.battery_by_hand,
                        optionsOf(PieceSolver::QuadraticProgram, false));
  PartitionTracker warm(m.fixture_by_hand, m.battery_by_hand, optionsOf(PieceSolver::QuadraticProgram));
  std::uint64_t cold_iterations = 0;
  std::uint64_t warm_iterations = 0;
  for (std::size_t k = 0; k < m.poses.size(); k += 4) {
    const PartitionSolution from_centres = cold.update(m.poses[k]);
    const PartitionSolution from_last = warm.update(m.poses[k]);
    EXPECT_NEAR(from_last.distance, from_centres.distance, 1e-10);
    EXPECT_EQ(from_last.sub_pairs, 126u);
    cold_iterations += from_centres.iterations;
    warm_iterations += from_last.iterations;
  }
  EXPECT_LT(static_cast<double>(warm_iterations), 0.8 * static_cast<double>(cold_iterations));
  warm.reset();
  EXPECT_EQ(warm.update(m.poses[0]).iterations, cold.update(m.poses[0]).iterations);
}

TEST(PartitionTracker, TheHandAndTheAutomaticPartitionAreAtOneDistance) {
  const Manoeuvre& m = manoeuvre();
  PartitionTracker by_hand(m.fixture_by_hand, m.battery_by_hand, optionsOf(PieceSolver::QuadraticProgram));
  PartitionTracker automatic(automaticPartition(*m.fixture), automaticPartition(*m.battery),
                             optionsOf(PieceSolver::QuadraticProgram));
  for (std::size_t k = 0; k < m.poses.size(); k += 20) {
    EXPECT_NEAR(automatic.update(m.poses[k]).distance, by_hand.update(m.poses[k]).distance, 1e-10);
  }
}

TEST(PartitionTracker, AgreesWithTheProofOnTheThesissOtherScenesAtRandomPoses) {
  for (const std::string name : {"boxes_position_1", "cylinder_position_1"}) {
    const test::ThesisScene scene = test::loadThesisScene(name, 1.0);
    PartitionTracker tracker(automaticPartition(*scene.a), automaticPartition(*scene.b),
                             PartitionTrackerOptions{});
    EXPECT_NEAR(tracker.update(scene.a_from_b).distance,
                certifiedDistance(*scene.a, *scene.b, scene.a_from_b), 1e-9);
    RandomEngine engine(5);
    int apart = 0;
    for (int k = 0; k < 25; ++k) {
      const Eigen::Isometry3d pose = test::randomPose(engine, 3.0);
      const double exact = certifiedDistance(*scene.a, *scene.b, pose);
      EXPECT_NEAR(tracker.update(pose).distance, exact, 1e-9) << name << " " << k;
      apart += exact > 0.0 ? 1 : 0;
    }
    EXPECT_GT(apart, 10);
  }
}

TEST(PartitionTracker, BodiesThatMeetAreAtDistanceZero) {
  const Manoeuvre& m = manoeuvre();
  PartitionTracker tracker(m.fixture_by_hand, m.battery_by_hand, PartitionTrackerOptions{});
  const PartitionSolution solution = tracker.update(Eigen::Isometry3d::Identity());
  EXPECT_EQ(solution.distance, 0.0);
  EXPECT_EQ(solution.lower_bound, 0.0);
}

TEST(PartitionTracker, APartitionWithoutPiecesIsRefused) {
  const auto empty = std::make_shared<const ConvexPartition>();
  EXPECT_THROW(PartitionTracker(empty, manoeuvre().battery_by_hand, {}), Error);
  EXPECT_THROW(HybridDistance(manoeuvre().fixture_by_hand, empty), Error);
}

HybridOptions placesOnly() {
  HybridOptions options;
  options.prove = false;
  return options;
}

TEST(HybridDistance, PlacesAloneEqualTheFullSearchWhereverTheNichesHoldTheRightOne) {
  const Manoeuvre& m = manoeuvre();
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Nodes;
  PairTracker search("hybrid", m.fixture, m.battery, parameters);
  HybridDistance hybrid(m.fixture_by_hand, m.battery_by_hand, placesOnly());
  PartitionTracker full(m.fixture_by_hand, m.battery_by_hand, optionsOf(PieceSolver::Gjk, true, true));
  PairSolution niches;
  std::vector<PlacePair> places;
  int right = 0;
  std::uint64_t sub_pairs = 0;
  for (std::size_t k = 0; k < m.poses.size(); ++k) {
    const Eigen::Isometry3d& pose = m.poses[k];
    search.update(pose, 0.1 * static_cast<double>(k), niches);
    places.clear();
    for (const TrackedNiche& niche : niches.niches) {
      places.push_back({gridOf(*m.fixture).graph().positions[niche.node_pair.node_a.value],
                        gridOf(*m.battery).graph().positions[niche.node_pair.node_b.value]});
    }
    const PartitionSolution found = hybrid.update(pose, places);
    const double exact = full.update(pose).distance;
    // Never below the truth, and at most the nodes' distance above it.
    EXPECT_GE(found.distance, exact - 1e-9);
    EXPECT_LE(found.distance, niches.distance + 1e-9);
    if (found.distance <= exact + 1e-9) ++right;
    sub_pairs += found.sub_pairs;
  }
  EXPECT_GE(right, 195) << "of " << m.poses.size();
  EXPECT_LT(sub_pairs, m.poses.size() * 126 / 2);
}

TEST(HybridDistance, APlaceEndsInTheLocalMinimumItsPiecesLeadTo) {
  // One place in a corner of the plate far from everything still walks to a local minimum.
  const Manoeuvre& m = manoeuvre();
  HybridDistance hybrid(m.fixture_by_hand, m.battery_by_hand, placesOnly());
  const Eigen::Isometry3d pose = m.poses.front();
  const PartitionSolution solution = hybrid.update(pose, {{{0.48, 0.21, 0.0}, {0.0, 0.0, 0.3}}});
  EXPECT_GT(solution.sub_pairs, 0u);
  EXPECT_GE(solution.distance, certifiedDistance(*m.fixture, *m.battery, pose) - 1e-9);
  const PartitionSolution nothing = hybrid.update(pose, {});
  EXPECT_EQ(nothing.sub_pairs, 0u);
  EXPECT_TRUE(std::isnan(nothing.distance));
}

TEST(HybridDistance, IsTheBodiesDistanceWhateverThePlacesAre) {
  // Right ones, one in a corner far from everything, none.
  const Manoeuvre& m = manoeuvre();
  const PlacePair corner{{0.48, 0.21, 0.0}, {0.0, 0.0, 0.3}};
  PartitionTracker full(m.fixture_by_hand, m.battery_by_hand, optionsOf(PieceSolver::Gjk, true, true));
  for (const int kind : {0, 1, 2}) {
    HybridDistance hybrid(m.fixture_by_hand, m.battery_by_hand);
    std::uint64_t sub_pairs = 0;
    std::uint64_t updates = 0;
    for (std::size_t k = 0; k < m.poses.size(); k += 10) {
      const PartitionSolution exact = full.update(m.poses[k]);
      std::vector<PlacePair> places;
      if (kind == 0) places.push_back({exact.point_a_in_a, m.poses[k].inverse() * exact.point_b_in_a});
      if (kind == 1) places.push_back(corner);
      const PartitionSolution found = hybrid.update(m.poses[k], places);
      EXPECT_NEAR(found.distance, exact.distance, 1e-9) << "pose " << k << ", places " << kind;
      EXPECT_LE(found.lower_bound, found.distance);
      EXPECT_GE(found.lower_bound, found.distance - 1e-8);
      sub_pairs += found.sub_pairs;
      ++updates;
    }
    // Most sub-pairs need bounds only.
    EXPECT_LT(sub_pairs, updates * 126 / 4) << "places " << kind;
  }
}

}  // namespace
}  // namespace concave_distance::partition_tracker_test

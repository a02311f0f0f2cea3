#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/loading/load_body_mesh.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "loading/query_poses.h"

// Small inputs whose lists were wrong once (test/data/niches), each with the right answer.

namespace concave_distance::niche_cases_test {
namespace {

using Eigen::Vector3d;
using Bodies = std::shared_ptr<const BodyMesh>;

std::string file(const std::string& name) {
  return std::string(CONCAVE_DISTANCE_TEST_DATA) + "/niches/" + name;
}

Bodies body(const std::string& name) {
  return loadBodyMesh(file(name + ".obj")).mesh;
}

std::vector<Eigen::Isometry3d> posesOf(const std::string& name) {
  std::vector<Eigen::Isometry3d> poses;
  for (const QueryPose& query : readQueryPoses(file(name + ".csv"))) poses.push_back(poseOf(query).value());
  return poses;
}

/// The answers at all poses of a file, each solved alone and again with what the ones before have left.
std::vector<PairSolution> solve(const Bodies& a, const Bodies& b, const std::string& poses, bool is_tracked,
                                const TrackerParameters& parameters = {}) {
  std::vector<PairSolution> solutions;
  PairTracker tracker("case", a, b, parameters);
  double time = 0.0;
  for (const Eigen::Isometry3d& pose : posesOf(poses)) {
    solutions.emplace_back();
    if (is_tracked) {
      tracker.update(pose, time += 0.01, solutions.back());
    } else {
      tracker.solve(pose, solutions.back());
    }
  }
  return solutions;
}

void expectCounts(const std::vector<PairSolution>& solutions, std::size_t count) {
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    EXPECT_TRUE(solutions[i].niches_complete) << "pose " << i;
    EXPECT_EQ(solutions[i].niches.size(), count) << "pose " << i;
  }
}

// A foot from 1e-14 to 1e-3 m beside an edge: the distances to face and edge are equal as doubles.
TEST(NicheCases, AFootBesideAnEdgeIsANicheHoweverNear) {
  for (const bool is_tracked : {false, true}) {
    expectCounts(solve(body("near_edge_a"), body("near_edge_b"), "near_edge_poses", is_tracked), 2);
    expectCounts(solve(body("near_edge_far_above_a"), body("near_edge_far_above_b"),
                       "near_edge_far_above_poses", is_tracked),
                 4);
  }
}

// Bodies of 16 m modelled at 5e5 m: as many niches, at the same places, as bodies modelled around the origin.
TEST(NicheCases, BodiesModelledFarFromTheirOriginHaveEachNicheOnce) {
  constexpr double kUlp = 0x1.0p-33;  // of coordinates at 5e5 m
  const Bodies a = body("far_a");
  const Bodies b = body("far_b");
  const Vector3d origin = a->recentred().origin;
  ASSERT_GT(origin.norm(), 1e5);
  const std::vector<Eigen::Isometry3d> poses = posesOf("far_poses");
  for (const bool is_tracked : {false, true}) {
    const std::vector<PairSolution> found = solve(a, b, "far_poses", is_tracked);
    for (std::size_t i = 0; i < found.size(); ++i) {
      Eigen::Isometry3d pose = poses[i];
      pose.translation() = pose * b->recentred().origin - origin;
      const PairSolution near = solveOnce("near", a->recentred().mesh, b->recentred().mesh, {}, pose);
      ASSERT_EQ(found[i].niches.size(), near.niches.size()) << "pose " << i;
      for (std::size_t k = 0; k < near.niches.size(); ++k) {
        const TrackedNiche& niche = found[i].niches[k];
        EXPECT_NEAR(niche.distance, near.niches[k].distance, 8.0 * kUlp);
        EXPECT_LE((niche.point_a_in_a - origin - near.niches[k].point_a_in_a).norm(), 8.0 * kUlp);
        EXPECT_NEAR((niche.point_b_in_a - niche.point_a_in_a).norm(), niche.distance, 2.0 * kUlp);
      }
    }
  }
}

TEST(NicheCases, VerticesAreSubtractedFromAFarOriginWithoutRounding) {
  const Bodies far = body("far_a");
  const RecentredBody& recentred = far->recentred();
  ASSERT_TRUE(recentred.mesh);
  for (std::size_t v = 0; v < far->surface().vertexCount(); ++v) {
    const Vector3d back = recentred.mesh->surface().vertex(NodeIndex{v}) + recentred.origin;
    EXPECT_EQ(back, far->surface().vertex(NodeIndex{v}));
  }
  EXPECT_FALSE(body("plain")->recentred().mesh);
}

// A vertex lies on an edge of the same shell: the same list as where the triangles share it.
TEST(NicheCases, AShellThatTouchesItselfIsJoinedWhereItDoes) {
  for (const bool is_tracked : {false, true}) {
    const std::vector<PairSolution> found =
        solve(body("tjunction"), body("tjunction_probe"), "tjunction_poses", is_tracked);
    const std::vector<PairSolution> plain =
        solve(body("plain"), body("tjunction_probe"), "tjunction_poses", is_tracked);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      ASSERT_EQ(found[i].niches.size(), plain[i].niches.size()) << "pose " << i;
      for (std::size_t k = 0; k < plain[i].niches.size(); ++k) {
        EXPECT_NEAR(found[i].niches[k].distance, plain[i].niches[k].distance, 1e-12);
        EXPECT_EQ(found[i].niches[k].kind, plain[i].niches[k].kind);
      }
    }
  }
}

// Both segments of the same two places run in the plane of a triangle that one more far triangle changes
// nothing of.
TEST(NicheCases, VisibilityDoesNotDependOnAFarTriangleInOnePlane) {
  TrackerParameters parameters;
  parameters.hidden = true;
  const Bodies b = body("coplanar_b");
  for (int i = 0; i < 5; ++i) {
    const PairSolution found =
        solve(body("coplanar_a" + std::to_string(i)), b, "coplanar_poses", false, parameters).front();
    int seen = 0;
    for (const TrackedNiche& niche : found.niches) {
      if (std::abs(niche.distance - std::sqrt(49.0 / 3.0)) > 1e-12) continue;
      ++seen;
      EXPECT_TRUE(niche.visible) << "file " << i;
    }
    EXPECT_EQ(seen, 1) << "file " << i;
  }
}

}  // namespace
}  // namespace concave_distance::niche_cases_test

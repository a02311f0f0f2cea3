// The exact distance against FCL's bounding volume hierarchy, which shares no code with this package.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/tracking/pair_tracker.h"
#include "support/body_pairs.h"
#include "support/enumeration.h"

namespace concave_distance::fcl_comparison_test {
namespace {

using FclModel = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<FclModel> fclModel(const SurfaceMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const TriangleNodes& t : mesh.triangles()) {
    triangles.emplace_back(t[0].value, t[1].value, t[2].value);
  }
  auto model = std::make_shared<FclModel>();
  model->beginModel();
  model->addSubModel(mesh.vertices(), triangles);
  model->endModel();
  return model;
}

/// Random poses of concave shapes, with FCL's distance: compare(round, a, b, pose, reported).
template <typename Compare>
void forEachRound(std::uint64_t seed, const Compare& compare) {
  RandomEngine engine(seed);
  for (std::uint32_t round = 0; round < 300; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const SurfaceMesh surface_a = test::concaveShape(round);
    const SurfaceMesh surface_b = test::concaveShape(round / 6);
    const Eigen::Isometry3d pose = test::randomPose(engine, 1.5);
    const fcl::CollisionObjectd object_a(fclModel(surface_a), fcl::Transform3d::Identity());
    const fcl::CollisionObjectd object_b(fclModel(surface_b), pose);
    fcl::DistanceRequestd request;
    request.enable_nearest_points = false;
    fcl::DistanceResultd result;
    const double reported = std::max(0.0, fcl::distance(&object_a, &object_b, request, result));
    compare(test::makeBody(surface_a), test::makeBody(surface_b), pose, reported);
  }
}

using Body = std::shared_ptr<const BodyMesh>;

TEST(ExactDistance, AgreesWithFclOnConcavePairs) {
  int apart = 0;
  forEachRound(1, [&](const Body& a, const Body& b, const Eigen::Isometry3d& pose, double reported) {
    const double found = std::sqrt(test::enumerateTrianglePairs(*a, *b, pose).squared_distance);
    EXPECT_NEAR(found, reported, 1e-7 * (1.0 + reported));
    EXPECT_LE(found, reported + 1e-12);  // FCL's is that of some pair of triangles
    apart += found > 0.0 ? 1 : 0;
  });
  EXPECT_GT(apart, 100);
}

TEST(CertifiedDistance, AgreesWithFclOnConcavePairsColdAndTracked) {
  int apart = 0;
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Certified;
  parameters.niches_wanted = false;
  forEachRound(2, [&](const Body& a, const Body& b, const Eigen::Isometry3d& pose, double reported) {
    PairTracker tracker("certified", a, b, parameters);
    PairSolution found;
    tracker.update(pose, 0.0, found);
    const PairSolution cold = found;
    Eigen::Isometry3d near = pose;
    near.translation().x() += 1e-3;
    tracker.update(near, 0.1, found);
    tracker.update(pose, 0.2, found);
    for (const PairSolution& solution : {cold, found}) {
      EXPECT_NEAR(solution.distance, reported, 1e-7 * (1.0 + reported));
      EXPECT_LE(solution.distance, reported + 1e-12);
      EXPECT_LE(solution.lower_bound, reported + 1e-12);
      EXPECT_EQ(solution.status, solution.distance > 0.0 ? SolveStatus::Ok : SolveStatus::Penetrating);
      apart += solution.distance > 0.0 ? 1 : 0;
    }
  });
  EXPECT_GT(apart, 200);
}

}  // namespace
}  // namespace concave_distance::fcl_comparison_test

// The exact distance against FCL's bounding volume hierarchy, which shares no code with this package.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/distance/enumeration.h"
#include "support/body_pairs.h"

namespace concave_distance {
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

TEST(ExactDistance, AgreesWithFclOnConcavePairs) {
  RandomEngine engine(1);
  int apart = 0;
  for (std::uint32_t round = 0; round < 300; ++round) {
    const SurfaceMesh surface_a = test::concaveShape(round);
    const SurfaceMesh surface_b = test::concaveShape(round / 6);
    const auto a = test::makeBody(surface_a);
    const auto b = test::makeBody(surface_b);
    const Eigen::Isometry3d pose = test::randomPose(engine, 1.5);
    const fcl::CollisionObjectd object_a(fclModel(surface_a), fcl::Transform3d::Identity());
    const fcl::CollisionObjectd object_b(fclModel(surface_b), pose);
    fcl::DistanceRequestd request;
    request.enable_nearest_points = false;
    fcl::DistanceResultd result;
    const double reported = std::max(0.0, fcl::distance(&object_a, &object_b, request, result));
    const double found = std::sqrt(enumerateTrianglePairs(*a, *b, pose).squared_distance);
    EXPECT_NEAR(found, reported, 1e-7 * (1.0 + reported)) << "round " << round;
    EXPECT_LE(found, reported + 1e-12);  // FCL's is that of some pair of triangles
    apart += found > 0.0 ? 1 : 0;
  }
  EXPECT_GT(apart, 100);
}

}  // namespace
}  // namespace concave_distance

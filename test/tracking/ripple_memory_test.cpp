#include "concave_distance/tracking/ripple_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "concave_distance/distance/enumeration.h"
#include "concave_distance/mesh/primitives.h"

namespace concave_distance {
namespace {

std::shared_ptr<const BodyMesh> body(const std::string& name, SurfaceMesh surface) {
  return std::make_shared<BodyMesh>(name, std::move(surface), BodyMeshOptions());
}

TEST(FeatureKey, IsTheSameForEveryTriangleAtAFeature) {
  const SurfaceMesh box = makeBox({1.0, 1.0, 1.0});
  std::set<std::size_t> met;
  for (std::size_t l = 0; l < box.triangleCount(); ++l) {
    for (std::size_t r = 0; r < box.triangleCount(); ++r) {
      const TriangleIndex left{l};
      const TriangleIndex right{r};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          const bool same_vertex = box.triangle(left)[i] == box.triangle(right)[k];
          EXPECT_EQ(featureKey(box, left, static_cast<Feature>(i)) ==
                        featureKey(box, right, static_cast<Feature>(k)),
                    same_vertex);
          const std::set<NodeIndex> edge_l{box.triangle(left)[i], box.triangle(left)[(i + 1) % 3]};
          const std::set<NodeIndex> edge_r{box.triangle(right)[k], box.triangle(right)[(k + 1) % 3]};
          EXPECT_EQ(featureKey(box, left, static_cast<Feature>(i + 3)) ==
                        featureKey(box, right, static_cast<Feature>(k + 3)),
                    edge_l == edge_r);
        }
      }
      EXPECT_EQ(featureKey(box, left, Feature::Face) == featureKey(box, right, Feature::Face), l == r);
    }
  }
}

// A tessellated rod in a tessellated bore, askew: the distance has a ripple wherever facets pass each other.
struct RodInBore {
  std::shared_ptr<const BodyMesh> rod = body("rod", makeCylinder(0.095, 1.0, 1e-4));
  std::shared_ptr<const BodyMesh> wall = body("wall", makeCylinder(0.5, 1.2, 1e-4));
  PairGeometry geometry{wall, rod};

  RodInBore() {
    Eigen::Isometry3d pose(Eigen::AngleAxisd(0.003, Eigen::Vector3d::UnitY()));
    pose.translation() = Eigen::Vector3d(0.6, 0.0, 0.0);
    geometry.setPose(pose);
  }
};

TEST(StepOverRipples, FindsPlacesAsideThatAreLocalMinima) {
  RodInBore scene;
  const WitnessPair start = scene.geometry.refine(TriangleIndex{0}, TriangleIndex{0}).witness;
  std::vector<NicheCandidate> found;
  stepOverRipples(scene.geometry, start, found);
  for (const NicheCandidate& candidate : found) {
    EXPECT_TRUE(candidate.proven);
    EXPECT_FALSE(featuresOf(scene.geometry, candidate.witness) == featuresOf(scene.geometry, start));
  }
}

TEST(StepOverRipples, ReachesTheDeepestRippleOfARodBesideARound) {
  RodInBore scene;
  const double exact =
      std::sqrt(enumerateTrianglePairs(*scene.wall, *scene.rod, scene.geometry.a_from_b).squared_distance);
  // From a ripple some facets off: walk on from the deepest as long as that changes.
  const Eigen::Vector3d aside(0.5 * std::cos(0.2), 0.5 * std::sin(0.2), 0.0);
  TriangleIndex near_a;
  double least = 1e9;
  for (std::uint32_t t = 0; t < scene.wall->surface().triangleCount(); ++t) {
    const double away = (scene.wall->surface().corner(TriangleIndex{t}, 0) - aside).norm();
    if (away < least) {
      least = away;
      near_a = TriangleIndex{t};
    }
  }
  WitnessPair deepest = scene.geometry.refine(near_a, TriangleIndex{0}).witness;
  for (int step = 0; step < 200; ++step) {
    std::vector<NicheCandidate> found;
    stepOverRipples(scene.geometry, deepest, found);
    const double before = deepest.squared_distance;
    for (const NicheCandidate& candidate : found) {
      if (candidate.witness.squared_distance < deepest.squared_distance) {
        deepest = candidate.witness;
      }
    }
    if (!(deepest.squared_distance < before)) {
      break;
    }
  }
  EXPECT_NEAR(std::sqrt(deepest.squared_distance), exact, 1e-9);
}

TEST(RippleMemory, KnowsARippleByItsFeatures) {
  RodInBore scene;
  RippleMemory memory;
  const WitnessPair place = scene.geometry.refine(TriangleIndex{0}, TriangleIndex{0}).witness;
  EXPECT_EQ(memory.find(scene.geometry, place), nullptr);
  memory.remember(scene.geometry, place, 7, 3);
  memory.remember(scene.geometry, place, 8, 4);
  ASSERT_EQ(memory.ripples().size(), 1U);
  ASSERT_NE(memory.find(scene.geometry, place), nullptr);
  EXPECT_EQ(memory.find(scene.geometry, place)->owner, 8U);
  EXPECT_EQ(memory.find(scene.geometry, place)->judged, 4U);
}

TEST(RippleMemory, GivesUpTheOneLongestNotJudged) {
  RodInBore scene;
  RippleMemory memory;
  WitnessPair place;
  place.feature_a = place.feature_b = Feature::Face;
  for (std::uint32_t k = 0; k < RippleMemory::kCapacity + 1; ++k) {
    place.triangle_b = TriangleIndex{k};
    memory.remember(scene.geometry, place, 1, k == 5 ? 0 : k + 1);
  }
  EXPECT_EQ(memory.ripples().size(), RippleMemory::kCapacity);
  place.triangle_b = TriangleIndex{5};
  EXPECT_EQ(memory.find(scene.geometry, place), nullptr);
  place.triangle_b = TriangleIndex{RippleMemory::kCapacity};
  EXPECT_NE(memory.find(scene.geometry, place), nullptr);
}

TEST(RippleMemory, FollowsTheRipplesOfOneNicheAndJoinsThoseThatRunTogether) {
  RodInBore scene;
  RippleMemory memory;
  const WitnessPair deepest = scene.geometry.refine(TriangleIndex{0}, TriangleIndex{0}).witness;
  // Two starts in the basin of `deepest`, and one that belongs to another niche.
  WitnessPair start = deepest;
  start.feature_a = Feature::Face;
  memory.remember(scene.geometry, start, 1, 1);
  start.feature_a = Feature::Vertex0;
  memory.remember(scene.geometry, start, 1, 1);
  start.feature_a = Feature::Vertex1;
  memory.remember(scene.geometry, start, 2, 1);
  ASSERT_EQ(memory.ripples().size(), 3U);
  memory.follow(1, deepest, scene.geometry);
  ASSERT_EQ(memory.ripples().size(), 1U);
  EXPECT_EQ(memory.ripples().front().owner, 2U);
}

}  // namespace
}  // namespace concave_distance

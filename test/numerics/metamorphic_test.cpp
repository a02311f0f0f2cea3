// What must not change the answer of level `certified` does not: the bodies in the other order, both in other
// frames, everything larger or smaller, other numbers for vertices and triangles. On every hard case of this
// suite and on random pairs. Asked of the distance (in Swallowed cases that of the surfaces), of the lower
// bound and of the status.
#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/tracking/pair_tracker.h"
#include "distance/bound/certificate.h"
#include "numerics/numeric_cases.h"
#include "support/body_pairs.h"
#include "support/mesh_variants.h"
#include "support/query_bound.h"

namespace concave_distance::metamorphic_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Two surfaces at a pose.
struct Scene {
  std::string name;
  SurfaceMesh a;
  SurfaceMesh b;
  Isometry3d a_from_b;

  /// Error of the pose as a whole query states it (F of doc/numerics.md), metres.
  double poseError() const { return test::kQueryPoseError * test::poseScale(a, b, a_from_b.translation()); }
};

struct Answer {
  double distance;  ///< of the surfaces, metres
  double lower_bound;
  bool penetrating;
  double bound;        ///< how far the distance may be off, metres
  double proof_error;  ///< E of certificate.h, metres
};

Answer solve(const Scene& scene) {
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Certified;
  parameters.niches_wanted = false;
  const auto a = test::makeBody(scene.a);
  const auto b = test::makeBody(scene.b);
  const PairSolution solution = solveOnce(scene.name, a, b, parameters, scene.a_from_b);
  EXPECT_TRUE(solution.status == SolveStatus::Ok || solution.status == SolveStatus::Penetrating);
  EXPECT_LE(solution.lower_bound, solution.distance);
  const bool swallowed = std::isfinite(solution.surface_distance);
  const double surfaces = swallowed ? solution.surface_distance : solution.distance;
  return {surfaces, solution.lower_bound, solution.status == SolveStatus::Penetrating,
          test::queryBound(scene.a, scene.b, scene.a_from_b.translation(), surfaces),
          kProofError * proofScale(*a, *b, scene.a_from_b)};
}

/// `other` is `plain` in other words, `factor` times as large, with coordinates off by `rounding` metres.
void expectTheSame(const Answer& plain, const Answer& other, double factor, double rounding) {
  const double most = factor * plain.bound + other.bound + rounding;
  EXPECT_LE(std::abs(other.distance - factor * plain.distance), most)
      << factor * plain.distance << " became " << other.distance;
  EXPECT_LE(std::abs(other.lower_bound - factor * plain.lower_bound),
            most + factor * plain.proof_error + other.proof_error)
      << factor * plain.lower_bound << " became " << other.lower_bound;
  // Nearer than the bound nothing tells apart from touching.
  if (std::min(factor * plain.distance, other.distance) > most) {
    EXPECT_EQ(other.penetrating, plain.penetrating);
  }
}

Isometry3d anyMotion(RandomEngine& engine, double reach) {
  Isometry3d motion = Isometry3d::Identity();
  motion.linear() = test::randomRotation(engine);
  motion.translation() = test::uniformInCube(engine, reach);
  return motion;
}

void expectInvariance(const Scene& scene, RandomEngine& engine) {
  SCOPED_TRACE(scene.name);
  const Answer plain = solve(scene);
  {
    SCOPED_TRACE("swapped");
    const Scene swapped{scene.name, scene.b, scene.a, scene.a_from_b.inverse()};
    expectTheSame(plain, solve(swapped), 1.0, scene.poseError());
  }
  {
    SCOPED_TRACE("in other frames");
    const double reach = scene.a.diameter() + scene.b.diameter();
    const Isometry3d frame_a = anyMotion(engine, reach);
    const Isometry3d frame_b = anyMotion(engine, reach);
    const Scene moved{scene.name, test::movedSurface(scene.a, frame_a), test::movedSurface(scene.b, frame_b),
                      frame_a * scene.a_from_b * frame_b.inverse()};
    expectTheSame(plain, solve(moved), 1.0, scene.poseError() + moved.poseError());
  }
  {
    SCOPED_TRACE("scaled");
    const double factor = test::powerOfTen(engine, -6.0, 6.0);
    Scene scaled{scene.name, test::scaledSurface(scene.a, factor), test::scaledSurface(scene.b, factor),
                 scene.a_from_b};
    scaled.a_from_b.translation() *= factor;
    expectTheSame(plain, solve(scaled), factor, scaled.poseError());
  }
  {
    SCOPED_TRACE("relabelled");
    const Scene relabelled{scene.name, test::relabelledSurface(scene.a, engine),
                           test::relabelledSurface(scene.b, engine), scene.a_from_b};
    expectTheSame(plain, solve(relabelled), 1.0, 0.0);
  }
}

class Metamorphic : public testing::TestWithParam<std::vector<test::NumericCase> (*)()> {};

TEST_P(Metamorphic, HardCasesAreAnsweredAlikeInOtherWords) {
  RandomEngine engine(1);
  for (const test::NumericCase& c : GetParam()()) {
    expectInvariance({c.name, c.a, c.b, c.b_in_a.isometry()}, engine);
  }
}

INSTANTIATE_TEST_SUITE_P(Contacts, Metamorphic, testing::Values(test::contactCases));
INSTANTIATE_TEST_SUITE_P(Meshes, Metamorphic, testing::Values(test::meshCases));
INSTANTIATE_TEST_SUITE_P(Poses, Metamorphic, testing::Values(test::poseCases));
INSTANTIATE_TEST_SUITE_P(ConcaveBodies, Metamorphic, testing::Values(test::concaveCases));

TEST(MetamorphicOfRandomPairs, ConcaveAndInterlocking) {
  RandomEngine engine(2);
  for (std::uint32_t round = 0; round < 150; ++round) {
    const SurfaceMesh a = test::concaveShape(round);
    const SurfaceMesh b = test::concaveShape(round / 6);
    expectInvariance({"round " + std::to_string(round), a, b, test::randomPose(engine, 1.0)}, engine);
  }
}

TEST(MetamorphicOfRandomPairs, APowerOfTwoScalesTheAnswerExactly) {
  RandomEngine engine(3);
  for (std::uint32_t round = 0; round < 60; ++round) {
    const Scene scene{"round " + std::to_string(round), test::concaveShape(round),
                      test::concaveShape(round / 6), test::randomPose(engine, 1.0)};
    const Answer plain = solve(scene);
    for (const double factor : {0x1p-40, 0x1p-1, 0x1p33}) {
      Scene scaled{scene.name, test::scaledSurface(scene.a, factor), test::scaledSurface(scene.b, factor),
                   scene.a_from_b};
      scaled.a_from_b.translation() *= factor;
      const Answer other = solve(scaled);
      EXPECT_EQ(other.distance, factor * plain.distance) << scene.name;
      EXPECT_EQ(other.lower_bound, factor * plain.lower_bound) << scene.name;
      EXPECT_EQ(other.penetrating, plain.penetrating) << scene.name;
    }
  }
}

}  // namespace
}  // namespace concave_distance::metamorphic_test

// The beginning of niche_hunt, with a fixed seed: a few scenes of every family. And rings on which a tracker
// once listed places that are no niches.
#include <gtest/gtest.h>

#include "concave_distance/loading/load_body_mesh.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "fuzz/niche_comparison.h"
#include "fuzz/niche_hunt_scene.h"

namespace concave_distance::test::niche_hunt_test {
namespace {

constexpr std::uint64_t kSeed = 20250101;
constexpr std::uint64_t kScenes = 2;

class NicheHunt : public testing::TestWithParam<const char*> {
 protected:
  static void expectListsOfTheEnumeration(bool with_margins);
};

void NicheHunt::expectListsOfTheEnumeration(bool with_margins) {
  const NicheFamily& family = nicheFamily(GetParam());
  std::size_t niches = 0;
  for (std::uint64_t number = 0; number < kScenes; ++number) {
    const NicheScene scene = drawNicheScene(family, kSeed, number);
    const NicheHuntResult result = huntScene(scene, streamSeed(kSeed, family.name, number), with_margins);
    for (const NicheFailure& failure : result.failures) {
      ADD_FAILURE() << "scene " << number << ", cycle " << failure.cycle
                    << (failure.is_tracked ? ", tracked, " : ", cold, ") << failure.parameters << ": "
                    << failure.complaint;
    }
    EXPECT_EQ(result.borderline, 0U);
    niches += result.niches;
  }
  EXPECT_GE(niches, kScenes);
}

TEST_P(NicheHunt, ListsAreThoseOfTheEnumerationColdAndTracked) {
  expectListsOfTheEnumeration(false);
}

TEST_P(NicheHunt, ListsOfBodiesWithMarginsAreThoseOfTheEnumeration) {
  expectListsOfTheEnumeration(true);
}

std::vector<const char*> familyNames() {
  std::vector<const char*> names;
  for (const NicheFamily& family : nicheFamilies()) names.push_back(family.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Families, NicheHunt, testing::ValuesIn(familyNames()),
                         [](const auto& info) { return std::string(info.param); });

/// A scene whose list has been wrong.
class NicheHuntOnce : public testing::Test {
 protected:
  static void expectRightLists(const char* family, std::uint64_t seed, std::uint64_t number,
                               bool with_margins = false) {
    const NicheScene scene = drawNicheScene(nicheFamily(family), seed, number);
    const NicheHuntResult result = huntScene(scene, streamSeed(seed, family, number), with_margins);
    EXPECT_GT(result.niches, 0U);
    for (const NicheFailure& failure : result.failures) {
      ADD_FAILURE() << "cycle " << failure.cycle << ", " << failure.parameters << ": " << failure.complaint;
    }
  }
};

TEST_F(NicheHuntOnce, ASetWhoseMiddleAnotherShellHidesIsListedWhereACornerIsSeen) {
  expectRightLists("coplanar", 303, 62);
}

TEST_F(NicheHuntOnce, FacesThatTouchAreNichesWhereThePoseLosesMoreThanTheirGap) {
  expectRightLists("far", 505, 54);
  expectRightLists("far", 909, 87);
}

TEST_F(NicheHuntOnce, APassIsTheLowestOfThePathsThatReachAFacetPair) {
  expectRightLists("soup", 11, 1);
  expectRightLists("soup", 11, 10);
}

TEST_F(NicheHuntOnce, AFlapHasNoHiddenNicheInTheMaterialThatItReachesInto) {
  expectRightLists("self_touching", 707, 87);
}

TEST_F(NicheHuntOnce, BodiesThatNearlyTouchPenetrateByTheirMargins) {
  expectRightLists("touching", 1, 4, true);
  expectRightLists("touching", 1, 8, true);
}

class TrackedRings : public testing::Test {
 protected:
  std::string complaintAt(const Eigen::Isometry3d& pose) {
    tracker_.setParameters(parameters_);
    tracker_.update(pose, time_ += 0.01, solution_);
    return complaintAbout(solution_, parameters_, NicheEnumeration(wide_a_, wide_b_, pose));
  }
  static std::shared_ptr<const BodyMesh> ring(const std::string& name) {
    return loadBodyMesh(std::string(CONCAVE_DISTANCE_TEST_DATA) + "/niches/rings_" + name + ".obj").mesh;
  }

  std::shared_ptr<const BodyMesh> a_ = ring("a");
  std::shared_ptr<const BodyMesh> b_ = ring("b");
  WideBody wide_a_{a_->surface()};
  WideBody wide_b_{b_->surface()};
  TrackerParameters parameters_;
  PairTracker tracker_{"rings", a_, b_, parameters_};
  PairSolution solution_;
  double time_ = 0.0;
};

TEST_F(TrackedRings, HaveNoPlaceThroughMaterialInAHiddenListWithProminences) {
  parameters_.hidden = true;
  parameters_.prominence_limit = 0.5;
  for (int k = 0; k < 3; ++k) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(2.6 - 0.02 * k, 0.3 + 0.04 * k, 0.5);
    EXPECT_EQ(complaintAt(pose), "") << "pose " << k;
    EXPECT_EQ(solution_.niches.size(), 4U);
  }
}

TEST_F(TrackedRings, HaveNoFalseNicheAfterAListThatWasCut) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0.40775585053228347, -0.62252067048228921, -0.66798441686836907, 0.49947708156714676,
      0.76447671995758049, -0.40755121105459241, 0.76436758915188174, -0.16746151637071788,
      0.62265466286615068;
  pose.translation() = Eigen::Vector3d(2.1777272683588045, 0.075306655470044725, 0.25285224874825618);
  EXPECT_EQ(complaintAt(pose), "");
  pose.translation() = Eigen::Vector3d(2.1875352907852834, 0.06745737248104211, 0.25860634714583602);
  parameters_.largest_niche_count = 2;
  EXPECT_EQ(complaintAt(pose), "");
  parameters_.largest_niche_count = 64;
  EXPECT_EQ(complaintAt(pose), "");
  EXPECT_EQ(solution_.niches.size(), 5U);
}

}  // namespace
}  // namespace concave_distance::test::niche_hunt_test

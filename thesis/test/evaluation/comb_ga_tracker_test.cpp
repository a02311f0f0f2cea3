#include "thesis/src/evaluation/comb_ga_tracker.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "concave_distance/tracking/pair_tracker.h"
#include "search/search_scenes.h"

namespace concave_distance::evaluation::comb_ga_tracker_test {
namespace {

class Trackers : public ::testing::Test {
 protected:
  Trackers() { parameters_.accuracy = AccuracyLevel::Nodes; }

  /// Distances of all niches and evaluations over six poses, the first cold.
  template <typename Tracker>
  std::vector<double> distancesOf(Tracker&& tracker) const {
    std::vector<double> distances;
    PairSolution solution;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Isometry3d pose = Eigen::Translation3d(0.01 * i, 0.0, 0.0) * pair_.a_from_b;
      tracker.update(pose, 0.1 * i, solution);
      for (const TrackedNiche& niche : solution.niches) distances.push_back(niche.distance);
      distances.push_back(static_cast<double>(solution.cost.evaluations));
    }
    return distances;
  }
  std::vector<double> searchedBy(const CombGaParameters& cold, const CombGaParameters& warm) {
    parameters_.cold = partOfCore(cold);
    parameters_.warm = partOfCore(warm);
    return distancesOf(CombGaTracker("test", a_, b_, parameters_, cold, warm));
  }

  test::PairScene pair_ = test::facingCombs();
  std::shared_ptr<const BodyMesh> a_ = std::move(pair_.a);
  std::shared_ptr<const BodyMesh> b_ = std::move(pair_.b);
  TrackerParameters parameters_;
};

TEST_F(Trackers, GiveTheSameWithTheCoresParameters) {
  const std::vector<double> expected = distancesOf(PairTracker("test", a_, b_, parameters_));
  EXPECT_EQ(searchedBy(CombGaParameters(parameters_.cold), CombGaParameters(parameters_.warm)), expected);
}

TEST_F(Trackers, SearchWithTheVariantOfTheirPhase) {
  const CombGaParameters cold(parameters_.cold);
  const CombGaParameters warm(parameters_.warm);
  CombGaParameters staying = warm;
  staying.local_optimization = LocalOptimization::None;
  EXPECT_NE(searchedBy(cold, staying), searchedBy(cold, warm));
  EXPECT_EQ(searchedBy(cold, staying).front(), searchedBy(cold, warm).front()) << "the first cycle is cold";
}

}  // namespace
}  // namespace concave_distance::evaluation::comb_ga_tracker_test

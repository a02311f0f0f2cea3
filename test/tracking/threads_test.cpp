#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "concave_distance/tracking/pair_tracker.h"
#include "support/body_pairs.h"
#include "support/solution_bytes.h"

namespace concave_distance::threads_test {
namespace {

using test::appendSolution;
using test::Bytes;

/// A group of pairs over shared bodies: what a node solves in one cycle, one task a pair.
class Group {
 public:
  explicit Group(AccuracyLevel level) {
    BodyMeshOptions thinned;
    bodies_.push_back(std::make_shared<const BodyMesh>("ball", makeSphere(0.4, 1e-3), thinned));
    for (std::uint32_t k = 0; k < 4; ++k) {
      bodies_.push_back(std::make_shared<const BodyMesh>("body", test::concaveShape(k), thinned));
    }
    BodyMeshOptions fine;  // more nodes than the mesh metric holds
    fine.max_edge_length = 0.05;
    fine.matrix_node_limit = 100;
    bodies_.push_back(std::make_shared<const BodyMesh>("fine", test::makeComb(3), fine));
    TrackerParameters parameters;
    parameters.accuracy = level;
    for (std::size_t a = 0; a < bodies_.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const std::string name = std::to_string(a) + "/" + std::to_string(b);
        trackers_.emplace_back(name, bodies_[a], bodies_[b], parameters);
      }
    }
    solutions_.resize(trackers_.size());
  }

  /// Every number of the pairs' answers along a motion with a pause, pair by pair.
  std::vector<Bytes> track(int cycles) {
    std::vector<Bytes> answers(trackers_.size());
    for (int cycle = 0; cycle < cycles; ++cycle) {
      tbb::parallel_for(std::size_t{0}, trackers_.size(), [&](std::size_t i) {
        if (cycle == cycles / 2) trackers_[i].reset();  // cold once more
        const double t = 0.05 * static_cast<double>(cycle == 3 ? 2 : cycle) + 0.1 * static_cast<double>(i);
        Eigen::Isometry3d pose(Eigen::AngleAxisd(t, Eigen::Vector3d(1.0, 0.5, 0.2).normalized()));
        pose.translation() = Eigen::Vector3d(1.4 * std::cos(t), 1.4 * std::sin(t), 0.2);
        trackers_[i].update(pose, 0.01 * cycle, solutions_[i]);
        appendSolution(solutions_[i], answers[i]);
      });
    }
    return answers;
  }

 private:
  std::vector<std::shared_ptr<const BodyMesh>> bodies_;
  std::vector<PairTracker> trackers_;
  std::vector<PairSolution> solutions_;
};

std::vector<Bytes> trackWithThreads(std::size_t threads, AccuracyLevel level) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  return Group(level).track(8);  // bodies built with as many threads
}

class Threads : public testing::TestWithParam<AccuracyLevel> {};

TEST_P(Threads, OneSeedGivesOneAnswerWhateverTheirNumber) {
  const std::vector<Bytes> alone = trackWithThreads(1, GetParam());
  ASSERT_EQ(alone.size(), 15U);
  for (const Bytes& answers : alone) EXPECT_GT(answers.size(), 1000U);
  for (const std::size_t threads : {2U, 3U, 8U}) {
    const std::vector<Bytes> together = trackWithThreads(threads, GetParam());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_TRUE(together[i] == alone[i]) << "pair " << i << " with " << threads << " threads";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, Threads,
                         testing::Values(AccuracyLevel::Nodes, AccuracyLevel::Refined,
                                         AccuracyLevel::Certified),
                         [](const testing::TestParamInfo<AccuracyLevel>& info) {
                           std::string name(toString(info.param));
                           name[0] = static_cast<char>(std::toupper(name[0]));
                           return name;
                         });

}  // namespace
}  // namespace concave_distance::threads_test

#include "distance/minima/cone_slices.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>

#include "base/constants.h"
#include "base/thread_team.h"
#include "distance/minima/front_checks.h"
#include "distance/minima/minima_tracker.h"
#include "support/body_motions.h"
#include "support/body_pairs.h"
#include "support/count_allocations.h"
#include "support/random_solids.h"

// A front that is looked at in slices, by one thread or by several.

namespace concave_distance::detail::cone_slices_test {
namespace {

using test::makeBumpyBall;

using Body = std::shared_ptr<const BodyMesh>;
using Bytes = std::vector<std::uint64_t>;
constexpr std::size_t kSlicedFrom = 1024;  // expired pairs
constexpr std::size_t kAllPairs = std::numeric_limits<std::size_t>::max();

template <typename Work>
void executeWith(int threads, const Work& work) {
  const tbb::global_control workers(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  ThreadTeam team;
  team.begin();
  arena.execute([&] { team.share(work); });
}

/// Everything that a call leaves.
void append(const MinimaTracker& front, const std::vector<MinimumCandidate>& candidates, Bytes& bytes) {
  const auto add = [&](double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    bytes.push_back(bits);
  };
  for (const MinimumCandidate& candidate : candidates) {
    bytes.insert(bytes.end(), {candidate.a.value, candidate.b.value});
    add(candidate.distance);
    for (int k = 0; k < 3; ++k) {
      add(candidate.point_a[k]);
      add(candidate.point_b[k]);
    }
  }
  front.forEachPair([&](NormalConeTree::Slot a, NormalConeTree::Slot b) {
    bytes.insert(bytes.end(), {a, b});
  });
  const MinimaTracker::Counts& counts = front.counts();
  bytes.insert(bytes.end(), {counts.expired, counts.groups, counts.features, counts.measured, counts.slices});
}

struct Tracked {
  Bytes bytes;
  std::uint32_t cold_slices = 0;
  std::uint32_t warm_slices = 0;
};

/// Cold, along a motion that becomes faster, and cold once more.
Tracked track(const Body& a, const Body& b, const test::Motion& motion, std::size_t pairs, int threads) {
  Tracked tracked;
  executeWith(threads, [&] {
    MinimaTracker front(kSlicedFrom);
    double t = 0.0;
    for (int k = 0; k < 12; ++k) {
      if (k == 9) front.clear();
      t += k == 5 ? 0.0 : 1e-3 * std::pow(2.0, k);
      WorkLimit limit(WorkLimit::Clock::now(), kInfinity, pairs, nullptr);
      std::vector<MinimumCandidate> candidates;
      front.collect(PairFrame::withFacets(*a, *b, motion.at(t)), NormalSides::Outside, kInfinity, candidates,
                    limit);
      append(front, candidates, tracked.bytes);
      (front.counts().began_anew ? tracked.cold_slices : tracked.warm_slices) += front.counts().slices;
    }
  });
  return tracked;
}

TEST(ConeSlices, LeaveTheSameBytesForAnyNumberOfThreads) {
  RandomEngine engine(21);
  std::uint32_t cold_slices = 0;
  std::uint32_t warm_slices = 0;
  for (std::uint32_t run = 0; run < 3; ++run) {
    const Body a = test::makeBody(makeBumpyBall(0.5, 8e-4, 9.0 + run));
    const Body b = test::makeBody(makeBumpyBall(0.3, 8e-4, 5.0 + run));
    const test::Motion motion = test::randomMotion(engine);
    for (const std::size_t pairs : {kAllPairs, std::size_t{20'000}}) {
      SCOPED_TRACE("run " + std::to_string(run) + ", pairs " + std::to_string(pairs));
      const Tracked alone = track(a, b, motion, pairs, 1);
      cold_slices += alone.cold_slices;
      warm_slices += alone.warm_slices;
      EXPECT_EQ(track(a, b, motion, pairs, 2).bytes, alone.bytes);
      EXPECT_EQ(track(a, b, motion, pairs, 8).bytes, alone.bytes);
    }
  }
  EXPECT_GT(cold_slices, 0U);
  EXPECT_GT(warm_slices, 0U);
}

TEST(ConeSlices, LoseNoPairWhereALimitEndsThem) {
  RandomEngine engine(22);
  const Body a = test::makeBody(makeBumpyBall(0.5, 4e-3, 7.0));
  const Body b = test::makeBody(makeBumpyBall(0.3, 4e-3, 5.0));
  executeWith(3, [&] {
    std::uint32_t slices = 0;
    int cut = 0;
    for (std::uint32_t run = 0; run < 5; ++run) {
      const test::Motion motion = test::randomMotion(engine);
      MinimaTracker front(kSlicedFrom);
      for (int k = 0; k < 12; ++k) {
        SCOPED_TRACE("run " + std::to_string(run) + ", cycle " + std::to_string(k));
        const Eigen::Isometry3d pose = motion.at(0.03 * k);
        const double seconds = k % 3 == 1 ? kInfinity : std::pow(10.0, -4.5 + 2.0 * uniformUnit(engine));
        const std::size_t pairs = k % 3 == 0 ? kAllPairs : std::size_t{1} << (8U + run % 7U);
        WorkLimit limit(WorkLimit::Clock::now(), seconds, pairs, nullptr);
        std::vector<MinimumCandidate> candidates;
        front.collect(PairFrame::withFacets(*a, *b, pose), NormalSides::Outside, kInfinity, candidates,
                      limit);
        slices += front.counts().slices;
        if (!limit.hasRefused()) continue;
        ++cut;
        test::expectOneAncestor(*a, *b, front);
        if (testing::Test::HasFailure()) return;
      }
      test::expectWhatTheRootsFind(a, b, motion.at(0.4), NormalSides::Outside, kInfinity, front);
      if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(slices, 0U);
    EXPECT_GT(cut, 0);
  });
}

TEST(ConeSlices, AllocateNothingInAWarmCycle) {
  const Body a = test::makeBody(makeBumpyBall(0.5, 4e-4, 9.0));
  const Body b = test::makeBody(makeBumpyBall(0.3, 4e-4, 6.0));
  executeWith(2, [&] {
    MinimaTracker front(kSlicedFrom);
    std::vector<MinimumCandidate> candidates;
    std::uint32_t slices = 0;
    // To and fro: after the first rounds all buffers are as large as they become.
    for (int k = 0; k < 40; ++k) {
      const double t = 0.02 * (k % 4 < 2 ? k % 4 : 4 - k % 4);
      Eigen::Isometry3d pose(Eigen::AngleAxisd(t, Eigen::Vector3d(0.3, 0.8, 0.5).normalized()));
      pose.translation() = Eigen::Vector3d(0.9, 0.1 + t, 0.2);
      const PairFrame frame = PairFrame::withFacets(*a, *b, pose);
      WorkLimit none;
      candidates.clear();
      const std::size_t before = allocations;
      front.collect(frame, NormalSides::Outside, kInfinity, candidates, none);
      if (k < 24) continue;
      EXPECT_FALSE(front.counts().began_anew);
      EXPECT_EQ(allocations, before) << "cycle " << k;
      slices += front.counts().slices;
    }
    EXPECT_GT(slices, 0U);
  });
}

}  // namespace
}  // namespace concave_distance::detail::cone_slices_test

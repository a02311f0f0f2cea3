#include "distance/niches/niche_decider.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <set>

#include "base/constants.h"
#include "concave_distance/loading/load_body_mesh.h"
#include "distance/minima/minima_tracker.h"
#include "distance/niches/meeting_pairs.h"
#include "support/body_motions.h"
#include "support/body_pairs.h"
#include "support/judged_niches.h"

// Decisions by what is kept from pose to pose against searches at every pose.

namespace concave_distance::detail::niche_decider_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using test::nichesOf;
using Body = std::shared_ptr<const BodyMesh>;
using Decision = NicheDecider::Decision;

std::vector<MinimumCandidate> candidatesAt(const PairFrame& scene) {
  MinimaTracker front;
  WorkLimit none;
  std::vector<MinimumCandidate> candidates;
  LocalMinimaCost cost;
  MeetingPairs met;
  EXPECT_TRUE(met.collect(scene, cost, none));
  for (const MeetingPair& pair : met.pairs()) {
    candidates.push_back(
        candidateOn(pair.a, pair.b, pair.distance > 4.0 * scene.rounding ? pair.distance : 0.0));
  }
  front.collect(scene, NormalSides::Outside, kInfinity, candidates, none);
  return candidates;
}

std::vector<double> nichesBySearches(const PairFrame& scene, std::vector<MinimumCandidate> candidates,
                                     double least_prominence) {
  NicheDecider once;
  WorkLimit none;
  NicheDecider::Request request;
  request.rule.least_prominence = least_prominence;
  request.is_tracked = false;
  once.judge(scene, candidates, request, none);
  return nichesOf(once);
}

void expectSame(const std::vector<double>& found, const std::vector<double>& truth) {
  ASSERT_EQ(found.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(found[i], truth[i], 1e-11);
}

TEST(NicheDecider, AreThoseOfSearchesAtEveryPoseOfAnyMotion) {
  RandomEngine engine(21);
  NicheDecider::Counts sum;
  for (std::uint32_t run = 0; run < 200; ++run) {
    const Body a = makeBody(test::concaveShape(run));
    const Body b = makeBody(test::concaveShape(run / 6));
    const test::Motion motion = test::randomMotion(engine);
    const double step = std::pow(10.0, -5.0 + 4.0 * uniformUnit(engine));
    const double least_prominence = run % 2 == 0 ? 1e-2 : 0.3;
    SCOPED_TRACE("run " + std::to_string(run) + ", step " + std::to_string(step));
    NicheDecider decider;
    NicheDecider::Request request;
    request.rule.least_prominence = least_prominence;
    for (int k = 0; k < 40; ++k) {
      const PairFrame scene = PairFrame::withFacets(*a, *b, motion.at(step * k));
      std::vector<MinimumCandidate> candidates = candidatesAt(scene);
      WorkLimit none;
      decider.judge(scene, candidates, request, none);
      expectSame(nichesOf(decider), nichesBySearches(scene, candidates, least_prominence));
      if (HasFailure()) return;
      sum.by_path += decider.counts().by_path;
      sum.by_boundary += decider.counts().by_boundary;
      sum.mended += decider.counts().mended;
      sum.searches += decider.counts().searches;
    }
  }
  // All ways to a decision were taken.
  EXPECT_GT(sum.by_path, 1000U);
  EXPECT_GT(sum.by_boundary, 1000U);
  EXPECT_GT(sum.mended, 100U);
  EXPECT_GT(sum.searches, 100U);
}

// Links of many shells: surfaces in the material of others hold deeper places, in sight of nobody.
TEST(NicheDecider, AreThoseOfSearchesForLinksOfManyShells) {
  const std::string folder = CONCAVE_DISTANCE_SOURCE_DIR "/meshes/wam/";
  const Body a = loadBodyMesh(folder + "wam_base.stl").mesh;
  const Body b = loadBodyMesh(folder + "wam4.stl").mesh;
  ASSERT_FALSE(a->shellContacts().joints.empty() && b->shellContacts().joints.empty());
  RandomEngine engine(22);
  std::uint32_t by_boundary = 0;
  for (int run = 0; run < 6; ++run) {
    test::Motion motion = test::randomMotion(engine);
    motion.centre = 0.6 * a->diameter() * motion.centre.normalized();
    motion.reach *= 0.3 * a->diameter();
    SCOPED_TRACE("run " + std::to_string(run));
    NicheDecider decider;
    const NicheDecider::Request request;
    for (int k = 0; k < 50; ++k) {
      Isometry3d pose = motion.at(0.005 * k);
      pose.translation() -= pose.linear() * b->surface().boundingBox().center();
      pose.pretranslate(a->surface().boundingBox().center());
      const PairFrame scene = PairFrame::withFacets(*a, *b, pose);
      std::vector<MinimumCandidate> candidates = candidatesAt(scene);
      WorkLimit none;
      decider.judge(scene, candidates, request, none);
      expectSame(nichesOf(decider), nichesBySearches(scene, candidates, request.rule.least_prominence));
      if (HasFailure()) return;
      by_boundary += decider.counts().by_boundary;
    }
  }
  EXPECT_GT(by_boundary, 200U);
}

TEST(NicheDecider, NeedNoSearchWhereNothingHasMoved) {
  const Body a = makeBody(test::concaveShape(5));
  const Body b = makeBody(test::concaveShape(1));
  const PairFrame scene = PairFrame::withFacets(*a, *b, test::translation(Vector3d(0.3, 0.2, 2.0)));
  std::vector<MinimumCandidate> candidates = candidatesAt(scene);
  NicheDecider decider;
  WorkLimit none;
  decider.judge(scene, candidates, {}, none);
  const std::vector<double> first = nichesOf(decider);
  EXPECT_GT(decider.counts().searches, 0U);
  decider.judge(scene, candidates, {}, none);
  EXPECT_EQ(decider.counts().searches, 0U);
  EXPECT_EQ(decider.counts().visited_pairs, 0U);
  EXPECT_EQ(decider.counts().measured, 0U);
  EXPECT_EQ(decider.counts().by_boundary, first.size());
  EXPECT_EQ(nichesOf(decider), first);
}

TEST(NicheDecider, GiveANicheTheSameBasinWhileItStands) {
  const Body a = makeBody(test::makeComb(4));
  const Body b = makeBody(test::makeComb(3));
  NicheDecider decider;
  std::set<std::uint64_t> first;
  for (int k = 0; k < 20; ++k) {
    const PairFrame scene =
        PairFrame::withFacets(*a, *b, test::translation(Vector3d(0.2 + 1e-4 * k, 0.1, 3.0 + 1e-4 * k)));
    std::vector<MinimumCandidate> candidates = candidatesAt(scene);
    WorkLimit none;
    decider.judge(scene, candidates, {}, none);
    std::set<std::uint64_t> basins;
    for (const NicheDecider::Judged& judged : decider.judged()) {
      if (judged.decision != Decision::Niche) continue;
      EXPECT_TRUE(basins.insert(judged.basin).second);
    }
    if (k == 0) first = basins;
    EXPECT_EQ(basins, first);
  }
  EXPECT_FALSE(first.empty());
}

TEST(NicheDecider, SearchNothingThatIsNotWanted) {
  const Body a = makeBody(test::concaveShape(0));
  const Body b = makeBody(test::concaveShape(3));
  const PairFrame scene = PairFrame::withFacets(*a, *b, test::translation(Vector3d(0.3, 0.2, 2.0)));
  std::vector<MinimumCandidate> candidates = candidatesAt(scene);
  NicheDecider decider;
  NicheDecider::Request request;
  request.is_wanted = [](const MinimumCandidate&, Occluder&) { return false; };
  WorkLimit none;
  decider.judge(scene, candidates, request, none);
  EXPECT_EQ(decider.counts().searches, 0U);
  EXPECT_TRUE(nichesOf(decider).empty());
  EXPECT_EQ(decider.judged().front().decision, Decision::Unwanted);
}

TEST(NicheDecider, AreRightAgainAfterALimitHasEndedThem) {
  RandomEngine engine(22);
  const std::atomic<bool> stop{true};
  bool was_undecided = false;
  for (std::uint32_t run = 0; run < 30; ++run) {
    const Body a = makeBody(test::concaveShape(run));
    const Body b = makeBody(test::concaveShape(run / 6));
    const test::Motion motion = test::randomMotion(engine);
    NicheDecider decider;
    for (int k = 0; k < 24; ++k) {
      const PairFrame scene = PairFrame::withFacets(*a, *b, motion.at(0.003 * k));
      std::vector<MinimumCandidate> candidates = candidatesAt(scene);
      if (k % 3 == 1) {
        WorkLimit stopped(std::chrono::steady_clock::now(), kInfinity,
                          k % 2 == 0 ? std::size_t{2000} : std::numeric_limits<std::size_t>::max(), &stop);
        decider.judge(scene, candidates, {}, stopped);
        const std::vector<double> truth = nichesBySearches(scene, candidates, 1e-2);
        for (const double distance : nichesOf(decider)) {
          EXPECT_TRUE(std::any_of(truth.begin(), truth.end(),
                                  [&](double d) { return std::abs(d - distance) < 1e-11; }));
        }
        for (const NicheDecider::Judged& judged : decider.judged()) {
          was_undecided = was_undecided || judged.decision == Decision::Undecided;
        }
        continue;
      }
      WorkLimit none;
      decider.judge(scene, candidates, {}, none);
      expectSame(nichesOf(decider), nichesBySearches(scene, candidates, 1e-2));
      if (HasFailure()) return;
    }
  }
  EXPECT_TRUE(was_undecided);
}

// An open sheet over a square of side 2 * half (m).
template <typename HeightAt>
SurfaceMesh makeSheet(std::uint32_t count, double half, bool faces_up, const HeightAt& height_at) {
  std::vector<Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  const auto place = [&](std::uint32_t k) { return half * (2.0 * k / count - 1.0); };
  const auto node = [&](std::uint32_t i, std::uint32_t j) { return NodeIndex{i * (count + 1) + j}; };
  for (std::uint32_t i = 0; i <= count; ++i) {
    for (std::uint32_t j = 0; j <= count; ++j) {
      vertices.emplace_back(place(i), place(j), height_at(place(i), place(j)));
      if (i == count || j == count) continue;
      triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  }
  if (!faces_up) {
    for (TriangleNodes& triangle : triangles) std::swap(triangle[1], triangle[2]);
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "sheet");
}

// Two flat hills below a flat bowl: the basin of each has thousands of facet pairs, and no cycle has the time
// for one of them.
TEST(NicheDecider, FinishALongSearchInLaterCyclesThoughEachIsCut) {
  const Body hills = makeBody(makeSheet(72, 0.5, true, [](double x, double y) {
    return 0.05 * std::sin(9.42 * x) - 0.3 * y * y - (x < 0.0 ? 0.002 : 0.0);
  }));
  const Body bowl =
      makeBody(makeSheet(72, 0.6, false, [](double x, double y) { return 0.1 * (x * x + y * y); }));
  const auto pose_at = [](int cycle) {
    Isometry3d pose(Eigen::AngleAxisd(0.01 + 1e-5 * cycle, Vector3d(1, 2, 2) / 3.0));
    pose.pretranslate(Vector3d(0.01 + 1e-5 * cycle, 0.003, 1.05));
    return pose;
  };
  WorkLimit none;
  NicheDecider whole;
  const PairFrame first = PairFrame::withFacets(*hills, *bowl, pose_at(0));
  std::vector<MinimumCandidate> candidates = candidatesAt(first);
  const auto start = WorkLimit::Clock::now();
  whole.judge(first, candidates, {}, none);
  const double seconds = std::chrono::duration<double>(WorkLimit::Clock::now() - start).count();
  const std::uint32_t visited = whole.counts().visited_pairs;
  ASSERT_GT(visited / whole.counts().searches, 5000U) << "a single search is long";

  NicheDecider cut;
  const double allowed = seconds / (8.0 * whole.counts().searches);
  bool is_decided = false;
  int cycle = 0;
  for (; cycle < 2000 && !is_decided; ++cycle) {
    const PairFrame frame = PairFrame::withFacets(*hills, *bowl, pose_at(cycle));
    candidates = candidatesAt(frame);
    WorkLimit limit(WorkLimit::Clock::now(), allowed, std::numeric_limits<std::size_t>::max(), nullptr);
    if (!cut.goOn(limit)) continue;  // what is known is kept, though this pose is left out
    cut.begin(frame, candidates, {}, none);
    cut.judgeByMemory(frame, {}, none);
    cut.judgeBySearches(frame, {}, limit);
    is_decided = std::none_of(cut.judged().begin(), cut.judged().end(), [](const auto& judged) {
      return judged.decision == Decision::Undecided || judged.decision == Decision::Open;
    });
    if (limit.hasRefusedTime()) cut.endCut();
    if (is_decided) expectSame(nichesOf(cut), nichesBySearches(frame, candidates, 1e-2));
  }
  EXPECT_TRUE(is_decided);
  EXPECT_GT(cycle, 4) << "the limit has to strike for this test to say anything";
}

// The basins of an earlier pose reach farther now, and no cycle has the time to see how far.
TEST(NicheDecider, MendABasinInLaterCyclesThoughEachIsCut) {
  const Body hills = makeBody(makeSheet(72, 0.5, true, [](double x, double y) {
    return 0.05 * std::sin(9.42 * x) - 0.3 * y * y - (x < 0.0 ? 0.002 : 0.0);
  }));
  const Body bowl =
      makeBody(makeSheet(72, 0.6, false, [](double x, double y) { return 0.1 * (x * x + y * y); }));
  const auto frame_at = [&](double height) {
    Isometry3d pose(Eigen::AngleAxisd(0.01, Vector3d(1, 2, 2) / 3.0));
    pose.pretranslate(Vector3d(0.01, 0.003, height));
    return PairFrame::withFacets(*hills, *bowl, pose);
  };
  const PairFrame before = frame_at(1.05);
  const PairFrame after = frame_at(1.15);
  WorkLimit none;
  const auto begun = [&] {
    NicheDecider decider;
    std::vector<MinimumCandidate> candidates = candidatesAt(before);
    decider.judge(before, candidates, {}, none);
    return decider;
  };
  NicheDecider whole = begun();
  std::vector<MinimumCandidate> candidates = candidatesAt(after);
  const auto start = WorkLimit::Clock::now();
  whole.judge(after, candidates, {}, none);
  double allowed = std::chrono::duration<double>(WorkLimit::Clock::now() - start).count();
  ASSERT_GT(whole.counts().mended, 0U);
  ASSERT_GT(whole.counts().visited_pairs, 1000U);

  int cycle = 0;
  std::uint32_t visited = 0;
  bool is_decided = false;
  // A busy machine makes the time longer than it is, or leaves a cycle too little for a single step.
  for (int attempt = 0; attempt < 10 && (cycle < 3 || !is_decided); ++attempt) {
    allowed /= 4.0;
    NicheDecider cut = begun();
    is_decided = false;
    visited = 0;
    for (cycle = 0; cycle < 500 && !is_decided; ++cycle) {
      candidates = candidatesAt(after);
      WorkLimit limit(WorkLimit::Clock::now(), allowed, std::numeric_limits<std::size_t>::max(), nullptr);
      cut.begin(after, candidates, {}, none);
      cut.judgeByMemory(after, {}, limit);
      cut.judgeBySearches(after, {}, limit);
      visited += cut.counts().visited_pairs;
      is_decided = std::none_of(cut.judged().begin(), cut.judged().end(), [](const auto& judged) {
        return judged.decision == Decision::Undecided || judged.decision == Decision::Open;
      });
      if (limit.hasRefusedTime()) cut.endCut();
    }
    if (!is_decided) {
      allowed *= 16.0;
      continue;
    }
    expectSame(nichesOf(cut), nichesBySearches(after, candidates, 1e-2));
  }
  ASSERT_TRUE(is_decided);
  EXPECT_GT(cycle, 2) << "the limit has to strike for this test to say anything";
  EXPECT_LT(visited, 2 * whole.counts().visited_pairs) << "each cycle goes on where the last one has ended";
}

// Niches that a short list leaves open are asked for one by one: what is found wrong on the way stays wrong.
TEST(NicheDecider, AreRightAfterAListThatWasCut) {
  RandomEngine engine(24);
  std::size_t asked_for = 0;
  for (std::uint32_t run = 0; run < 60; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    const Body a = makeBody(test::concaveShape(run));
    const Body b = makeBody(test::concaveShape(run / 6));
    const test::Motion motion = test::randomMotion(engine);
    NicheDecider decider;
    std::vector<TrianglePair> known;
    for (int k = 0; k < 24; ++k) {
      const PairFrame scene = PairFrame::withFacets(*a, *b, motion.at(0.01 * (k - k % 2)));
      std::vector<MinimumCandidate> candidates = candidatesAt(scene);
      const std::vector<double> truth = nichesBySearches(scene, candidates, 1e-2);
      NicheDecider::Request request;
      if (k % 2 == 0) request.most_niches = 1;
      WorkLimit none;
      decider.judge(scene, candidates, request, none);
      for (const TrianglePair& pair : known) decider.locate(scene, pair, request, none);
      for (const double distance : nichesOf(decider)) {
        EXPECT_TRUE(std::any_of(truth.begin(), truth.end(),
                                [&](double d) { return std::abs(d - distance) < 1e-11; }));
      }
      asked_for += known.size();
      if (k % 2 == 0) continue;
      expectSame(nichesOf(decider), truth);
      if (HasFailure()) return;
      known.clear();
      for (const NicheDecider::Judged& judged : decider.judged()) {
        if (judged.decision == Decision::Niche) known.push_back({judged.candidate.a, judged.candidate.b});
      }
    }
  }
  EXPECT_GT(asked_for, 1000U);
}

struct Scene {
  Body a;
  Body b;
  Isometry3d pose;
};

/// A strip of teeth, each a little higher than the one before, and a bar along all of their tips.
Scene washboard(std::size_t teeth) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  for (std::size_t i = 0; i <= 2 * teeth; ++i) {
    const double height = i % 2 == 0 ? 0.0 : 0.5 + 1e-6 * static_cast<double>(i);
    for (const double y : {-1.0, 1.0}) vertices.emplace_back(0.1 * static_cast<double>(i), y, height);
    if (i == 0) continue;
    const NodeIndex a{2 * i - 2};
    const NodeIndex b{2 * i - 1};
    triangles.push_back({a, NodeIndex{2 * i}, b});
    triangles.push_back({b, NodeIndex{2 * i}, NodeIndex{2 * i + 1}});
  }
  const double length = 0.2 * static_cast<double>(teeth);
  const auto bar = test::makeCuboid({-1.0, -0.5, 0.0}, {length + 1.0, 0.5, 0.1});
  return {makeBody(SurfaceMesh(vertices, triangles, "washboard")), makeBody(bar),
          test::translation({0, 0, 1.5})};
}

// As deep a chain of minima as there are teeth, on a stack that a recursion would run out of.
TEST(NicheDecider, NeedNoStackForALongWayDown) {
  struct Run {
    Scene scene = washboard(400);
    std::size_t judged = 0;
    std::uint32_t niche = 0;
    bool is_last = false;
  } run;
  const auto judge = [](void* argument) -> void* {
    Run& own = *static_cast<Run*>(argument);
    const PairFrame scene = PairFrame::withFacets(*own.scene.a, *own.scene.b, own.scene.pose);
    RefinementWorkspace workspace;
    WitnessPair first;
    first.squared_distance = kInfinity;
    for (std::uint32_t t = 0; t < own.scene.b->surface().triangleCount(); ++t) {
      const WitnessPair found =
          refineWitness(scene.a, scene.b, scene.a_from_b, TriangleIndex{0}, TriangleIndex{t}, workspace)
              .witness;
      if (found.squared_distance < first.squared_distance) first = found;
    }
    std::vector<MinimumCandidate> candidates{scene.candidateOf(first)};
    NicheDecider decider;
    NicheDecider::Request request;
    request.rule.least_prominence = 1.0;
    WorkLimit none;
    decider.judge(scene, candidates, request, none);
    own.niche = decider.locate(scene, {first.triangle_a, first.triangle_b}, request, none);
    own.judged = decider.judged().size();
    own.is_last = decider.judged()[own.niche].decision == Decision::Niche;
    return nullptr;
  };
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, std::size_t{64} << 10U);
  pthread_t thread{};
  ASSERT_EQ(pthread_create(&thread, &attributes, judge, &run), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  EXPECT_GT(run.judged, 200U);
  EXPECT_EQ(run.niche, run.judged - 1);
  EXPECT_TRUE(run.is_last);
}

// Neither the order of the candidates nor the measurement of passes changes what is a niche.
TEST(NicheDecider, AreThoseOfMeasuredPassesWhateverTheOrderOfTheCandidates) {
  RandomEngine engine(31);
  std::size_t united = 0;
  for (int run = 0; run < 40; ++run) {
    const Scene drawn{makeBody(test::concaveShape(uniformIndex(engine, 6))),
                      makeBody(test::concaveShape(uniformIndex(engine, 6))), test::randomPose(engine, 1.2)};
    LocalMinimaRequest measured;
    measured.rule.least_prominence = 0.1;
    measured.rule.prominence_limit = 0.2;
    const LocalMinima truth = findLocalMinima(*drawn.a, *drawn.b, drawn.pose, measured);
    const PairFrame scene = PairFrame::withFacets(*drawn.a, *drawn.b, drawn.pose);
    std::vector<MinimumCandidate> candidates = candidatesAt(scene);
    if (!candidates.empty() && truth.niches.front().distance == 0.0) continue;  // many candidates, one niche
    std::reverse(candidates.begin() + static_cast<std::ptrdiff_t>(candidates.size() / 3), candidates.end());
    const std::vector<double> niches = nichesBySearches(scene, candidates, 0.1);
    ASSERT_EQ(niches.size(), truth.niches.size()) << run;
    for (std::size_t i = 0; i < niches.size(); ++i) EXPECT_NEAR(niches[i], truth.niches[i].distance, 1e-12);
    united += candidates.size() - niches.size();
  }
  EXPECT_GT(united, 20U);
}

}  // namespace
}  // namespace concave_distance::detail::niche_decider_test

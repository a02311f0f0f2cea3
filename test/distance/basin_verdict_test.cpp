#include "distance/basin_verdict.h"
#include "mesh/trees/normal_cone_tree.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "distance/cone_sweep.h"
#include "distance/minima_checks.h"

namespace concave_distance {
namespace {

using Eigen::Isometry3d;
using test::Body;
using test::makeBody;

constexpr std::size_t kNoLimit = 1'000'000;
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

struct Scene {
  Body a;
  Body b;
  Isometry3d pose;
};

Scene drawn(RandomEngine& engine) {
  return {makeBody(test::concaveShape(uniformIndex(engine, 6))),
          makeBody(test::concaveShape(uniformIndex(engine, 6))), test::randomPose(engine, 1.2)};
}

std::vector<MinimumSeed> sweptAtOnce(const Scene& scene) {
  ConeSweep sweep;
  std::vector<MinimumSeed> found;
  sweep.advance(*scene.a, *scene.b, scene.pose, NormalSides::Both, 10.0, kAll, found);
  return found;
}

std::vector<BasinSeed> seedsOf(const std::vector<MinimumSeed>& minima, double least_prominence) {
  std::vector<BasinSeed> seeds;
  seeds.reserve(minima.size());
  for (const MinimumSeed& m : minima)
    seeds.push_back({m.a, m.b, m.distance, least_prominence, true, kNoLimit});
  return seeds;
}

/// The niches above 0 with the least prominence, ascending.
std::vector<double> distancesOf(const std::vector<LocalMinimum>& niches) {
  std::vector<double> distances;
  for (const LocalMinimum& niche : niches) {
    if (niche.distance > 0.0) distances.push_back(niche.distance);
  }
  return distances;
}

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

// As deep a chain of basins as there are teeth, on a stack that a recursion would run out of.
TEST(BasinVerdict, ALongWayDownNeedsNoStack) {
  struct Run {
    Scene scene = washboard(400);
    std::size_t basins = 0;
    std::uint32_t root = 0;
  } run;
  const auto judge = [](void* argument) -> void* {
    Run& own = *static_cast<Run*>(argument);
    const Scene& scene = own.scene;
    RefinementWorkspace workspace;
    WitnessPair first;
    first.squared_distance = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < scene.b->surface().triangleCount(); ++t) {
      const WitnessPair found =
          refineWitness(*scene.a, *scene.b, scene.pose, TriangleIndex{0}, TriangleIndex{t}, workspace)
              .witness;
      if (found.squared_distance < first.squared_distance) first = found;
    }
    BasinVerdicts verdicts;
    judgeBasins(
        *scene.a, *scene.b, scene.pose,
        {{first.triangle_a, first.triangle_b, std::sqrt(first.squared_distance), 1.0, true, kNoLimit}},
        verdicts);
    own.basins = verdicts.basins().size();
    own.root = verdicts.rootOf(verdicts.basinOf(0));
    return nullptr;
  };
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, std::size_t{64} << 10U);
  pthread_t thread{};
  ASSERT_EQ(pthread_create(&thread, &attributes, judge, &run), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  EXPECT_GT(run.basins, 200U);
  EXPECT_EQ(run.root, run.basins - 1);
}

TEST(BasinVerdict, RootsAreTheNichesWhateverTheOrderOfTheSeeds) {
  RandomEngine engine(31);
  std::size_t united = 0;
  for (int run = 0; run < 40; ++run) {
    const Scene scene = drawn(engine);
    LocalMinimaRequest request;
    request.least_prominence = 0.1;
    request.prominence_limit = 0.2;  // another flood than the one that is tested
    request.through_material = true;
    const LocalMinima truth = findLocalMinima(*scene.a, *scene.b, scene.pose, request);
    if (truth.niches.front().distance == 0.0) continue;  // floods from contact are no seeds of the cones
    std::vector<BasinSeed> seeds = seedsOf(sweptAtOnce(scene), request.least_prominence);
    std::reverse(seeds.begin() + static_cast<std::ptrdiff_t>(seeds.size() / 3), seeds.end());
    BasinVerdicts verdicts;
    judgeBasins(*scene.a, *scene.b, scene.pose, seeds, verdicts);
    std::vector<double> roots;
    for (std::uint32_t i = 0; i < verdicts.basins().size(); ++i) {
      const Basin& basin = verdicts.basins()[i];
      EXPECT_FALSE(basin.undecided);
      if (basin.owner == i) {
        roots.push_back(basin.distance);
        continue;
      }
      ++united;
      EXPECT_LE(basin.pass, 1.1 * basin.distance + 1e-12);
      EXPECT_GE(basin.pass, basin.distance - 1e-12);
    }
    std::sort(roots.begin(), roots.end());
    const std::vector<double> expected = distancesOf(truth.niches);
    ASSERT_EQ(roots.size(), expected.size()) << run;
    for (std::size_t i = 0; i < roots.size(); ++i) EXPECT_NEAR(roots[i], expected[i], 1e-12);
  }
  EXPECT_GT(united, 20U);
}

TEST(BasinVerdict, KnownNichesTakeUpCandidatesAndAreTakenUpByDeeperOnes) {
  constexpr double kLeast = 1.0;
  constexpr double kFar = 20.0;
  RandomEngine engine(32);
  int taken_up = 0;
  for (int run = 0; run < 40; ++run) {
    const Scene scene = drawn(engine);
    std::vector<BasinSeed> seeds = seedsOf(sweptAtOnce(scene), kLeast);
    BasinVerdicts all;
    judgeBasins(*scene.a, *scene.b, scene.pose, seeds, all);
    // Each seed that is no root, known and not judged, beside its root as the candidate.
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const std::uint32_t root = all.rootOf(all.basinOf(i));
      const Basin& deep = all.basins()[root];
      if (deep.distance < 1e-6) continue;  // floods from contact go nowhere
      if (root == all.basinOf(i) || all.basins()[all.basinOf(i)].owner != root) continue;
      const std::vector<BasinSeed> two = {
          {seeds[i].a, seeds[i].b, seeds[i].distance, kLeast, false, kNoLimit},
          {deep.a, deep.b, deep.distance, kFar, true, kNoLimit}};
      BasinVerdicts verdicts;
      judgeBasins(*scene.a, *scene.b, scene.pose, two, verdicts);
      // How far the flood of the deeper one goes, and how little the shallower one stands out, decides.
      const Basin& shallow = all.basins()[all.basinOf(i)];
      if (shallow.pass > (1.0 + kFar) * deep.distance) continue;
      ++taken_up;
      EXPECT_EQ(verdicts.rootOf(verdicts.basinOf(0)), verdicts.rootOf(verdicts.basinOf(1)));
      EXPECT_LE(verdicts.basins()[verdicts.basinOf(0)].pass, (1.0 + kLeast) * seeds[i].distance + 1e-12);
      // The other way round the shallow one is judged and runs into the known one, or into another deeper
      // one.
      judgeBasins(*scene.a, *scene.b, scene.pose,
                  {{seeds[i].a, seeds[i].b, seeds[i].distance, kLeast, true, kNoLimit},
                   {deep.a, deep.b, deep.distance, kLeast, false, kNoLimit}},
                  verdicts);
      const std::uint32_t owner = verdicts.rootOf(verdicts.basinOf(0));
      EXPECT_NE(owner, verdicts.basinOf(0));
      EXPECT_LT(verdicts.basins()[owner].distance, seeds[i].distance);
    }
  }
  EXPECT_GT(taken_up, 5);
}

TEST(BasinVerdict, AFloodThatIsCutShortSaysSo) {
  RandomEngine engine(33);
  const Scene scene = drawn(engine);
  std::vector<BasinSeed> seeds = seedsOf(sweptAtOnce(scene), 10.0);
  seeds.resize(1);
  seeds.front().largest_flood = 3;
  BasinVerdicts verdicts;
  judgeBasins(*scene.a, *scene.b, scene.pose, seeds, verdicts);
  EXPECT_TRUE(verdicts.basins().front().undecided);
  EXPECT_LT(verdicts.floodedPairs(), 20U);
}

TEST(ConeSweep, InPortionsFindsWhatItFindsAtOnce) {
  RandomEngine engine(34);
  for (int run = 0; run < 20; ++run) {
    const Scene scene = drawn(engine);
    const auto places_of = [](const std::vector<MinimumSeed>& minima) {
      std::set<std::pair<std::uint32_t, std::uint32_t>> places;
      for (const MinimumSeed& m : minima) places.emplace(m.a.value, m.b.value);
      return places;
    };
    const auto at_once = places_of(sweptAtOnce(scene));
    ConeSweep sweep;
    std::vector<MinimumSeed> found;
    for (int call = 0; call < 2000; ++call) {
      sweep.advance(*scene.a, *scene.b, scene.pose, NormalSides::Both, 10.0, 7, found);
    }
    EXPECT_EQ(places_of(found), at_once);
  }
}

}  // namespace
}  // namespace concave_distance

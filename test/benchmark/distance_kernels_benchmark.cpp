// Times of the distance kernels, one thread. doc/numerics.md quotes this table.
//
//   distance_kernels_benchmark [--repeats 20]
//
// A row is a kernel on a kind of input: the least of `repeats` mean times over the inputs (the machine's
// other work only ever adds), nanoseconds, and what the inputs gave: for triangle pairs the share that meets,
// for the niche functions the witnesses' kind and how many triangle pairs the extent was followed over.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <limits>

#include "benchmark/support/benchmark_main.h"
#include "distance/niches/niche_properties.h"
#include "support/body_pairs.h"
#include "support/enumeration.h"
#include "support/triangle_pairs.h"

namespace concave_distance::benchmark {
namespace {

using Eigen::Vector3d;

double sink = 0.0;  ///< printed at the end, so that no call is optimised away

template <typename Call>
double leastNanoseconds(int repeats, std::size_t inputs, int calls_each, Call call) {
  double least = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < inputs; ++i) {
      for (int k = 0; k < calls_each; ++k) {
        sink += call(i);
      }
    }
    const double taken =
        std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
    least = std::min(least, taken / static_cast<double>(inputs) / calls_each);
  }
  return least;
}

void timeTriangles(const char* kind, int repeats,
                   const std::function<test::TrianglePair(RandomEngine&)>& draw) {
  RandomEngine engine(1);
  std::vector<test::TrianglePair> pairs;
  std::size_t meeting = 0;
  for (int i = 0; i < 4096; ++i) {
    pairs.push_back(draw(engine));
    meeting += triangleDistance(pairs.back().first, pairs.back().second).squared_distance == 0.0 ? 1 : 0;
  }
  const double ns = leastNanoseconds(repeats, pairs.size(), 1, [&](std::size_t i) {
    return triangleDistance(pairs[i].first, pairs[i].second).squared_distance;
  });
  std::printf("| triangleDistance | %s | %.0f | %.0f %% |\n", kind, ns,
              100.0 * static_cast<double>(meeting) / static_cast<double>(pairs.size()));
}

void timeNiche(const char* kind, int repeats, const std::shared_ptr<const BodyMesh>& a,
               const std::shared_ptr<const BodyMesh>& b, const Eigen::Isometry3d& pose) {
  const WitnessPair witness = test::enumerateTrianglePairs(*a, *b, pose);
  RefinementWorkspace refinement;
  ExtentWorkspace workspace;
  constexpr int kCalls = 2000;
  constexpr std::size_t kPairLimit = 64;
  const NicheExtent extent = measureExtent(*a, *b, pose, witness, 1e-9, kPairLimit, workspace);
  const auto row = [&](const char* kernel, auto call) {
    std::printf("| %s | %s | %.0f | %zu |\n", kernel, kind,
                leastNanoseconds(repeats, 1, kCalls, [&](std::size_t) { return call(); }),
                workspace.pieces.size());
  };
  row("refineWitness, already there", [&] {
    return refineWitness(*a, *b, pose, witness.triangle_a, witness.triangle_b, refinement)
        .witness.squared_distance;
  });
  row("measureExtent", [&] {
    return measureExtent(*a, *b, pose, witness, 1e-9, kPairLimit, workspace).length + extent.length;
  });
  row("classifyOutwardness", [&] { return static_cast<double>(classifyOutwardness(*a, *b, pose, witness)); });
  row("isVisible", [&] { return isVisible(*a, *b, pose, witness) ? 1.0 : 0.0; });
}

test::TrianglePair pairApart(RandomEngine& engine, double gap) {
  const Vector3d away = gap * test::randomRotation(engine).col(0);
  return {test::randomTriangle(engine),
          test::moved(test::randomTriangle(engine), Eigen::Matrix3d::Identity(), away)};
}

void run(int repeats) {
  std::printf(
      "| kernel | input | ns | triangles that meet, pieces of the extent |\n| --- | --- | --- | --- |\n");
  timeTriangles("size 1, 20 apart", repeats, [](RandomEngine& engine) { return pairApart(engine, 20.0); });
  timeTriangles("size 1, 2 apart", repeats, [](RandomEngine& engine) { return pairApart(engine, 2.0); });
  timeTriangles("size 1, on top of one another", repeats,
                [](RandomEngine& engine) { return pairApart(engine, 0.0); });
  for (const test::TrianglePairFamily& family : test::kTrianglePairFamilies) {
    timeTriangles(family.name, repeats, family.draw);
  }
  RandomEngine engine(5);
  const auto box = test::makeBody(test::makeCuboid(Vector3d::Zero(), Vector3d::Ones()));
  const auto hook = test::makeBody(test::makeHook());
  const auto comb = test::makeBody(test::makeComb(3));
  timeNiche("hook, comb: a point", repeats, hook, comb, test::randomPose(engine, 2.0));
  timeNiche("box over box: a patch", repeats, box, box, test::translation(Vector3d(0.3, 0.2, 1.3)));
  Eigen::Isometry3d tilted = test::translation(Vector3d(0.3, 0.2, 1.3));
  tilted.linear() = Eigen::AngleAxisd(-0.3, Vector3d::UnitY()).toRotationMatrix();
  timeNiche("tilted box over box: a segment", repeats, box, box, tilted);
  std::fprintf(stderr, "checksum %g\n", sink);
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  int repeats = 20;
  CLI::App app("Times of the distance kernels");
  app.add_option("--repeats", repeats)->capture_default_str()->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  run(repeats);
  return 0;
}

}  // namespace concave_distance::benchmark

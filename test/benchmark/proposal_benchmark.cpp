// Where niches begin: what descents from chosen places find of the niches that are new in a cycle.
//
//   proposal_benchmark [--pairs name,name,...] [--steps 500] [--descents 64] [--runs 8] [--output FILE]
//
// A row is a pair and a way to choose where descents start, at every instant of its motion (5 s long: 500 is
// 100 Hz) at which niches are new: `births`, their number; `found`, the mean share of them that a descent of
// a run ends in; microseconds of a run. Ways: `random`, triangles by area; `near`, triangles around a known
// niche; `motion`, the points of a known niche carried on along its body's relative motion, by up to 30
// cycles; `exchange`, a triangle of one known niche with one of another; `mixed`, a quarter of each. Pairs
// are in halves by their place in the list (`half`).
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <fstream>
#include <numeric>

#include "base/random_engine.h"
#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/kernels/closest_point.h"
#include "distance/kernels/witness_refinement.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance::benchmark {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kMostCycles = 30.0;
constexpr int kRings = 3;

/// Chooses where descents start.
class Proposer {
 public:
  Proposer(const BenchmarkPair& pair, std::uint64_t seed) : pair_(pair), engine_(seed) {
    for (const BodyMesh* body : {pair.a.get(), pair.b.get()}) areas_.push_back(cumulativeAreas(*body));
  }

  void setKnown(const std::vector<TrackedNiche>& known, const Isometry3d& before, const Isometry3d& now) {
    known_ = &known;
    before_ = before;
    now_ = now;
  }

  TrianglePair next(const std::string& way, int k) {
    static const std::array<const char*, 4> kWays{"random", "near", "motion", "exchange"};
    const std::string chosen = way == "mixed" ? kWays[static_cast<std::size_t>(k) % 4] : way;
    if (chosen == "random" || known_->empty()) return {randomOf(0), randomOf(1)};
    const WitnessPair& from = pick().witness;
    if (chosen == "near") return {around(*pair_.a, from.triangle_a), around(*pair_.b, from.triangle_b)};
    if (chosen == "exchange") return {from.triangle_a, pick().witness.triangle_b};
    return carried(from);
  }

 private:
  static std::vector<double> cumulativeAreas(const BodyMesh& body) {
    const SurfaceMesh& mesh = body.surface();
    std::vector<double> sums;
    double sum = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
      const TriangleIndex triangle{t};
      const Vector3d u = mesh.corner(triangle, 1) - mesh.corner(triangle, 0);
      sum += u.cross(mesh.corner(triangle, 2) - mesh.corner(triangle, 0)).norm();
      sums.push_back(sum);
    }
    return sums;
  }

  const TrackedNiche& pick() {
    return (*known_)[uniformIndex(engine_, static_cast<std::uint32_t>(known_->size()))];
  }

  TriangleIndex randomOf(std::size_t body) {
    const std::vector<double>& sums = areas_[body];
    const auto at = std::lower_bound(sums.begin(), sums.end(), uniformUnit(engine_) * sums.back());
    return TriangleIndex{static_cast<std::uint32_t>(std::min(at, sums.end() - 1) - sums.begin())};
  }

  /// A few steps from triangle to triangle over common vertices.
  TriangleIndex around(const BodyMesh& body, TriangleIndex triangle) {
    const auto steps = uniformIndex(engine_, kRings + 1);
    for (std::uint32_t step = 0; step < steps; ++step) {
      const NodeIndex vertex = body.surface().triangle(triangle)[uniformIndex(engine_, 3)];
      const auto fan = body.topology().triangles_of_vertex.row(vertex.value);
      triangle = fan[uniformIndex(engine_, static_cast<std::uint32_t>(fan.size()))];
    }
    return triangle;
  }

  /// Each body's point where the other one's motion leads to.
  TrianglePair carried(const WitnessPair& from) {
    const Vector3d& point = from.point_b_in_a;
    const Vector3d moved = now_ * (before_.inverse() * point) - point;
    const double cycles = kMostCycles * uniformUnit(engine_);
    const Vector3d on_a = from.point_a_in_a + cycles * moved;
    const Vector3d on_b = now_.inverse() * Vector3d(point - cycles * moved);
    return {closestPoint(*pair_.a, on_a, from.triangle_a).triangle,
            closestPoint(*pair_.b, on_b, from.triangle_b).triangle};
  }

  const BenchmarkPair& pair_;
  RandomEngine engine_;
  std::vector<std::vector<double>> areas_;
  const std::vector<TrackedNiche>* known_ = nullptr;
  Isometry3d before_ = Isometry3d::Identity();
  Isometry3d now_ = Isometry3d::Identity();
};

struct Result {
  std::vector<double> found;
  std::vector<double> run_us;
};

}  // namespace

int benchmarkMain(int argc, char** argv) {
  std::vector<std::string> names = allPairs();
  int steps = 500;
  int descents = 64;
  int runs = 8;
  std::string output;
  CLI::App app("Where niches begin");
  app.add_option("--pairs", names, "names")->delimiter(',');
  app.add_option("--steps", steps, "instants along the motion");
  app.add_option("--descents", descents, "of a run");
  app.add_option("--runs", runs, "at an instant, each with random numbers of its own");
  app.add_option("--output", output, "CSV file");
  CLI11_PARSE(app, argc, argv);
  std::ofstream file;
  if (!output.empty()) file.open(output);
  const char* header = "pair,half,way,births,found,run_us,sweep_us";
  std::printf("%s\n", header);
  if (file) file << header << '\n';
  const std::array<std::string, 5> ways{"random", "near", "motion", "exchange", "mixed"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const BenchmarkPair pair = loadBenchmarkPair(names[i]);
    const double tolerance = 1e-6 * (pair.a->diameter() + pair.b->diameter());
    TrackerParameters parameters;
    parameters.search_share = 0.0;
    PairTracker tracker(pair.name, pair.a, pair.b, parameters);
    PairSolution solution;
    Proposer proposer(pair, 1);
    std::vector<TrackedNiche> known;
    std::array<Result, ways.size()> results;
    std::vector<double> sweep_us;
    std::size_t births = 0;
    RefinementWorkspace workspace;
    for (int k = 0; k < steps; ++k) {
      const Isometry3d pose = pair.motion(static_cast<double>(k) / steps);
      const Isometry3d before = solution.a_from_b;
      tracker.update(pose, 5.0 * k / steps, solution);
      std::vector<TrackedNiche> new_niches;
      for (const TrackedNiche& niche : solution.niches) {
        if (k > 0 && niche.birth_cycle == solution.cycle && niche.kind == NicheKind::Point)
          new_niches.push_back(niche);
      }
      births += new_niches.size();
      sweep_us.push_back(1e6 * solution.stages[SolveStage::Sweep]);
      if (!new_niches.empty()) {
        proposer.setKnown(known, before, pose);
        for (std::size_t w = 0; w < ways.size(); ++w) {
          for (int run = 0; run < runs; ++run) {
            std::vector<bool> found(new_niches.size(), false);
            const auto start = std::chrono::steady_clock::now();
            for (int d = 0; d < descents; ++d) {
              const TrianglePair from = proposer.next(ways[w], d);
              const WitnessPair end =
                  refineWitness(*pair.a, *pair.b, pose, from.a, from.b, workspace).witness;
              for (std::size_t n = 0; n < new_niches.size(); ++n) {
                found[n] = found[n] || ((end.point_a_in_a - new_niches[n].point_a_in_a).norm() <= tolerance &&
                                        (end.point_b_in_a - new_niches[n].point_b_in_a).norm() <= tolerance);
              }
            }
            results[w].run_us.push_back(microsecondsSince(start));
            for (const bool one : found) results[w].found.push_back(one ? 1.0 : 0.0);
          }
        }
      }
      known = solution.niches;
    }
    for (std::size_t w = 0; w < ways.size(); ++w) {
      if (births == 0) continue;
      char line[256];
      std::snprintf(line, sizeof line, "%s,%c,%s,%zu,%.3f,%.0f,%.0f", names[i].c_str(),
                    i % 2 == 0 ? 'a' : 'b', ways[w].c_str(), births, mean(results[w].found),
                    median(results[w].run_us), median(sweep_us));
      std::printf("%s\n", line);
      std::fflush(stdout);
      if (file) file << line << '\n';
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark

// What long steps bring to descents on fine grids, and what they cost in niches.
//
//   descent_benchmark [--pairs obstacle_field,wam1_wam6,peg_in_hole,comb_in_comb] [--spacings
//   0.01,0.004,0.0016]
//                     [--descents 1000,20000] [--rings 1000000] [--output doc/results/descents.csv]
//
// A row is a pair at one pose, a grid (the longest edge as a share of the smaller body's diameter; 0:
// automatic) and a number of descents from random node pairs, all in one memory of basins: nodes of both
// grids; microseconds and evaluations a descent with steps along edges only and with long steps; the share of
// the true niches (the list that is proven, prominence 1e-2 or more, below 5 times the distance or a quarter
// of the smaller body) that the minima met are refined to. The last rows are two bumpy rings of so many
// triangles each, whose nodes are the search grid; they have no truth.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/shapes.h"
#include "benchmark/support/stopwatch.h"
#include "search/grid/body_grid.h"
#include "thesis/benchmark/support/proven_niches.h"
#include "thesis/src/evaluation/multi_start_descent.h"

namespace concave_distance::benchmark {
namespace {

using Body = std::shared_ptr<const BodyMesh>;

struct Scene {
  std::string name;
  double spacing;  ///< of the grid, of the smaller diameter
  Body a[2];       ///< without and with levels
  Body b[2];
  Eigen::Isometry3d pose;
  std::vector<TrackedNiche> truth;
};

void run(const Scene& scene, std::uint32_t descents, std::ofstream& csv) {
  double microseconds[2];
  double evaluations[2];
  double recall[2];
  for (int k = 0; k < 2; ++k) {
    const PairObjective objective(*scene.a[k], *scene.b[k], scene.pose);
    SearchWorkspace workspace(*scene.a[k], *scene.b[k]);
    RandomEngine engine(11);
    const auto start = std::chrono::steady_clock::now();
    const GeneticResult result = multiStartDescent(objective, descents, engine, workspace);
    microseconds[k] = microsecondsSince(start) / descents;
    evaluations[k] = static_cast<double>(result.cost.evaluations) / descents;
    recall[k] = shareMet(*scene.a[0], *scene.b[0], scene.pose, scene.truth, workspace.basins.minima());
  }
  const std::size_t nodes_a = gridOf(*scene.a[0]).graph().nodeCount();
  const std::size_t nodes_b = gridOf(*scene.b[0]).graph().nodeCount();
  std::printf("%-16s %7g %8zu %8zu %7u %8.2f %8.2f %7.0f %7.0f %5zu %6.3f %6.3f\n", scene.name.c_str(),
              scene.spacing, nodes_a, nodes_b, descents, microseconds[0], microseconds[1], evaluations[0],
              evaluations[1], scene.truth.size(), recall[0], recall[1]);
  std::fflush(stdout);
  if (csv) {
    csv << scene.name << ',' << scene.spacing << ',' << nodes_a << ',' << nodes_b << ',' << descents << ','
        << microseconds[0] << ',' << microseconds[1] << ',' << evaluations[0] << ',' << evaluations[1] << ','
        << scene.truth.size() << ',' << recall[0] << ',' << recall[1] << '\n';
  }
}

std::shared_ptr<const BodyMesh> makeBody(const std::string& name, const SurfaceMesh& surface,
                                         const BodyMeshOptions& options, bool with_levels) {
  const auto body = std::make_shared<const BodyMesh>(name, surface, options);
  SearchNodes nodes = makeSearchNodes(surface, options, name);
  if (!with_levels) nodes.levels = {};
  body->attach(std::make_unique<BodyGrid>(*body, std::move(nodes)));
  return body;
}

Scene makeScene(const std::string& name, const SurfaceMesh& a, const SurfaceMesh& b,
                const Eigen::Isometry3d& pose, double spacing) {
  Scene scene{name, spacing, {}, {}, pose, {}};
  for (int k = 0; k < 2; ++k) {
    BodyMeshOptions options;
    if (spacing > 0.0) options.max_edge_length = spacing * std::min(a.diameter(), b.diameter());
    scene.a[k] = makeBody(name, a, options, k == 1);
    scene.b[k] = makeBody(name, b, options, k == 1);
  }
  return scene;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Descents on fine grids, with long steps and without");
  std::vector<std::string> pairs = {"obstacle_field", "wam1_wam6", "peg_in_hole", "comb_in_comb"};
  std::vector<double> spacings = {0.0, 0.01, 0.004};
  std::vector<std::uint32_t> descents = {1000, 20000};
  std::vector<std::size_t> rings;
  std::string output;
  app.add_option("--pairs", pairs, "Benchmark pairs")->delimiter(',');
  app.add_option("--spacings", spacings, "Longest edges over the smaller diameter; 0: automatic")
      ->delimiter(',');
  app.add_option("--descents", descents, "Descents from random node pairs")->delimiter(',');
  app.add_option("--rings", rings, "Triangles of bumpy rings")->delimiter(',');
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);
  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    csv << "pair,spacing,nodes_a,nodes_b,descents,edges_us,long_us,edges_evaluations,long_evaluations,niches,"
           "edges_recall,long_recall\n";
  }
  std::printf("%-16s %7s %8s %8s %7s %8s %8s %7s %7s %5s %6s %6s\n", "pair", "spacing", "nodes a", "nodes b",
              "number", "edges us", "long us", "evals", "evals", "truth", "edges", "long");
  for (const std::string& name : pairs) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    for (const double spacing : spacings) {
      Scene scene = makeScene(name, pair.a->surface(), pair.b->surface(), pair.motion(0.3), spacing);
      scene.truth = provenNiches(scene.name, scene.a[0], scene.b[0], scene.pose);
      for (const std::uint32_t count : descents) run(scene, count, csv);
    }
  }
  for (const std::size_t triangles : rings) {
    const SurfaceMesh ring = makeBumpyRing(triangles);
    Eigen::Isometry3d pose(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 1.0, 0.0).normalized()));
    pose.translation() = Eigen::Vector3d(1.5, 0.3, 0.1);
    const Scene scene = makeScene("rings", ring, ring, pose, 1.0);  // no edge is as long: all vertices
    for (const std::uint32_t count : descents) run(scene, count, csv);
  }
  return 0;
}

}  // namespace concave_distance::benchmark

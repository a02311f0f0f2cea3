// What each part of the search brings, at equal numbers of evaluations.
//
//   ablation_benchmark [--pairs ...] [--budgets 10000,40000,160000] [--poses 5] [--seeds 10]
//                      [--output doc/results/ablation.csv]
//
// A row is a scene, a budget of node pair evaluations and a method: the share of the true outward niches
// (flood of the product graph, prominence >= 1e-2, cutoff 5 times the minimum or a quarter of the smaller
// body's diameter, whichever is larger) that the method met, with the archive (every local minimum met
// counts) and without it (the final population alone), the share of runs that met the nearest one, and the
// time a run.
#include <tbb/parallel_for.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "benchmark/support/reference_niches.h"
#include "benchmark/support/statistics.h"
#include "concave_distance/base/error.h"
#include "concave_distance/distance/enumeration.h"
#include "concave_distance/search/automatic_radii.h"
#include "concave_distance/search/genetic_search.h"
#include "concave_distance/search/local_descent.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kLeastProminence = 1e-2;

struct Method {
  const char* name;
  bool multi_start;
  NichingMethod niching;
  bool mating_restriction;
};

constexpr Method kMethods[] = {
    {"multi-start descent", true, NichingMethod::None, false},
    {"GA, no niching", false, NichingMethod::None, false},
    {"GA, sharing", false, NichingMethod::Sharing, true},
    {"GA, sharing, mate any", false, NichingMethod::Sharing, false},
    {"GA, dynamic sharing", false, NichingMethod::DynamicSharing, true},
    {"GA, deterministic crowding", false, NichingMethod::DeterministicCrowding, false},
};

struct Outcome {
  double archive_recall = 0.0;
  double population_recall = 0.0;
  double global = 0.0;
  double microseconds = 0.0;
  double evaluations = 0.0;
};

std::vector<WitnessPair> refineAll(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                                   const std::vector<TrialPoint>& points) {
  RefinementWorkspace workspace;
  std::vector<WitnessPair> witnesses;
  for (const TrialPoint& point : points) {
    witnesses.push_back(refineWitness(*pair.a, *pair.b, pose, pair.a->originalTriangle(point.node_a),
                                      pair.b->originalTriangle(point.node_b), workspace)
                            .witness);
  }
  return witnesses;
}

std::vector<TrialPoint> distinct(std::vector<TrialPoint> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end(),
                           [](const TrialPoint& l, const TrialPoint& r) { return samePlace(l, r); }),
               points.end());
  return points;
}

Outcome runOnce(const BenchmarkPair& pair, const Eigen::Isometry3d& pose, const Method& method,
                std::uint64_t budget, const std::vector<ReferenceNiche>& references, std::uint64_t seed) {
  const PairObjective objective(*pair.a, *pair.b, pose);
  SearchWorkspace workspace(*pair.a, *pair.b);
  RandomEngine engine(streamSeed(seed, method.name, 0));
  GeneticParameters parameters;
  parameters.max_generations = 100000;
  parameters.evaluation_limit = budget;
  parameters.niching = method.niching;
  parameters.mating_restriction = method.mating_restriction;
  const NicheRadii radii = automaticRadii(*pair.a, *pair.b, parameters);
  const auto start = std::chrono::steady_clock::now();
  const GeneticResult result = method.multi_start
                                   ? multiStartDescent(objective, 0xffffffffU, engine, workspace, budget)
                                   : geneticSearch(objective, parameters, radii, {}, engine, workspace);
  Outcome outcome;
  outcome.microseconds =
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  outcome.evaluations = static_cast<double>(result.cost.evaluations);
  const auto count = static_cast<double>(references.size());
  const std::vector<WitnessPair> archive = refineAll(pair, pose, distinct(workspace.basins.minima()));
  outcome.archive_recall =
      static_cast<double>(countRecalled(pair, pose, archive, references, kLeastProminence)) / count;
  outcome.global =
      static_cast<double>(countRecalled(pair, pose, archive, {references.front()}, kLeastProminence));
  if (!method.multi_start) {
    const std::vector<WitnessPair> population = refineAll(pair, pose, distinct(workspace.population));
    outcome.population_recall =
        static_cast<double>(countRecalled(pair, pose, population, references, kLeastProminence)) / count;
  }
  return outcome;
}

int main(int argc, char** argv) {
  CLI::App app("Ablation of the search at equal evaluations");
  std::vector<std::string> names = {"battery_fixture", "comb_in_comb", "wam3_wam5",
                                    "kr5_bicep_palm",  "stairs_leg",   "obstacle_field"};
  std::vector<std::uint64_t> budgets = {10000, 40000, 160000};
  std::size_t poses = 5;
  std::uint64_t seeds = 10;
  double edge_scale = 1.0;
  std::string output;
  app.add_option("--pairs", names, "Scenes")->delimiter(',');
  app.add_option("--budgets", budgets, "Evaluations a run")->delimiter(',');
  app.add_option("--poses", poses, "Instants along each motion");
  app.add_option("--seeds", seeds, "Runs a pose");
  app.add_option("--edge-scale", edge_scale, "Grid size as a factor of the automatic one");
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    csv << "pair,edge_scale,nodes_a,nodes_b,niches,budget,method,archive_recall,population_recall,global,"
           "microseconds,evaluations\n";
  }
  for (const std::string& name : names) {
    BenchmarkPair pair = loadBenchmarkPair(name);
    if (edge_scale != 1.0) {
      pair = loadBenchmarkPair(name, edge_scale * std::max(pair.a->maxEdgeLength(), pair.b->maxEdgeLength()));
    }
    std::vector<Eigen::Isometry3d> instants;
    std::vector<std::vector<ReferenceNiche>> references;
    double niches = 0.0;
    for (std::size_t k = 0; k < poses; ++k) {
      const Eigen::Isometry3d pose = pair.motion((static_cast<double>(k) + 0.5) / static_cast<double>(poses));
      const double nearest = std::sqrt(enumerateNodePairs(*pair.a, *pair.b, pose).squared_distance);
      const double cutoff = std::max(5.0 * nearest, 0.25 * std::min(pair.a->diameter(), pair.b->diameter()));
      instants.push_back(pose);
      references.push_back(referenceNiches(pair, pose, cutoff, kLeastProminence));
      niches += static_cast<double>(references.back().size()) / static_cast<double>(poses);
    }
    std::printf("%s: %zu x %zu nodes, %.1f niches mean over %zu poses\n", name.c_str(),
                pair.a->graph().nodeCount(), pair.b->graph().nodeCount(), niches, poses);
    for (const std::uint64_t budget : budgets) {
      for (const Method& method : kMethods) {
        std::vector<Outcome> outcomes(poses * seeds);
        tbb::parallel_for(std::size_t{0}, outcomes.size(), [&](std::size_t run) {
          const std::size_t k = run % poses;
          outcomes[run] = runOnce(pair, instants[k], method, budget, references[k], run / poses);
        });
        Outcome sum;
        for (const Outcome& outcome : outcomes) {
          const auto n = static_cast<double>(outcomes.size());
          sum.archive_recall += outcome.archive_recall / n;
          sum.population_recall += outcome.population_recall / n;
          sum.global += outcome.global / n;
          sum.microseconds += outcome.microseconds / n;
          sum.evaluations += outcome.evaluations / n;
        }
        std::printf("  %7llu %-28s archive %.3f population %.3f nearest %.3f  %8.0f us %8.0f evaluations\n",
                    static_cast<unsigned long long>(budget), method.name, sum.archive_recall,
                    sum.population_recall, sum.global, sum.microseconds, sum.evaluations);
        std::fflush(stdout);
        if (csv) {
          csv << name << ',' << edge_scale << ',' << pair.a->graph().nodeCount() << ','
              << pair.b->graph().nodeCount() << ',' << niches << ',' << budget << ',' << method.name << ','
              << sum.archive_recall << ',' << sum.population_recall << ',' << sum.global << ','
              << sum.microseconds << ',' << sum.evaluations << '\n';
        }
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace concave_distance::benchmark

int main(int argc, char** argv) {
  try {
    return concave_distance::benchmark::main(argc, argv);
  } catch (const concave_distance::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}

// What each part of the search brings, at equal numbers of evaluations.
//
//   ablation_benchmark [--pairs ...] [--budgets 10000,40000,160000] [--edge-scales 1,0.4] [--poses 2]
//                      [--seeds 8] [--output doc/results/ablation.csv]
//
// A row is a scene, a grid, a budget of node pair evaluations and a method: the share of the true outward
// niches (flood of the product graph, prominence >= 1e-2, cutoff 5 times the minimum or a quarter of the
// smaller body's diameter, whichever is larger) that the method met, with the archive (every local minimum
// met counts) and without it (the final population alone), the share of runs that met the nearest one, and
// the time a run. The last rows of a budget are multi-start descent again, with as many evaluations as fit
// into the time that the GA with sharing and the one with deterministic crowding took.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <fstream>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/search_trial.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kLeastProminence = 1e-2;
constexpr const char* kMultiStart = "multi-start descent";
constexpr const char* kSharing = "GA, sharing";
constexpr const char* kCrowding = "GA, deterministic crowding";

template <typename Change>
SearchMethod genetic(const char* name, Change&& change) {
  SearchMethod method{name, false, {}};
  method.parameters.max_generations = 1000000;
  change(method.parameters);
  return method;
}

std::vector<SearchMethod> methods() {
  using P = GeneticParameters;
  return {
      {kMultiStart, true, {}},
      genetic("GA, immigrants only",
              [](P& p) {
                p.crossover_probability = 0.0;
                p.mutation_probability = 0.0;
                p.immigrants = p.population_size;
              }),
      genetic("GA, no niching",
              [](P& p) {
                p.niching = NichingMethod::None;
                p.mating_restriction = false;
              }),
      genetic(kSharing, [](P&) {}),
      genetic("GA, sharing, niches not conserved", [](P& p) { p.conserve_niches = false; }),
      genetic("GA, sharing, mate any", [](P& p) { p.mating_restriction = false; }),
      genetic("GA, sharing, no exchange", [](P& p) { p.exchange_probability = 0.0; }),
      genetic("GA, sharing, N_pop 400", [](P& p) { p.population_size = 400; }),
      genetic("GA, sharing as in the thesis",
              [](P& p) {
                p.exchange_probability = 0.0;
                p.immigrants = 0;
                p.conserve_niches = false;
                p.fitness_epsilon = 0.0;
              }),
      genetic("GA, dynamic sharing", [](P& p) { p.niching = NichingMethod::DynamicSharing; }),
      genetic(kCrowding,
              [](P& p) {
                p.niching = NichingMethod::DeterministicCrowding;
                p.mating_restriction = false;
              }),
  };
}

class Report {
 public:
  explicit Report(const std::string& file) {
    if (!file.empty()) {
      csv_.open(file);
      csv_ << "pair,edge_scale,nodes_a,nodes_b,niches,budget,method,archive_recall,population_recall,"
              "nearest,microseconds,evaluations\n";
    }
  }
  void scene(const BenchmarkPair& pair, double edge_scale, const std::vector<SearchScene>& scenes) {
    niches_ = 0.0;
    for (const SearchScene& scene : scenes) {
      niches_ += static_cast<double>(scene.references.size()) / static_cast<double>(scenes.size());
    }
    pair_ = &pair;
    edge_scale_ = edge_scale;
    std::printf("%s, grid x%g: %zu x %zu nodes, %.1f niches mean over %zu poses\n", pair.name.c_str(),
                edge_scale, pair.a->graph().nodeCount(), pair.b->graph().nodeCount(), niches_, scenes.size());
  }
  void row(std::uint64_t budget, const std::string& method, const SearchOutcome& o) {
    std::printf("  %7llu %-38s archive %.3f population %.3f nearest %.3f  %8.0f us %8.0f evaluations\n",
                static_cast<unsigned long long>(budget), method.c_str(), o.archive_recall,
                o.population_recall, o.nearest, o.microseconds, o.evaluations);
    std::fflush(stdout);
    if (csv_) {
      csv_ << pair_->name << ',' << edge_scale_ << ',' << pair_->a->graph().nodeCount() << ','
           << pair_->b->graph().nodeCount() << ',' << niches_ << ',' << budget << ",\"" << method << "\","
           << o.archive_recall << ',' << o.population_recall << ',' << o.nearest << ',' << o.microseconds
           << ',' << o.evaluations << '\n';
    }
  }

 private:
  std::ofstream csv_;
  const BenchmarkPair* pair_ = nullptr;
  double edge_scale_ = 1.0;
  double niches_ = 0.0;
};

void runPair(const BenchmarkPair& pair, const std::vector<SearchScene>& scenes,
             const std::vector<std::uint64_t>& budgets, std::uint64_t seeds, Report& report) {
  for (const std::uint64_t budget : budgets) {
    double multi_start_speed = 0.0;  // evaluations a microsecond
    std::vector<std::pair<std::string, double>> times;
    for (SearchMethod& method : methods()) {
      method.parameters.evaluation_limit = budget;
      const SearchOutcome outcome = trySearches(pair, scenes, method, 1.0, seeds, kLeastProminence);
      report.row(budget, method.name, outcome);
      if (method.multi_start) {
        multi_start_speed = outcome.evaluations / outcome.microseconds;
      } else if (method.name == kSharing || method.name == kCrowding) {
        times.emplace_back(method.name, outcome.microseconds);
      }
    }
    for (const auto& [name, time] : times) {
      SearchMethod equal_time{"multi-start, time of " + name, true, {}};
      equal_time.parameters.evaluation_limit = static_cast<std::uint64_t>(multi_start_speed * time);
      report.row(budget, equal_time.name,
                 trySearches(pair, scenes, equal_time, 1.0, seeds, kLeastProminence));
    }
  }
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Ablation of the search at equal evaluations");
  std::vector<std::string> names = {"battery_fixture", "comb_in_comb", "wam3_wam5",
                                    "kr5_bicep_palm",  "stairs_leg",   "obstacle_field"};
  std::vector<std::uint64_t> budgets = {10000, 40000, 160000};
  std::vector<double> edge_scales = {1.0, 0.4};
  std::size_t poses = 2;
  std::uint64_t seeds = 8;
  std::string output;
  app.add_option("--pairs", names, "Scenes")->delimiter(',');
  app.add_option("--budgets", budgets, "Evaluations a run")->delimiter(',');
  app.add_option("--edge-scales", edge_scales, "Grid sizes as factors of the automatic one")->delimiter(',');
  app.add_option("--poses", poses, "Instants along each motion");
  app.add_option("--seeds", seeds, "Runs a pose");
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  Report report(output);
  for (const double edge_scale : edge_scales) {
    for (const std::string& name : names) {
      BenchmarkPair pair = loadBenchmarkPair(name);
      if (edge_scale != 1.0) {
        pair =
            loadBenchmarkPair(name, edge_scale * std::max(pair.a->maxEdgeLength(), pair.b->maxEdgeLength()));
      }
      const std::vector<SearchScene> scenes = searchScenes(pair, poses, kLeastProminence);
      report.scene(pair, edge_scale, scenes);
      runPair(pair, scenes, budgets, seeds, report);
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark

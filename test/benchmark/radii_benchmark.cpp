// The automatic sharing radius against half and twice its value.
//
//   radii_benchmark [--pairs ...] [--poses 5] [--seeds 10] [--output doc/results/radii.csv]
//
// The rule was chosen on the thesis's three scenes and frozen (src/search/automatic_radii.cpp); the robot
// links are pairs it has not seen. A row is a pair and a factor on all three radii: the share of the true
// outward niches (see searchScenes) that stand in the final population of 100 after 30 generations,
// with sharing alone and with the best of every niche conserved, and that the run has met at all.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <fstream>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/search_trial.h"
#include "search/automatic_radii.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kLeastProminence = 1e-2;

std::vector<std::string> thesisAndRobotPairs() {
  std::vector<std::string> names = {"notched_boxes", "grooved_cylinder", "battery_fixture"};
  for (const std::string& robot : robotPairs()) {
    names.push_back(robot);
  }
  return names;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Automatic radii on pairs of links");
  std::vector<std::string> names = thesisAndRobotPairs();
  std::size_t poses = 5;
  std::uint64_t seeds = 10;
  std::string output;
  app.add_option("--pairs", names, "Pairs to run")->delimiter(',');
  app.add_option("--poses", poses, "Instants along each motion");
  app.add_option("--seeds", seeds, "Runs a pose");
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    csv << "pair,niches,factor,sharing_radius,population_recall_sharing,population_recall_conserved,"
           "archive_recall\n";
  }
  std::printf("%-20s %7s %7s %9s %10s %10s %8s\n", "pair", "niches", "factor", "sigma_s/m", "sharing",
              "conserved", "archive");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    const std::vector<SearchScene> scenes = searchScenes(pair, poses, kLeastProminence);
    double niches = 0.0;
    for (const SearchScene& scene : scenes) {
      niches += static_cast<double>(scene.references.size()) / static_cast<double>(scenes.size());
    }
    SearchMethod conserved{"conserved", {}};
    SearchMethod sharing{"sharing", {}};
    sharing.parameters.conserve_niches = false;
    for (const double factor : {0.5, 1.0, 2.0}) {
      const double radius = factor * automaticRadii(*pair.a, *pair.b, {}).sharing;
      const SearchOutcome alone = trySearches(pair, scenes, sharing, factor, seeds, kLeastProminence);
      const SearchOutcome kept = trySearches(pair, scenes, conserved, factor, seeds, kLeastProminence);
      std::printf("%-20s %7.1f %7.1f %9.4f %10.3f %10.3f %8.3f\n", name.c_str(), niches, factor, radius,
                  alone.population_recall, kept.population_recall, kept.archive_recall);
      std::fflush(stdout);
      if (csv) {
        csv << name << ',' << niches << ',' << factor << ',' << radius << ',' << alone.population_recall
            << ',' << kept.population_recall << ',' << kept.archive_recall << '\n';
      }
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark

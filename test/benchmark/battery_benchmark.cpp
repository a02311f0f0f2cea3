// The thesis's battery and fixture in the static pose: robustness over seeded runs.
//
//   battery_benchmark [--runs 1000] [--niche-runs 500] [--output doc/results/battery.csv]
//
// First block: comb-GA-wl with N_pop 80 (Table 5.2): runs whose best node pair is the enumeration's optimum.
// Second block: comb-GA-wl-sh with N_pop 100 and automatic radii (Tables 4.1 and 5.8 with N_pop 100): niches
// of the FINAL POPULATION by greedy identification with sigma_n = 0.6 (the thesis's measure: 9.19 mean, 7 to
// 12), the nine references that the refined final population meets, and the nine that the archive (a cold
// tracker with the same parameters) reports, with duplicates. References: the flood of the product graph,
// refined.
#include <tbb/parallel_for.h>
#include <CLI/CLI.hpp>

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
#include "concave_distance/tracking/pair_tracker.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kThesisNicheRadius = 0.6;
constexpr double kLeastProminence = 1e-2;

struct NicheRun {
  std::size_t population_niches = 0;
  RecallCount population;
  RecallCount archive;
};

GeneticParameters combGaWl() {
  GeneticParameters parameters;  // Table 5.2
  parameters.population_size = 80;
  parameters.mutation_probability = 1.0 / 80.0;
  parameters.max_generations = 100;
  parameters.niching = NichingMethod::None;
  parameters.mating_restriction = false;
  return parameters;
}

GeneticParameters combGaWlSh() {
  GeneticParameters parameters;  // Tables 4.1 and 5.8 with N_pop 100; radii automatic
  parameters.population_size = 100;
  parameters.max_generations = 50;
  return parameters;
}

std::vector<WitnessPair> refinePopulation(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                                          const std::vector<IdentifiedNiche>& niches) {
  RefinementWorkspace workspace;
  std::vector<WitnessPair> witnesses;
  for (const IdentifiedNiche& niche : niches) {
    const WitnessPair witness =
        refineWitness(*pair.a, *pair.b, pose, pair.a->originalTriangle(niche.best.node_a),
                      pair.b->originalTriangle(niche.best.node_b), workspace)
            .witness;
    if (classifyOutwardness(*pair.a, *pair.b, pose, witness) != Outwardness::ThroughMaterial) {
      witnesses.push_back(witness);
    }
  }
  return witnesses;
}

NicheRun nicheRun(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                  const std::vector<ReferenceNiche>& references, double cutoff, std::uint64_t seed) {
  NicheRun run;
  const GeneticParameters parameters = combGaWlSh();
  const PairObjective objective(*pair.a, *pair.b, pose);
  SearchWorkspace workspace(*pair.a, *pair.b);
  RandomEngine engine(streamSeed(seed, "battery_benchmark", 0));
  geneticSearch(objective, parameters, automaticRadii(*pair.a, *pair.b, parameters), {}, engine, workspace);
  std::vector<IdentifiedNiche> niches;
  std::vector<std::uint32_t> order;
  identifyNiches(workspace.population, kThesisNicheRadius, workspace.metric, niches, order);
  run.population_niches = niches.size();
  run.population =
      countRecall(pair, pose, refinePopulation(pair, pose, niches), references, cutoff, kLeastProminence);

  TrackerParameters tracking;
  tracking.cold = parameters;
  tracking.seed = seed;
  tracking.least_prominence = kLeastProminence;
  const PairSolution solution = solveOnce("battery_benchmark", pair.a, pair.b, tracking, pose);
  std::vector<WitnessPair> archive;
  for (const TrackedNiche& niche : solution.niches) {
    archive.push_back(niche.witness);
  }
  run.archive = countRecall(pair, pose, archive, references, cutoff, kLeastProminence);
  return run;
}

int main(int argc, char** argv) {
  CLI::App app("Robustness on the battery and fixture");
  std::uint32_t runs = 1000;
  std::uint32_t niche_runs = 500;
  std::string output;
  app.add_option("--runs", runs, "Runs of comb-GA-wl");
  app.add_option("--niche-runs", niche_runs, "Runs of comb-GA-wl-sh");
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  const BenchmarkPair pair = loadBenchmarkPair("battery_fixture");
  const Eigen::Isometry3d pose = pair.motion(0.0);
  const double cutoff = pair.b->diameter();
  const NodePairMinimum optimum = enumerateNodePairs(*pair.a, *pair.b, pose);
  std::printf("fixture %zu nodes, battery %zu nodes, enumeration %.6f\n", pair.a->graph().nodeCount(),
              pair.b->graph().nodeCount(), std::sqrt(optimum.squared_distance));

  std::vector<char> optimal(runs, 0);
  std::vector<double> generations(runs, 0.0);
  tbb::parallel_for(std::uint32_t{0}, runs, [&](std::uint32_t run) {
    const PairObjective objective(*pair.a, *pair.b, pose);
    SearchWorkspace workspace(*pair.a, *pair.b);
    RandomEngine engine(streamSeed(run, "battery_benchmark", 1));
    const GeneticParameters parameters = combGaWl();
    const GeneticResult result = geneticSearch(
        objective, parameters, automaticRadii(*pair.a, *pair.b, parameters), {}, engine, workspace);
    optimal[run] = result.best.squared_distance <= optimum.squared_distance * (1.0 + 1e-12) ? 1 : 0;
    generations[run] = result.best_generation;
  });
  std::uint32_t successes = 0;
  for (const char success : optimal) {
    successes += success != 0 ? 1U : 0U;
  }
  std::printf("comb-GA-wl N_pop 80: optimum in %u of %u runs; G_i mean %.2f, most %.0f\n", successes, runs,
              mean(generations), percentile(generations, 1.0));

  const std::vector<ReferenceNiche> references = referenceNiches(pair, pose, cutoff, kLeastProminence);
  std::printf("references (outward, prominence >= %.0e, below %.3f): %zu\n", kLeastProminence, cutoff,
              references.size());
  for (const ReferenceNiche& reference : references) {
    std::printf("  exact %.4f, nodes %.4f, prominence on the grid %.3f\n",
                std::sqrt(reference.witness.squared_distance), reference.node_distance,
                reference.node_prominence);
  }
  std::vector<NicheRun> niche(niche_runs);
  tbb::parallel_for(std::uint32_t{0}, niche_runs,
                    [&](std::uint32_t run) { niche[run] = nicheRun(pair, pose, references, cutoff, run); });
  std::uint32_t population_all = 0;
  std::uint32_t archive_all = 0;
  std::uint32_t with_duplicates = 0;
  std::uint32_t with_others = 0;
  std::vector<double> counts;
  std::vector<double> population_recalled;
  for (const NicheRun& run : niche) {
    counts.push_back(static_cast<double>(run.population_niches));
    population_recalled.push_back(static_cast<double>(run.population.recalled));
    population_all += run.population.recalled == references.size() ? 1U : 0U;
    archive_all += run.archive.recalled == references.size() ? 1U : 0U;
    with_duplicates += run.archive.duplicates > 0 ? 1U : 0U;
    with_others += run.archive.others > 0 ? 1U : 0U;
  }
  std::printf("comb-GA-wl-sh N_pop 100, %u runs\n", niche_runs);
  std::printf("  final population: N_Gamma %.2f [%.0f-%.0f]; references met %.2f mean; all in %u runs\n",
              mean(counts), percentile(counts, 0.0), percentile(counts, 1.0), mean(population_recalled),
              population_all);
  std::printf(
      "  archive: all references in %u runs; runs with a duplicate %u; with another niche below the cutoff "
      "%u\n",
      archive_all, with_duplicates, with_others);
  if (!output.empty()) {
    std::ofstream csv(output);
    csv << "quantity,value,of\ncomb_ga_wl_optimum," << successes << ',' << runs << "\nreferences,"
        << references.size() << ",\npopulation_niches_mean," << mean(counts) << ",\npopulation_niches_least,"
        << percentile(counts, 0.0) << ",\npopulation_niches_most," << percentile(counts, 1.0)
        << ",\npopulation_references_mean," << mean(population_recalled) << ',' << references.size()
        << "\npopulation_all_references," << population_all << ',' << niche_runs
        << "\narchive_all_references," << archive_all << ',' << niche_runs << "\narchive_runs_with_duplicate,"
        << with_duplicates << ',' << niche_runs << "\narchive_runs_with_other," << with_others << ','
        << niche_runs << '\n';
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

// The thesis's battery and fixture in the static pose: robustness over seeded runs.
//
//   battery_benchmark [--runs 1000] [--niche-runs 500] [--exchange-probability 0.8]
//                     [--output doc/results/battery.csv]
//
// First block: comb-GA-wl with N_pop 80 (Table 5.2): runs whose best node pair is the enumeration's optimum;
// operators as in the thesis, without immigrants and exchange of genes.
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

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/statistics.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/niches/niche_properties.h"
#include "loading/query_poses.h"
#include "search/automatic_radii.h"
#include "search/grid/body_grid.h"
#include "search/local_descent.h"
#include "support/enumeration.h"
#include "thesis/benchmark/support/reference_niches.h"
#include "thesis/src/genetic/comb_ga.h"
#include "thesis/src/genetic/niche_identification.h"
#include "thesis/src/grid/grid_nodes.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kThesisGrid = 0.05;
constexpr double kThesisNicheRadius = 0.6;
constexpr double kLeastProminence = 1e-2;

// A niche identified in a final population that is no reference, or is a reference met before.
struct ExtraNiche {
  TrialPoint best;
  double distance;  // refined, metres
  enum class Kind { Duplicate, ThroughMaterial, Other } kind;
};

struct NicheRun {
  std::size_t population_niches = 0;
  std::vector<ExtraNiche> extras;
  RecallCount population;
  RecallCount archive;
};

BenchmarkPair onThesisGrid(const std::string& name) {
  BenchmarkPair pair = loadBenchmarkPair(name, kThesisGrid);
  for (const auto& body : {pair.a, pair.b}) {
    SearchNodes nodes = makeGridNodes(body->surface(), body->options(), body->name());
    body->attach(std::make_unique<BodyGrid>(*body, std::move(nodes)));
  }
  return pair;
}

CombGaParameters combGaWl() {
  CombGaParameters parameters;  // Table 5.2
  parameters.exchange_probability = 0.0;
  parameters.random_immigrants = 0;
  parameters.population_size = 80;
  parameters.mutation_probability = 1.0 / 80.0;
  parameters.max_generations = 100;
  parameters.scheme = NichingScheme::None;
  parameters.mating_restriction = false;
  return parameters;
}

CombGaParameters combGaWlSh(bool conserve_niches, double exchange_probability) {
  CombGaParameters parameters;  // Tables 4.1 and 5.8 with N_pop 100; radii automatic
  parameters.conserve_niches = conserve_niches;
  parameters.exchange_probability = exchange_probability;
  parameters.population_size = 100;
  parameters.max_generations = 50;
  return parameters;
}

std::vector<WitnessPair> refinePopulation(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                                          const std::vector<IdentifiedNiche>& niches,
                                          const std::vector<ReferenceNiche>& references,
                                          std::vector<ExtraNiche>& extras) {
  RefinementWorkspace workspace;
  std::vector<WitnessPair> witnesses;
  std::vector<bool> met(references.size(), false);
  for (const IdentifiedNiche& niche : niches) {
    const WitnessPair witness =
        refineWitness(*pair.a, *pair.b, pose, gridOf(*pair.a).nodes().originalTriangle(niche.best.node_a),
                      gridOf(*pair.b).nodes().originalTriangle(niche.best.node_b), workspace)
            .witness;
    const double distance = std::sqrt(witness.squared_distance);
    if (classifyOutwardness(*pair.a, *pair.b, pose, witness) == Outwardness::ThroughMaterial) {
      extras.push_back({niche.best, distance, ExtraNiche::Kind::ThroughMaterial});
      continue;
    }
    witnesses.push_back(witness);
    std::size_t i = 0;
    while (i < references.size() &&
           !isSameNiche(pair, pose, witness, references[i].witness, kLeastProminence)) {
      ++i;
    }
    if (i == references.size()) {
      extras.push_back({niche.best, distance, ExtraNiche::Kind::Other});
    } else if (met[i]) {
      extras.push_back({niche.best, distance, ExtraNiche::Kind::Duplicate});
    } else {
      met[i] = true;
    }
  }
  return witnesses;
}

NicheRun nicheRun(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                  const std::vector<ReferenceNiche>& references, double cutoff, std::uint64_t seed,
                  bool conserve_niches, double exchange_probability) {
  NicheRun run;
  const CombGaParameters parameters = combGaWlSh(conserve_niches, exchange_probability);
  const PairObjective objective(*pair.a, *pair.b, pose);
  SearchWorkspace workspace(*pair.a, *pair.b);
  RandomEngine engine(streamSeed(seed, "battery_benchmark", 0));
  const NicheRadii radii = automaticRadii(*pair.a, *pair.b, parameters);
  combGa(objective, parameters, radii, {}, engine, workspace);
  std::vector<IdentifiedNiche> niches;
  std::vector<std::uint32_t> order;
  identifyNiches(workspace.population, kThesisNicheRadius, workspace.metric, niches, order);
  run.population_niches = niches.size();
  run.population = countRecall(pair, pose, refinePopulation(pair, pose, niches, references, run.extras),
                               references, cutoff, kLeastProminence);

  TrackerParameters tracking;
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

// Instants of the 20 s manoeuvre at which level `nodes` gives the enumeration's optimum (thesis: 197 of 200).
struct Manoeuvre {
  int instants = 0;
  int optimal = 0;
  double worst_excess = 0.0;  // metres
};

Manoeuvre runManoeuvre() {
  const BenchmarkPair pair = onThesisGrid("battery_insertion");
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Nodes;
  PairTracker tracker(pair.name, pair.a, pair.b, parameters);
  PairSolution solution;
  Manoeuvre manoeuvre;
  for (const TimedPose& instant :
       readPosePath(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/meshes/thesis/manoeuvre_200.csv")) {
    tracker.update(instant.pose, instant.time, solution);
    const double optimum =
        std::sqrt(test::enumerateNodePairs(*pair.a, *pair.b, instant.pose).squared_distance);
    const double excess = solution.distance - optimum;
    ++manoeuvre.instants;
    manoeuvre.optimal += excess <= 1e-12 ? 1 : 0;
    manoeuvre.worst_excess = std::max(manoeuvre.worst_excess, excess);
  }
  return manoeuvre;
}

// Where the identified niches of the final populations beyond the references stand, and how prominent they
// are on the grid.
void reportExtras(const std::vector<NicheRun>& runs, const std::vector<test::NodeNiche>& grid_minima) {
  struct Place {
    ExtraNiche niche;
    std::size_t runs;
  };
  std::vector<Place> places;
  for (const NicheRun& run : runs) {
    for (const ExtraNiche& extra : run.extras) {
      const auto known = std::find_if(places.begin(), places.end(), [&](const Place& place) {
        return samePlace(place.niche.best, extra.best) && place.niche.kind == extra.kind;
      });
      if (known != places.end()) {
        ++known->runs;
      } else {
        places.push_back({extra, 1});
      }
    }
  }
  std::sort(places.begin(), places.end(), [](const Place& l, const Place& r) { return l.runs > r.runs; });
  for (const Place& place : places) {
    constexpr const char* kNames[] = {"a reference's basin again", "through material", "no reference"};
    const auto minimum = std::find_if(grid_minima.begin(), grid_minima.end(), [&](const test::NodeNiche& m) {
      return m.node_a == place.niche.best.node_a && m.node_b == place.niche.best.node_b;
    });
    std::printf("    extra in %zu runs: nodes %.4f, exact %.4f, %s, prominence on the grid %s\n", place.runs,
                std::sqrt(place.niche.best.squared_distance), place.niche.distance,
                kNames[static_cast<int>(place.niche.kind)],
                minimum == grid_minima.end() ? "0 (plateau)" : std::to_string(minimum->prominence).c_str());
  }
}

void reportNicheRuns(const std::vector<NicheRun>& niche_runs, std::size_t references, const char* variant,
                     const std::vector<test::NodeNiche>& grid_minima, std::ofstream& csv) {
  std::uint32_t population_all = 0;
  std::uint32_t archive_all = 0;
  std::uint32_t with_duplicates = 0;
  std::uint32_t with_others = 0;
  std::vector<double> counts;
  std::vector<double> recalled;
  for (const NicheRun& run : niche_runs) {
    counts.push_back(static_cast<double>(run.population_niches));
    recalled.push_back(static_cast<double>(run.population.recalled));
    population_all += run.population.recalled == references ? 1U : 0U;
    archive_all += run.archive.recalled == references ? 1U : 0U;
    with_duplicates += run.archive.duplicates > 0 ? 1U : 0U;
    with_others += run.archive.others > 0 ? 1U : 0U;
  }
  const std::size_t runs = niche_runs.size();
  std::printf("comb-GA-wl-sh N_pop 100, %s, %zu runs\n", variant, runs);
  std::printf("  final population: N_Gamma %.2f [%.0f-%.0f]; references met %.2f mean; all in %u runs\n",
              mean(counts), percentile(counts, 0.0), percentile(counts, 1.0), mean(recalled), population_all);
  reportExtras(niche_runs, grid_minima);
  std::printf("  archive: all references in %u runs; runs with a duplicate %u; with another niche %u\n",
              archive_all, with_duplicates, with_others);
  if (csv) {
    csv << variant << "_population_niches_mean," << mean(counts) << ",\n"
        << variant << "_population_niches_least," << percentile(counts, 0.0) << ",\n"
        << variant << "_population_niches_most," << percentile(counts, 1.0) << ",\n"
        << variant << "_population_references_mean," << mean(recalled) << ',' << references << '\n'
        << variant << "_population_all_references," << population_all << ',' << runs << '\n'
        << variant << "_archive_all_references," << archive_all << ',' << runs << '\n'
        << variant << "_archive_runs_with_duplicate," << with_duplicates << ',' << runs << '\n'
        << variant << "_archive_runs_with_other," << with_others << ',' << runs << '\n';
  }
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Robustness on the battery and fixture");
  std::uint32_t runs = 1000;
  std::uint32_t niche_runs = 500;
  double exchange_probability = GeneticParameters{}.exchange_probability;
  std::string output;
  app.add_option("--exchange-probability", exchange_probability, "Of comb-GA-wl-sh");
  app.add_option("--runs", runs, "Runs of comb-GA-wl");
  app.add_option("--niche-runs", niche_runs, "Runs of comb-GA-wl-sh");
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  const BenchmarkPair pair = onThesisGrid("battery_fixture");
  const Eigen::Isometry3d pose = pair.motion(0.0);
  const double cutoff = pair.b->diameter();
  const TrialPoint optimum = test::enumerateNodePairs(*pair.a, *pair.b, pose);
  std::printf("fixture %zu nodes, battery %zu nodes, enumeration %.6f\n", gridOf(*pair.a).graph().nodeCount(),
              gridOf(*pair.b).graph().nodeCount(), std::sqrt(optimum.squared_distance));

  std::vector<char> optimal(runs, 0);
  std::vector<double> generations(runs, 0.0);
  tbb::parallel_for(std::uint32_t{0}, runs, [&](std::uint32_t run) {
    const PairObjective objective(*pair.a, *pair.b, pose);
    SearchWorkspace workspace(*pair.a, *pair.b);
    RandomEngine engine(streamSeed(run, "battery_benchmark", 1));
    const CombGaParameters parameters = combGaWl();
    const GeneticResult result =
        combGa(objective, parameters, automaticRadii(*pair.a, *pair.b, parameters), {}, engine, workspace);
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
  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    csv << "quantity,value,of\ncomb_ga_wl_optimum," << successes << ',' << runs << "\nreferences,"
        << references.size() << ",\n";
  }
  const std::vector<test::NodeNiche> grid_minima =
      test::enumerateNodeNiches(*pair.a, *pair.b, pose, 1.2 * cutoff, 0.0);
  for (const bool conserve : {false, true}) {
    std::vector<NicheRun> niche(niche_runs);
    tbb::parallel_for(std::uint32_t{0}, niche_runs, [&](std::uint32_t run) {
      niche[run] = nicheRun(pair, pose, references, cutoff, run, conserve, exchange_probability);
    });
    reportNicheRuns(niche, references.size(), conserve ? "conserved" : "plain", grid_minima, csv);
  }
  const Manoeuvre manoeuvre = runManoeuvre();
  std::printf("manoeuvre, level nodes: the enumeration's optimum at %d of %d instants, worst excess %.3g\n",
              manoeuvre.optimal, manoeuvre.instants, manoeuvre.worst_excess);
  if (csv) {
    csv << "manoeuvre_nodes_optimum," << manoeuvre.optimal << ',' << manoeuvre.instants << '\n';
  }
  return 0;
}

}  // namespace concave_distance::benchmark

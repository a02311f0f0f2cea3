#include "benchmark/support/search_trial.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "search/automatic_radii.h"
#include "search/genetic_search.h"
#include "support/enumeration.h"

namespace concave_distance::benchmark {
namespace {

std::vector<WitnessPair> refineAll(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                                   std::vector<TrialPoint> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end(),
                           [](const TrialPoint& l, const TrialPoint& r) { return samePlace(l, r); }),
               points.end());
  RefinementWorkspace workspace;
  std::vector<WitnessPair> witnesses;
  for (const TrialPoint& point : points) {
    witnesses.push_back(refineWitness(*pair.a, *pair.b, pose, pair.a->originalTriangle(point.node_a),
                                      pair.b->originalTriangle(point.node_b), workspace)
                            .witness);
  }
  return witnesses;
}

}  // namespace

double truthCutoff(const BenchmarkPair& pair, const Eigen::Isometry3d& pose) {
  const double nearest = std::sqrt(test::enumerateNodePairs(*pair.a, *pair.b, pose).squared_distance);
  return std::max(5.0 * nearest, 0.25 * std::min(pair.a->diameter(), pair.b->diameter()));
}

std::vector<SearchScene> searchScenes(const BenchmarkPair& pair, std::size_t count, double least_prominence) {
  std::vector<SearchScene> scenes;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Isometry3d pose = pair.motion((static_cast<double>(k) + 0.5) / static_cast<double>(count));
    std::vector<ReferenceNiche> references =
        referenceNiches(pair, pose, truthCutoff(pair, pose), least_prominence);
    if (!references.empty()) {
      scenes.push_back({pose, std::move(references)});
    }
  }
  return scenes;
}

SearchOutcome trySearch(const BenchmarkPair& pair, const SearchScene& scene, const SearchMethod& method,
                        double sharing_scale, std::uint64_t seed, double least_prominence) {
  const PairObjective objective(*pair.a, *pair.b, scene.pose);
  SearchWorkspace workspace(*pair.a, *pair.b);
  RandomEngine engine(streamSeed(seed, method.name, 0));
  NicheRadii radii = automaticRadii(*pair.a, *pair.b, method.parameters);
  radii.sharing *= sharing_scale;
  radii.mating *= sharing_scale;
  radii.niche *= sharing_scale;
  const auto start = std::chrono::steady_clock::now();
  const GeneticResult result = geneticSearch(objective, method.parameters, radii, {}, engine, workspace);
  SearchOutcome outcome;
  outcome.microseconds =
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  outcome.evaluations = static_cast<double>(result.cost.evaluations);
  const auto recalled = [&](const std::vector<WitnessPair>& found,
                            const std::vector<ReferenceNiche>& references) {
    return static_cast<double>(countRecalled(pair, scene.pose, found, references, least_prominence)) /
           static_cast<double>(references.size());
  };
  const std::vector<WitnessPair> archive = refineAll(pair, scene.pose, workspace.basins.minima());
  outcome.archive_recall = recalled(archive, scene.references);
  outcome.nearest = recalled(archive, {scene.references.front()});
  outcome.population_recall = recalled(refineAll(pair, scene.pose, workspace.population), scene.references);
  return outcome;
}

SearchOutcome trySearches(const BenchmarkPair& pair, const std::vector<SearchScene>& scenes,
                          const SearchMethod& method, double sharing_scale, std::uint64_t seeds,
                          double least_prominence) {
  std::vector<SearchOutcome> outcomes(scenes.size() * seeds);
  tbb::parallel_for(std::size_t{0}, outcomes.size(), [&](std::size_t run) {
    outcomes[run] = trySearch(pair, scenes[run % scenes.size()], method, sharing_scale, run / scenes.size(),
                              least_prominence);
  });
  SearchOutcome sum;
  for (const SearchOutcome& outcome : outcomes) {
    const auto n = static_cast<double>(outcomes.size());
    sum.archive_recall += outcome.archive_recall / n;
    sum.population_recall += outcome.population_recall / n;
    sum.nearest += outcome.nearest / n;
    sum.microseconds += outcome.microseconds / n;
    sum.evaluations += outcome.evaluations / n;
  }
  return sum;
}

}  // namespace concave_distance::benchmark

#include "thesis/benchmark/support/manoeuvre_methods.h"

#include <cmath>

#include "benchmark/support/fcl_distance.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "search/grid/body_grid.h"
#include "search/grid/node_graph.h"
#include "thesis/src/evaluation/inheriting_search.h"
#include "thesis/src/evaluation/row_bases.h"
#include "thesis/src/grid/grid_nodes.h"
#include "thesis/src/partition/hybrid_distance.h"
#include "thesis/src/partition/partition_tracker.h"

namespace concave_distance::benchmark {
namespace {

using Partition = std::shared_ptr<const ConvexPartition>;

/// Carretero counts 26 operations for the distance of a node pair (sec. 5.2).
constexpr double kFlopsPerNodePair = 26.0;

MethodStep stepOf(const PartitionSolution& solution, double time_us) {
  MethodStep step;
  step.distance = solution.distance;
  step.time_us = time_us;
  step.flops = solution.flops;
  step.sub_pairs = solution.sub_pairs;
  step.iterations = static_cast<double>(solution.iterations);
  step.most_iterations = solution.most_iterations;
  step.finished = solution.finished;
  return step;
}

Method partitionMethod(const std::string& name, const std::string& partition, const Partition& a,
                       const Partition& b, const PartitionTrackerOptions& options) {
  auto tracker = std::make_shared<PartitionTracker>(a, b, options);
  return {name, partition, [tracker](const Eigen::Isometry3d& pose, double) {
            const double start = processorMicroseconds();
            const PartitionSolution solution = tracker->update(pose);
            return stepOf(solution, processorMicroseconds() - start);
          }};
}

TrackerParameters parametersOf(AccuracyLevel level, bool niches_wanted) {
  TrackerParameters parameters;
  parameters.accuracy = level;
  parameters.niches_wanted = niches_wanted;
  return parameters;
}

/// Carretero, Table 6.1: the same search in every step.
CombGaParameters tableParameters() {
  CombGaParameters search = evaluation::thesisGeneticParameters(NichingScheme::Sharing);
  search.population_size = 100;
  search.max_generations = 20;
  search.mutation_probability = 0.01;
  search.crossover_probability = 0.6;
  search.sharing_radius = search.mating_radius = search.niche_radius = 0.6;
  search.sharing_exponent = 1.0;
  search.descend_first_population = true;  // sec. 6.2.2
  return search;
}

/// comb-GA-wl-sh of the thesis with the parameters of Table 6.1 and nothing else.
Method searchMethod(const std::string& name, const PartitionedPair& pair) {
  auto workspace = std::make_shared<SearchWorkspace>(*pair.a, *pair.b);
  auto search = std::make_shared<evaluation::InheritingSearch>(
      tableParameters(), tableParameters(), evaluation::thesisFirstGuess(), *pair.a, *pair.b, 1, *workspace);
  return {name, "none", [workspace, search](const Eigen::Isometry3d& pose, double) {
            const double start = processorMicroseconds();
            const GeneticResult result = search->search(pose);
            MethodStep step;
            step.time_us = processorMicroseconds() - start;
            step.distance = std::sqrt(result.best.squared_distance);
            step.niches = search->niches().size();
            step.flops = kFlopsPerNodePair * static_cast<double>(result.cost.evaluations);
            return step;
          }};
}

Method trackerMethod(const std::string& name, const PartitionedPair& pair,
                     const TrackerParameters& parameters) {
  auto tracker = std::make_shared<PairTracker>(pair.name, pair.a, pair.b, parameters);
  auto solution = std::make_shared<PairSolution>();
  return {name, "none", [tracker, solution](const Eigen::Isometry3d& pose, double time) {
            const double start = processorMicroseconds();
            tracker->update(pose, time, *solution);
            MethodStep step;
            step.time_us = processorMicroseconds() - start;
            step.distance = solution->distance;
            step.niches = solution->niches.size();
            step.flops = kFlopsPerNodePair * static_cast<double>(solution->cost.evaluations);
            return step;
          }};
}

/// The search at `nodes` selects the sub-pairs, the quadratic program finishes them.
Method hybridMethod(const std::string& name, const std::string& partition, const PartitionedPair& pair,
                    const Partition& a, const Partition& b, bool prove) {
  auto search =
      std::make_shared<PairTracker>(pair.name, pair.a, pair.b, parametersOf(AccuracyLevel::Nodes, true));
  auto solution = std::make_shared<PairSolution>();
  HybridOptions options;
  options.prove = prove;
  auto hybrid = std::make_shared<HybridDistance>(a, b, options);
  auto places = std::make_shared<std::vector<PlacePair>>();
  auto bodies = std::make_pair(pair.a, pair.b);
  return {name, partition, [=](const Eigen::Isometry3d& pose, double time) {
            const double start = processorMicroseconds();
            search->update(pose, time, *solution);
            places->clear();
            for (const TrackedNiche& niche : solution->niches) {
              places->push_back({gridOf(*bodies.first).graph().positions[niche.node_pair.node_a.value],
                                 gridOf(*bodies.second).graph().positions[niche.node_pair.node_b.value]});
            }
            const PartitionSolution finished = hybrid->update(pose, *places);
            MethodStep step = stepOf(finished, processorMicroseconds() - start);
            step.flops += kFlopsPerNodePair * static_cast<double>(solution->cost.evaluations);
            return step;
          }};
}

void addPartitionMethods(const PartitionedPair& pair, const std::string& partition, const Partition& a,
                         const Partition& b, bool cold, std::vector<Method>& methods) {
  PartitionTrackerOptions options;
  options.warm_start = false;
  if (cold) methods.push_back(partitionMethod("QP, cold", partition, a, b, options));
  options.warm_start = true;
  methods.push_back(partitionMethod("QP, warm", partition, a, b, options));
  options.cull = true;
  methods.push_back(partitionMethod("QP, warm, culled", partition, a, b, options));
  options.cull = false;
  options.solver = PieceSolver::Gjk;
  methods.push_back(partitionMethod("GJK", partition, a, b, options));
  options.cull = true;
  methods.push_back(partitionMethod("GJK, culled", partition, a, b, options));
  methods.push_back(hybridMethod("hybrid: nodes + QP", partition, pair, a, b, true));
  methods.push_back(hybridMethod("hybrid, places alone", partition, pair, a, b, false));
}

Method fclMethod(const PartitionedPair& pair) {
  auto a = makeFclModel(pair.a->surface());
  auto b = makeFclModel(pair.b->surface());
  return {"FCL, meshes", "none", [a, b](const Eigen::Isometry3d& pose, double) {
            const double start = processorMicroseconds();
            MethodStep step;
            step.distance = fclDistance(*a, *b, pose).distance;
            step.time_us = processorMicroseconds() - start;
            return step;
          }};
}

}  // namespace

std::vector<Method> manoeuvreMethods(const PartitionedPair& pair, bool cold) {
  std::vector<Method> methods;
  addPartitionMethods(pair, "hand", pair.hand_a, pair.hand_b, cold, methods);
  if (pair.automatic_a) {
    addPartitionMethods(pair, "automatic", pair.automatic_a, pair.automatic_b, cold, methods);
  }
  methods.push_back(trackerMethod("nodes", pair, parametersOf(AccuracyLevel::Nodes, true)));
  methods.push_back(searchMethod("comb-GA-wl-sh, Table 6.1", pair));
  methods.push_back(trackerMethod("refined", pair, parametersOf(AccuracyLevel::Refined, true)));
  methods.push_back(trackerMethod("certified", pair, parametersOf(AccuracyLevel::Certified, true)));
  methods.push_back(
      trackerMethod("certified, distance only", pair, parametersOf(AccuracyLevel::Certified, false)));
  methods.push_back(fclMethod(pair));
  return methods;
}

std::shared_ptr<const BodyMesh> loadBody(const std::string& folder, const std::string& name,
                                         double max_edge_length) {
  const std::string path = folder + "/" + name + ".stl";
  BodyMeshOptions options;
  options.max_edge_length = max_edge_length;
  auto body = std::make_shared<const BodyMesh>(name, repairMesh(importMesh(path), {}, path).mesh, options);
  body->attach(std::make_unique<BodyGrid>(*body, makeGridNodes(body->surface(), options, name)));
  return body;
}

}  // namespace concave_distance::benchmark

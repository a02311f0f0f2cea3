#include "thesis/src/annealing/simulated_annealing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "concave_distance/base/error.h"
#include "search/search_scenes.h"
#include "thesis/src/evaluation/enumeration.h"
#include "thesis/src/evaluation/search_method.h"

namespace concave_distance::simulated_annealing_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Annealing {
  test::PairScene scene;
  PairObjective objective;
  SearchWorkspace workspace;
  explicit Annealing(test::PairScene made)
      : scene(std::move(made)),
        objective(*scene.a, *scene.b, scene.a_from_b),
        workspace(*scene.a, *scene.b) {}

  AnnealingResult run(const AnnealingParameters& parameters, std::uint64_t seed,
                      const AnnealingObserver& observer = {}) {
    workspace.basins.clear();
    RandomEngine engine(seed);
    return simulatedAnnealing(objective, parameters, engine, workspace, observer);
  }

  /// Longest way that a gene went in one accepted move.
  double longestMove(const AnnealingParameters& parameters, std::uint64_t seed) {
    double longest = 0.0;
    TrialPoint last;
    run(parameters, seed, [&](const AnnealingRecord& record) {
      if (record.iteration > 0) {
        longest = std::max({longest, workspace.metric.onA().distance(last.node_a, record.current->node_a),
                            workspace.metric.onB().distance(last.node_b, record.current->node_b)});
      }
      last = *record.current;
    });
    return longest;
  }
};

AnnealingParameters shortRun(bool local) {
  AnnealingParameters parameters;
  parameters.initial_temperature = 300;
  parameters.boltzmann_constant = 1e-4;
  parameters.local_optimization = local;
  return parameters;
}

TEST(SimulatedAnnealing, AcceptsByBoltzmannsFactor) {
  EXPECT_DOUBLE_EQ(acceptanceProbability(1.0, 1.5, 0.01, 100.0), std::exp(-0.5));  // eq. (2.6)
  EXPECT_EQ(acceptanceProbability(1.5, 1.0, 0.01, 100.0), 1.0);                    // not exp(0.5)
  EXPECT_EQ(acceptanceProbability(1.0, 1.0, 0.0, 100.0), 1.0);
  EXPECT_EQ(acceptanceProbability(1.0, 1.5, 0.0, 100.0), 0.0);
}

TEST(SimulatedAnnealing, FindsTheEnumeratedOptimumWithLocalOptimization) {
  Annealing annealing(test::facingCombs());
  const TrialPoint optimum =
      enumerateNodePairs(*annealing.scene.a, *annealing.scene.b, annealing.scene.a_from_b);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    AnnealingParameters parameters = shortRun(true);
    parameters.boltzmann_constant = 0.01;  // Table 5.5
    const AnnealingResult result = annealing.run(parameters, seed);
    EXPECT_EQ(result.best.squared_distance, optimum.squared_distance) << seed;
    EXPECT_EQ(result.iterations, 300U);
    EXPECT_EQ(result.cost.descents, 301U);
  }
}

TEST(SimulatedAnnealing, OneSeedGivesOneAnswerWhateverRanBefore) {
  Annealing fresh(test::hookAndStairs());
  Annealing used(test::hookAndStairs());
  for (const bool local : {true, false}) {
    used.run(shortRun(local), 1234);
    const AnnealingResult first = used.run(shortRun(local), 7);
    const AnnealingResult second = fresh.run(shortRun(local), 7);
    EXPECT_TRUE(samePlace(first.best, second.best));
    EXPECT_EQ(first.best_iteration, second.best_iteration);
    EXPECT_EQ(first.cost.evaluations, second.cost.evaluations);
  }
}

TEST(SimulatedAnnealing, KeepsTheBestAndNamesTheIterationInWhichItAppeared) {
  Annealing annealing(test::hookAndStairs());
  for (const AnnealingMove move : {AnnealingMove::NewPoint, AnnealingMove::RandomMove}) {
    AnnealingParameters parameters = shortRun(false);
    parameters.move = move;
    std::vector<double> best;
    const AnnealingResult result = annealing.run(parameters, 5, [&](const AnnealingRecord& record) {
      EXPECT_EQ(record.iteration, best.size());
      EXPECT_LE(record.best_so_far->squared_distance, record.current->squared_distance);
      EXPECT_EQ(record.current->squared_distance,
                annealing.objective.squaredDistance(record.current->node_a, record.current->node_b));
      EXPECT_LE(record.best_so_far->squared_distance, best.empty() ? kInfinity : best.back());
      best.push_back(record.best_so_far->squared_distance);
    });
    ASSERT_EQ(best.size(), 301U);
    const auto first = std::find(best.begin(), best.end(), result.best.squared_distance);
    EXPECT_EQ(result.best_iteration, static_cast<std::uint32_t>(first - best.begin()));
  }
}

TEST(SimulatedAnnealing, WithoutHeatNothingWorseIsAccepted) {
  Annealing annealing(test::hookAndStairs());
  AnnealingParameters parameters = shortRun(false);
  parameters.variable_displacement = false;
  const auto worsenings = [&](double boltzmann_constant) {
    parameters.boltzmann_constant = boltzmann_constant;
    int count = 0;
    double last = kInfinity;
    annealing.run(parameters, 11, [&](const AnnealingRecord& record) {
      count += record.current->squared_distance > last ? 1 : 0;
      last = record.current->squared_distance;
    });
    return count;
  };
  EXPECT_EQ(worsenings(0.0), 0);
  EXPECT_GT(worsenings(1.0), 50);
}

TEST(SimulatedAnnealing, MovesNoFartherThanTheRadius) {
  Annealing annealing(test::facingCombs());
  AnnealingParameters parameters = shortRun(false);
  parameters.boltzmann_constant = 1.0;  // accepts nearly everything
  parameters.new_point_probability = 0.0;
  parameters.variable_displacement = false;
  EXPECT_GT(annealing.longestMove(parameters, 3), 1.0);
  parameters.move_radius = 0.25;
  EXPECT_LE(annealing.longestMove(parameters, 3), 0.25 + 1e-6);
  EXPECT_GT(annealing.longestMove(parameters, 3), 0.1);
}

TEST(SimulatedAnnealing, VariableDisplacementsShrinkWithTheAcceptanceProbability) {
  Annealing annealing(test::facingCombs());
  AnnealingParameters parameters = shortRun(false);
  parameters.boltzmann_constant = 1e-3;
  parameters.new_point_probability = 0.0;
  parameters.move_radius = 1.0;
  TrialPoint last;
  double probability = 1.0;
  int moved = 0;
  annealing.run(parameters, 4, [&](const AnnealingRecord& record) {
    if (record.iteration > 0) {
      const double displacement =
          annealing.workspace.metric.onA().distance(last.node_a, record.current->node_a);
      EXPECT_LE(displacement, probability * 1.0 + 1e-6);
      moved += displacement > 0.0 ? 1 : 0;
    }
    last = *record.current;
    probability = record.acceptance_probability;
  });
  EXPECT_GT(moved, 20);
}

TEST(SimulatedAnnealing, WorksOnUnconnectedShells) {
  Annealing annealing(test::shellsAndShells());
  for (const bool local : {true, false}) {
    const AnnealingResult result = annealing.run(shortRun(local), 3);
    EXPECT_EQ(result.best.squared_distance,
              annealing.objective.squaredDistance(result.best.node_a, result.best.node_b));
  }
}

TEST(SimulatedAnnealing, EndsAtTheLimitOfEvaluations) {
  Annealing annealing(test::facingCombs());
  AnnealingParameters parameters = shortRun(false);
  parameters.evaluation_limit = 50;
  EXPECT_EQ(annealing.run(parameters, 3).cost.evaluations, 50U);
}

TEST(AnnealingParameters, AreRefusedByName) {
  const auto expect_refused = [](const AnnealingParameters& parameters, const std::string& name) {
    try {
      parameters.validate("pair ab");
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("pair ab"), std::string::npos) << error.what();
    }
  };
  EXPECT_NO_THROW(AnnealingParameters{}.validate("defaults"));
  AnnealingParameters parameters;
  parameters.initial_temperature = 0;
  expect_refused(parameters, "initial_temperature");
  parameters = {};
  parameters.boltzmann_constant = std::numeric_limits<double>::quiet_NaN();
  expect_refused(parameters, "boltzmann_constant");
  parameters = {};
  parameters.move_radius = -1.0;
  expect_refused(parameters, "move_radius");
  parameters = {};
  parameters.new_point_probability = 1.5;
  expect_refused(parameters, "new_point_probability");
}

TEST(SearchMethod, RunsEachMethodAsItsOwnFunctionDoes) {
  Annealing a(test::facingCombs());
  const NicheRadii radii{0.3, 0.4, 0.3};
  CombGaParameters genetic;
  genetic.population_size = 20;
  genetic.max_generations = 5;
  const auto outcome = [&](const SearchMethod& method) {
    a.workspace.basins.clear();
    RandomEngine engine(5);
    std::uint32_t records = 0;
    const SearchOutcome result =
        searchPair(a.objective, method, radii, engine, a.workspace, [&](const SearchRecord& record) {
          EXPECT_EQ(record.iteration, records++);
          EXPECT_LE(record.best_so_far->squared_distance,
                    std::min_element(record.points, record.points + record.point_count)->squared_distance);
        });
    EXPECT_EQ(records, std::holds_alternative<MultiStartParameters>(method) ? 0 : result.iterations + 1);
    return result;
  };
  const SearchOutcome by_genetic = outcome(genetic);
  a.workspace.basins.clear();
  RandomEngine engine(5);
  const GeneticResult expected = combGa(a.objective, genetic, radii, {}, engine, a.workspace);
  EXPECT_TRUE(samePlace(by_genetic.best, expected.best));
  EXPECT_EQ(by_genetic.cost.evaluations, expected.cost.evaluations);
  EXPECT_EQ(by_genetic.best_iteration, expected.best_generation);

  EXPECT_EQ(outcome(shortRun(true)).best.squared_distance, a.run(shortRun(true), 5).best.squared_distance);
  EXPECT_EQ(a.workspace.population.size(), 1U);
  EXPECT_EQ(outcome(MultiStartParameters{50, 0}).cost.descents, 50U);
}

TEST(SearchMethod, NamesThemAsTheThesisDoes) {
  CombGaParameters genetic;
  EXPECT_EQ(nameOf(SearchMethod(genetic)), "comb-GA-wl-sh");
  genetic.scheme = NichingScheme::None;
  genetic.local_optimization = LocalOptimization::None;
  EXPECT_EQ(nameOf(SearchMethod(genetic)), "comb-GA-nl");
  genetic.scheme = NichingScheme::DeterministicCrowdingWithSelection;
  genetic.local_optimization = LocalOptimization::Baldwinian;
  EXPECT_EQ(nameOf(SearchMethod(genetic)), "comb-GA-bw-dcs");
  EXPECT_EQ(nameOf(SearchMethod(shortRun(true))), "comb-SA-wl");
  EXPECT_EQ(nameOf(SearchMethod(shortRun(false))), "comb-SA-nl");
}

}  // namespace
}  // namespace concave_distance::simulated_annealing_test

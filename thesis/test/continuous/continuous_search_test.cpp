#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/base/error.h"
#include "thesis/src/continuous/continuous_annealing.h"
#include "thesis/src/continuous/continuous_genetic_search.h"
#include "thesis/test/continuous/tree_shapes.h"

namespace concave_distance::continuous_search_test {
namespace {

using test::boxTree;
using test::pitWithPost;

constexpr std::uint64_t kSeeds = 20;

/// A unit cube turned about z by an eighth, its edge 0.5 m beyond another cube's face.
struct EdgeBesideFace {
  ConstraintTree a = boxTree({0, 0, 0}, {1, 1, 1});
  ConstraintTree b = boxTree({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  double distance = 0.5;
  EdgeBesideFace() {
    a_from_b.linear() = Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    a_from_b.translation() = Eigen::Vector3d(1.5 + std::sqrt(0.5), 0.5, 0.5);
  }
};

template <typename Parameters>
ContinuousResult run(const EdgeBesideFace& s, const Parameters& parameters, std::uint64_t seed,
                     const ContinuousObserver& observer = {}) {
  RandomEngine engine(seed);
  if constexpr (std::is_same_v<Parameters, ContinuousGeneticParameters>) {
    return continuousGeneticSearch(s.a, s.b, s.a_from_b, parameters, engine, observer);
  } else {
    return continuousAnnealing(s.a, s.b, s.a_from_b, parameters, engine, observer);
  }
}

TEST(ContinuousGeneticSearch, FindsTheMinimumOfAConvexScene) {
  const EdgeBesideFace scene;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const ContinuousResult thesis = run(scene, thesisContinuousGenetic(), seed);
    EXPECT_LT(thesis.distance, 1.1 * scene.distance) << seed;  // the thesis's region of the minimum
    EXPECT_TRUE(!thesis.is_feasible || thesis.distance > scene.distance - 1e-9) << seed;
    const ContinuousResult improved = run(scene, improvedContinuousGenetic(), seed);
    EXPECT_TRUE(improved.is_feasible) << seed;
    EXPECT_NEAR(improved.distance, scene.distance, 1e-6) << seed;
  }
}

TEST(ContinuousAnnealing, FindsTheMinimumOfAConvexScene) {
  const EdgeBesideFace scene;
  int in_region = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    in_region += run(scene, thesisContinuousAnnealing(), seed).distance < 1.1 * scene.distance ? 1 : 0;
    const ContinuousResult improved = run(scene, improvedContinuousAnnealing(), seed);
    EXPECT_TRUE(improved.is_feasible) << seed;
    EXPECT_NEAR(improved.distance, scene.distance, 1e-3) << seed;
  }
  EXPECT_GE(in_region, static_cast<int>(kSeeds) / 2);
}

TEST(ContinuousSearches, FindTheBottomOfAPit) {
  // A slender rod hangs into the pit beside its post: 0.1 m above the floor, 0.15 m from walls and post.
  const ConstraintTree a = pitWithPost();
  const ConstraintTree b = boxTree({-0.1, -0.1, 0}, {0.1, 0.1, 3});
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  a_from_b.translation() = Eigen::Vector3d(1.25, 1.25, 1.1);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    RandomEngine engine(seed);
    const ContinuousResult result =
        continuousGeneticSearch(a, b, a_from_b, improvedContinuousGenetic(), engine);
    EXPECT_TRUE(result.is_feasible);
    EXPECT_NEAR(result.distance, 0.1, 1e-6) << seed;
  }
}

TEST(ContinuousSearches, OneSeedGivesOneAnswer) {
  const EdgeBesideFace scene;
  const auto check = [&](const auto& parameters) {
    const ContinuousResult first = run(scene, parameters, 7);
    const ContinuousResult second = run(scene, parameters, 7);
    EXPECT_EQ(first.best.point_a, second.best.point_a);
    EXPECT_EQ(first.best.point_b, second.best.point_b);
    EXPECT_EQ(first.best_generation, second.best_generation);
    EXPECT_EQ(first.cost.constraints, second.cost.constraints);
    EXPECT_NE(first.best.point_a, run(scene, parameters, 8).best.point_a);
  };
  check(thesisContinuousGenetic());
  check(improvedContinuousGenetic());
  check(thesisContinuousAnnealing());
}

TEST(ContinuousGeneticSearch, ShowsEveryGenerationOnceAndKeepsTheBest) {
  const EdgeBesideFace scene;
  ContinuousGeneticParameters parameters = thesisContinuousGenetic();
  parameters.population_size = 20;
  parameters.max_generations = 15;
  std::uint32_t generation = 0;
  std::uint32_t best_generation = 0;
  double best = std::numeric_limits<double>::infinity();
  double factor = 2.0;
  const ContinuousResult result = run(scene, parameters, 3, [&](const ContinuousRecord& record) {
    EXPECT_EQ(record.generation, generation++);
    EXPECT_EQ(record.population->size(), 20u);
    EXPECT_LT(record.boltzmann_factor, factor) << "displacements shrink";
    factor = record.boltzmann_factor;
    for (const ContinuousPoint& x : *record.population) {
      if (x.objective < best) {
        best = x.objective;
        best_generation = record.generation;
      }
    }
    EXPECT_EQ(record.best_so_far->objective, best);
  });
  EXPECT_EQ(generation, 16u);
  EXPECT_EQ(result.best.objective, best);
  EXPECT_EQ(result.best_generation, best_generation);
  EXPECT_EQ(result.generations, 15u);
}

TEST(ContinuousAnnealing, ShowsEveryIterationAndCountsItsEvaluations) {
  const EdgeBesideFace scene;
  ContinuousAnnealingParameters parameters = thesisContinuousAnnealing();
  parameters.initial_temperature = 200;
  parameters.local_step.enabled = false;
  std::uint32_t records = 0;
  const ContinuousResult result = run(scene, parameters, 3, [&](const ContinuousRecord& record) {
    EXPECT_EQ(record.generation, records++);
    EXPECT_LE(record.boltzmann_factor, 1.0);
  });
  EXPECT_EQ(records, 201u);
  EXPECT_EQ(result.cost.evaluations, 201u);
  EXPECT_EQ(result.cost.constraints, 201u * 12u);
  EXPECT_EQ(result.cost.flops(), 201u * (26u + 6u * 12u));
}

TEST(ContinuousGeneticSearch, WithoutLocalStepEvaluatesWhatChanges) {
  const EdgeBesideFace scene;
  ContinuousGeneticParameters parameters = thesisContinuousGenetic();
  parameters.local_step.enabled = false;
  parameters.crossover_probability = 1.0;
  const ContinuousResult result = run(scene, parameters, 3);
  EXPECT_EQ(result.cost.evaluations, 80u * 101u);
  EXPECT_EQ(result.cost.local_steps, 0u);
}

TEST(ContinuousGeneticSearch, EverySwitchRunsAndImproves) {
  const EdgeBesideFace scene;
  for (const SelectionMethod selection :
       {SelectionMethod::StochasticUniversalSampling, SelectionMethod::Roulette}) {
    for (const ContinuousMating mating :
         {ContinuousMating::LinearScaling, ContinuousMating::FitnessWeighted}) {
      for (const RandomMove mutation : {RandomMove::Cartesian, RandomMove::RandomDirection}) {
        for (const bool crowding : {false, true}) {
          ContinuousGeneticParameters p = improvedContinuousGenetic();
          p.population_size = 20;
          p.max_generations = 20;
          p.selection = selection;
          p.mating = mating;
          p.mutation = mutation;
          p.variable_displacement = crowding;
          p.deterministic_crowding = crowding;
          p.initial_points = crowding ? InitialPoints::Projected : InitialPoints::BoundingBoxes;
          p.random_immigrants = 2;
          double start = 0.0;
          const ContinuousResult result = run(scene, p, 5, [&](const ContinuousRecord& record) {
            if (record.generation == 0) start = record.best_so_far->objective;
          });
          EXPECT_LT(result.best.objective, start);
          EXPECT_NEAR(result.distance, scene.distance, 1e-3);
        }
      }
    }
  }
}

TEST(ContinuousParameters, SayWhatIsOutOfRange) {
  const auto refuses = [](const auto& base, auto&& change, const std::string& name) {
    auto parameters = base;
    change(parameters);
    try {
      parameters.validate("test");
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(error.whatIsWrong().find(name), std::string::npos) << error.what();
    }
  };
  using Genetic = ContinuousGeneticParameters;
  const Genetic genetic;
  EXPECT_NO_THROW(genetic.validate("test"));
  EXPECT_NO_THROW(improvedContinuousGenetic().validate("test"));
  refuses(
      genetic, [](Genetic& p) { p.population_size = 81; }, "population_size");
  refuses(
      genetic, [](Genetic& p) { p.max_generations = 0; }, "max_generations");
  refuses(
      genetic, [](Genetic& p) { p.crossover_probability = 1.5; }, "crossover_probability");
  refuses(
      genetic, [](Genetic& p) { p.mutation_probability = -0.1; }, "mutation_probability");
  refuses(
      genetic, [](Genetic& p) { p.penalty_weight = NAN; }, "penalty_weight");
  refuses(
      genetic, [](Genetic& p) { p.elite_count = 80; }, "elite_count");
  refuses(
      genetic, [](Genetic& p) { p.local_step.repair_scale = 0.0; }, "repair_scale");
  refuses(
      genetic, [](Genetic& p) { p.local_step.repeats = 0; }, "repeats");
  using Annealing = ContinuousAnnealingParameters;
  EXPECT_NO_THROW(improvedContinuousAnnealing().validate("test"));
  refuses(
      Annealing{}, [](Annealing& p) { p.initial_temperature = 0; }, "initial_temperature");
  refuses(
      Annealing{}, [](Annealing& p) { p.boltzmann_constant = 0.0; }, "boltzmann_constant");
}

}  // namespace
}  // namespace concave_distance::continuous_search_test

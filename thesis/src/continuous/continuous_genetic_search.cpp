#include "continuous_genetic_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "continuous_mating.h"
#include "local_step.h"
#include "random_moves.h"
#include "search/selection.h"
#include "search_steps.h"

namespace concave_distance {
namespace {

/// One run: the population and what its generations need.
class Run {
 public:
  Run(const ContinuousObjective& objective, const ContinuousGeneticParameters& parameters,
      RandomEngine& engine)
      : objective_(objective),
        parameters_(parameters),
        engine_(engine),
        // A point of f = 0 has a weight, too.
        least_objective_(1e-24 * std::max(objective.a().diameter() * objective.a().diameter(),
                                          objective.b().diameter() * objective.b().diameter())) {}

  void start() {
    for (std::uint32_t i = 0; i < parameters_.population_size; ++i) {
      population_.push_back(startingPoint(objective_, parameters_.initial_points, engine_, cost));
    }
  }

  void breed(double factor) {
    factor_ = factor;
    keepElites();
    if (parameters_.deterministic_crowding) {
      crowd();
    } else {
      select();
    }
    seatElites();
    seatImmigrants();
  }

  const std::vector<ContinuousPoint>& population() const { return population_; }
  ContinuousCost cost;

 private:
  static bool isBetter(const ContinuousPoint& l, const ContinuousPoint& r) {
    return l.objective < r.objective;
  }

  bool happens(double probability) { return uniformUnit(engine_) < probability; }

  /// Mutated and locally improved; a child that is its parent unchanged is not evaluated again.
  ContinuousPoint grown(ContinuousPoint x, PointPair place, bool is_new) {
    const double rate = parameters_.mutation_probability.value_or(1.0 / parameters_.population_size);
    if (happens(rate)) {
      place = moveRandomly(parameters_.mutation, place, objective_.a().boundingBox(),
                           objective_.b().boundingBox(), factor_, engine_);
      is_new = true;
    }
    if (is_new) {
      x = objective_.evaluate(place.point_a, place.point_b, cost);
    }
    if (parameters_.local_step.enabled) {
      improveLocally(objective_, parameters_.local_step, x, cost);
    }
    return x;
  }

  std::pair<ContinuousPoint, ContinuousPoint> children(const ContinuousPoint& mother,
                                                       const ContinuousPoint& father) {
    const bool mate = happens(parameters_.crossover_probability);
    std::pair<PointPair, PointPair> places{{mother.point_a, mother.point_b},
                                           {father.point_a, father.point_b}};
    if (mate) {
      places = mateContinuous(parameters_.mating, mother, father, engine_);
    }
    const ContinuousPoint first = grown(mother, places.first, mate);
    const ContinuousPoint second = grown(father, places.second, mate);
    return {first, second};
  }

  /// The thesis's generation: selection with replacement, shuffled couples, children replace all.
  void select() {
    weights_.clear();
    for (const ContinuousPoint& x : population_) {
      weights_.push_back(1.0 / (x.objective + least_objective_));
    }
    concave_distance::select(parameters_.selection, weights_, parameters_.population_size, engine_, wheel_,
                             selected_);
    shuffle(selected_, engine_);
    offspring_.clear();
    for (std::size_t i = 0; i + 1 < selected_.size(); i += 2) {
      const auto [first, second] = children(population_[selected_[i]], population_[selected_[i + 1]]);
      offspring_.push_back(first);
      offspring_.push_back(second);
    }
    std::swap(population_, offspring_);
  }

  /// Every individual mates once; the children compete with the nearer parents.
  void crowd() {
    selected_.resize(population_.size());
    std::iota(selected_.begin(), selected_.end(), 0U);
    shuffle(selected_, engine_);
    for (std::size_t i = 0; i + 1 < selected_.size(); i += 2) {
      ContinuousPoint& mother = population_[selected_[i]];
      ContinuousPoint& father = population_[selected_[i + 1]];
      auto [first, second] = children(mother, father);
      if (apart(mother, second) + apart(father, first) < apart(mother, first) + apart(father, second)) {
        std::swap(first, second);
      }
      if (!isBetter(mother, first)) mother = first;
      if (!isBetter(father, second)) father = second;
    }
  }

  static double apart(const ContinuousPoint& l, const ContinuousPoint& r) {
    return (l.point_a - r.point_a).norm() + (l.point_b - r.point_b).norm();
  }

  void keepElites() {
    elites_.resize(parameters_.elite_count);
    std::partial_sort_copy(population_.begin(), population_.end(), elites_.begin(), elites_.end(), isBetter);
  }

  /// Worst first, as far as `count` seats are given away.
  void sortSeats(std::uint32_t count) {
    selected_.resize(population_.size());
    std::iota(selected_.begin(), selected_.end(), 0U);
    std::partial_sort(selected_.begin(), selected_.begin() + count, selected_.end(),
                      [&](std::uint32_t l, std::uint32_t r) {
                        const double f_l = population_[l].objective;
                        const double f_r = population_[r].objective;
                        return f_l != f_r ? f_l > f_r : l < r;
                      });
  }

  void seatElites() {
    if (parameters_.deterministic_crowding) {
      return;  // whoever is best keeps its seat
    }
    sortSeats(parameters_.elite_count);
    for (std::uint32_t i = 0; i < parameters_.elite_count; ++i) {
      ContinuousPoint& seat = population_[selected_[i]];
      if (isBetter(elites_[i], seat)) seat = elites_[i];
    }
  }

  void seatImmigrants() {
    sortSeats(parameters_.random_immigrants);
    for (std::uint32_t i = 0; i < parameters_.random_immigrants; ++i) {
      ContinuousPoint stranger = startingPoint(objective_, parameters_.initial_points, engine_, cost);
      if (parameters_.local_step.enabled) {
        improveLocally(objective_, parameters_.local_step, stranger, cost);
      }
      population_[selected_[i]] = stranger;
    }
  }

  const ContinuousObjective& objective_;
  const ContinuousGeneticParameters& parameters_;
  RandomEngine& engine_;
  double least_objective_;
  double factor_ = 1.0;
  std::vector<ContinuousPoint> population_;
  std::vector<ContinuousPoint> offspring_;
  std::vector<ContinuousPoint> elites_;
  std::vector<double> weights_;
  std::vector<double> wheel_;
  std::vector<std::uint32_t> selected_;
};

}  // namespace

ContinuousResult continuousGeneticSearch(const ConstraintTree& a, const ConstraintTree& b,
                                         const Eigen::Isometry3d& a_from_b,
                                         const ContinuousGeneticParameters& parameters, RandomEngine& engine,
                                         const ContinuousObserver& observer) {
  const ContinuousObjective objective(a, b, a_from_b, parameters.penalty_weight);
  Run run(objective, parameters, engine);
  BestPoint best(parameters.prefer_feasible);
  run.start();
  double factor = 1.0;
  const auto report = [&](std::uint32_t generation) {
    for (const ContinuousPoint& x : run.population()) {
      best.offer(x, generation);
    }
    if (observer) {
      observer({generation, &run.population(), &best.point(), factor});
    }
  };
  report(0);
  for (std::uint32_t generation = 1; generation <= parameters.max_generations; ++generation) {
    constexpr double kDecay = 5.0;
    factor =
        parameters.variable_displacement ? std::exp(-kDecay * generation / parameters.max_generations) : 1.0;
    run.breed(factor);
    report(generation);
  }
  return finishedRun(objective, parameters.local_step, parameters.final_repeats, best,
                     parameters.max_generations, run.cost);
}

}  // namespace concave_distance

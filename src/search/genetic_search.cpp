#include "genetic_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/selection.h"
#include "crowding.h"
#include "local_descent.h"
#include "mating.h"
#include "mating_restriction.h"
#include "mesh/grid/mesh_metric.h"
#include "mutation.h"
#include "replacement.h"
#include "sharing.h"

namespace concave_distance {
namespace {

/// Mesh distances that the operators need: within the largest radius. Crowding compares distances of any
/// length; it gets all of them where looking one up costs nothing.
double distanceBound(const PairObjective& objective, const GeneticParameters& parameters,
                     const NicheRadii& radii) {
  const bool has_matrices =
      objective.bodyA().metric().hasMatrices() && objective.bodyB().metric().hasMatrices();
  const bool within_radii = parameters.niching == NichingMethod::None ||
                            parameters.niching == NichingMethod::Sharing ||
                            parameters.niching == NichingMethod::DynamicSharing;
  return has_matrices && !within_radii ? std::numeric_limits<double>::infinity()
                                       : std::max({radii.sharing, radii.mating, radii.niche});
}

class GeneticRun {
 public:
  GeneticRun(const PairObjective& objective, const GeneticParameters& parameters, const NicheRadii& radii,
             RandomEngine& engine, SearchWorkspace& workspace, WorkLimit* limit)
      : objective_(objective),
        parameters_(parameters),
        radii_(radii),
        engine_(engine),
        work_(workspace),
        limit_(limit),
        epsilon_(fitnessEpsilon(parameters, objective.bodyA(), objective.bodyB())),
        offspring_count_(offspringCount(parameters.population_size, parameters.generation_gap)) {
    work_.places.reset(distanceBound(objective, parameters, radii));
    work_.convergence.reset(parameters.convergence_generations);
  }

  GeneticResult run(const std::vector<TrialPoint>& inherited, const GenerationObserver& observer) {
    startPopulation(inherited);
    noteBest(0);
    observe(0, observer);
    for (std::uint32_t generation = 1; generation <= parameters_.max_generations; ++generation) {
      mutation_probability_ = mutationProbability(parameters_, generation);
      mutation_radius_ = mutationRadius(parameters_, generation);
      chooseElites();
      step();
      work_.census.take(work_.population_places, work_.places.size());
      restoreElites(work_.elites, work_.places, work_.census, work_.population, work_.population_places);
      admitImmigrants();
      noteBest(generation);
      observe(generation, observer);
      if (work_.convergence.update(work_.census, radii_.niche, work_.places, work_.metric)) {
        result_.converged = true;
        break;
      }
      if (outOfBudget()) {
        break;
      }
    }
    return result_;
  }

 private:
  void startPopulation(const std::vector<TrialPoint>& inherited) {
    const std::size_t kept = std::min<std::size_t>(inherited.size(), parameters_.population_size);
    work_.population.assign(inherited.begin(), inherited.begin() + static_cast<std::ptrdiff_t>(kept));
    while (work_.population.size() < parameters_.population_size) {
      work_.population.push_back(randomTrialPoint(objective_, engine_));
    }
    work_.population_places.resize(work_.population.size());
    std::size_t settled = 0;
    for (std::size_t i = 0; i < work_.population.size(); ++i) {
      if (i > 0 && outOfBudget()) {
        // Seats that nothing is left for go to those settled already, in turn.
        work_.population[i] = work_.population[i - settled];
        work_.population_places[i] = work_.population_places[i - settled];
        continue;
      }
      if (parameters_.descend_first_population) {
        settle(work_.population[i], work_.population_places[i]);
      } else {
        evaluate(work_.population[i], work_.population_places[i]);
      }
      ++settled;
    }
    is_descended_ = parameters_.descend_first_population;
    work_.census.take(work_.population_places, work_.places.size());
  }

  /// Where it stands.
  void evaluate(TrialPoint& point, std::uint32_t& place) {
    point = objective_.evaluate(point.node_a, point.node_b, result_.cost);
    place = work_.places.placeOf(point);
  }

  /// A new individual's distance, or that of the local minimum below it.
  void settle(TrialPoint& point, std::uint32_t& place) {
    if (parameters_.local_optimization == LocalOptimization::None) {
      point = objective_.evaluate(point.node_a, point.node_b, result_.cost);
    } else {
      const TrialPoint minimum =
          descend(objective_, point, &work_.basins, work_.trail, result_.cost, parameters_.descent_moves);
      if (parameters_.local_optimization == LocalOptimization::Lamarckian) {
        point = minimum;
      } else {
        point.squared_distance = minimum.squared_distance;
        best_below_ = std::min(best_below_, minimum);
      }
    }
    place = work_.places.placeOf(point);
  }

  void step() {
    stepAsNiching();
    is_descended_ = true;
  }

  void stepAsNiching() {
    switch (parameters_.niching) {
      case NichingMethod::None:
      case NichingMethod::Sharing:
      case NichingMethod::DynamicSharing:
        selectParents();
        mateCouples();
        mutateOffspring();
        settleOffspring();
        seatOffspring();
        return;
      case NichingMethod::SimpleCrowding:
        selectParents();
        mateCouples();
        mutateOffspring();
        settleOffspring();
        crowdIn();
        return;
      case NichingMethod::DeterministicCrowding:
        drawParents();
        mateCouples();
        mutateOffspring();
        settleOffspring();
        compete();
        std::copy(work_.selected.begin(), work_.selected.end(), work_.seats.begin());
        takeSeats();
        return;
      case NichingMethod::DeterministicCrowdingWithSelection:
        selectParents();
        mateCouples();
        evaluateOffspring();
        compete();
        mutateOffspring();
        settleOffspring();
        seatOffspring();
        return;
    }
  }

  /// Fitness of every individual, shared among its niche where the method says so.
  void weigh() {
    const Census& census = work_.census;
    std::vector<double>& counts = work_.niche_counts;
    if (parameters_.niching == NichingMethod::Sharing) {
      nicheCounts(census, work_.places, work_.metric, radii_.sharing, parameters_.sharing_exponent, counts);
    } else if (parameters_.niching == NichingMethod::DynamicSharing) {
      dynamicNicheCounts(census, work_.places, work_.metric, radii_.sharing, parameters_.sharing_exponent,
                         parameters_.dynamic_niche_limit, work_.dynamic_niches, counts);
    } else {
      counts.assign(census.places.size(), 1.0);
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double squared_distance = work_.places.point(census.places[i]).squared_distance;
      counts[i] = potentialFitness(squared_distance, epsilon_) / counts[i];
    }
    work_.weights.clear();
    for (const std::uint32_t place : work_.population_places) {
      work_.weights.push_back(counts[census.entry_of_place[place]]);
    }
  }

  void selectParents() {
    weigh();
    select(parameters_.selection, work_.weights, offspring_count_, engine_, work_.wheel, work_.selected);
    shuffle(work_.selected, engine_);
  }

  /// Mahfoud: everybody mates, or of a generation gap's share each at most once.
  void drawParents() {
    drawSeats(parameters_.population_size, offspring_count_, engine_, work_.selected);
    shuffle(work_.selected, engine_);
    work_.seats.resize(work_.selected.size());
  }

  void mateCouples() {
    if (parameters_.mating_restriction) {
      if (parameters_.strict_mating_restriction) {
        restrictMatingStrictly(work_.selected, work_.population_places, radii_.mating, work_.places,
                               work_.metric);
      } else {
        restrictMating(work_.selected, work_.population_places, radii_.mating, work_.places, work_.metric,
                       engine_);
      }
    }
    work_.offspring.clear();
    work_.offspring_places.clear();
    for (const std::uint32_t parent : work_.selected) {
      work_.offspring.push_back(work_.population[parent]);
      work_.offspring_places.push_back(work_.population_places[parent]);
    }
    work_.offspring_is_new.assign(work_.offspring.size(), !is_descended_);
    for (std::size_t i = 0; i + 1 < work_.offspring.size(); i += 2) {
      // Parents on one place have children on it: nothing to mate.
      if (uniformUnit(engine_) < parameters_.crossover_probability &&
          work_.offspring_places[i] != work_.offspring_places[i + 1] && mayMate(i) && !outOfBudget()) {
        const Children children = mateCouple(work_.offspring[i], work_.offspring[i + 1]);
        work_.offspring[i] = children.first;
        work_.offspring[i + 1] = children.second;
        work_.offspring_is_new[i] = true;
        work_.offspring_is_new[i + 1] = true;
      }
    }
  }

  /// Whether the couple of offspring i and i + 1 is near enough.
  bool mayMate(std::size_t i) {
    return !(parameters_.mating_restriction && parameters_.strict_mating_restriction) ||
           work_.places.delta(work_.offspring_places[i], work_.offspring_places[i + 1], work_.metric) <=
               radii_.mating;
  }

  const TrialPoint& anyMinimumMet() {
    const std::vector<TrialPoint>& minima = work_.basins.minima();
    return minima[uniformIndex(engine_, static_cast<std::uint32_t>(minima.size()))];
  }

  Children mateCouple(const TrialPoint& parent_1, const TrialPoint& parent_2) {
    const double exchange = parameters_.exchange_probability;
    if (exchange > 0.0 && uniformUnit(engine_) < exchange) {
      if (work_.basins.minima().empty()) {
        return exchangeGenes(parent_1, parent_2, parent_2, parent_1);
      }
      const TrialPoint& donor = anyMinimumMet();
      return exchangeGenes(parent_1, donor, parent_2, anyMinimumMet());
    }
    return mate(parameters_.mating, objective_, parent_1, parent_2, work_.metric, radii_.mating, engine_);
  }

  void mutateOffspring() {
    for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
      if (uniformUnit(engine_) < mutation_probability_) {
        work_.offspring[i] = mutate(work_.offspring[i], mutation_radius_, work_.metric, engine_);
        work_.offspring_is_new[i] = true;
      }
    }
  }

  /// New individuals stay where they are, to be descended later.
  void evaluateOffspring() {
    for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
      if (work_.offspring_is_new[i]) evaluate(work_.offspring[i], work_.offspring_places[i]);
    }
  }

  void settleOffspring() {
    for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
      if (!work_.offspring_is_new[i]) {
        continue;
      }
      if (outOfBudget()) {
        const std::uint32_t parent = work_.selected[i];
        work_.offspring[i] = work_.population[parent];
        work_.offspring_places[i] = work_.population_places[parent];
      } else {
        settle(work_.offspring[i], work_.offspring_places[i]);
      }
      work_.offspring_is_new[i] = false;
    }
  }

  /// The contest of deterministic crowding; afterwards the offspring are those who won, new where a child
  /// has.
  void compete() {
    const auto rules = parameters_.niching == NichingMethod::DeterministicCrowding ? &competePaired
                                                                                   : &competeWithCloserParent;
    for (std::size_t i = 0; i + 1 < work_.offspring.size(); i += 2) {
      const auto parent = [&](std::size_t k) {
        return Contestant{work_.population[work_.selected[k]], work_.population_places[work_.selected[k]]};
      };
      const auto child = [&](std::size_t k) {
        return Contestant{work_.offspring[k], work_.offspring_places[k]};
      };
      Contestant first = parent(i);
      Contestant second = parent(i + 1);
      rules(first, second, child(i), child(i + 1), work_.places, work_.metric);
      work_.offspring[i] = first.point;
      work_.offspring_places[i] = first.place;
      work_.offspring[i + 1] = second.point;
      work_.offspring_places[i + 1] = second.place;
      for (const std::size_t k : {i, i + 1}) {
        const bool is_child = work_.offspring_places[k] != work_.population_places[work_.selected[k]];
        work_.offspring_is_new[k] = is_child || !is_descended_;
      }
    }
  }

  void seatOffspring() {
    drawSeats(parameters_.population_size, offspring_count_, engine_, work_.seats);
    takeSeats();
  }

  void takeSeats() {
    for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
      work_.population[work_.seats[i]] = work_.offspring[i];
      work_.population_places[work_.seats[i]] = work_.offspring_places[i];
    }
  }

  void crowdIn() {
    for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
      const std::uint32_t seat = crowdedOut(work_.population_places, work_.offspring_places[i],
                                            parameters_.crowding_factor, work_.places, work_.metric, engine_);
      work_.population[seat] = work_.offspring[i];
      work_.population_places[seat] = work_.offspring_places[i];
    }
  }

  void chooseElites() {
    findElites(work_.census, work_.places, parameters_.elite_count, work_.elites);
    const bool shares =
        parameters_.niching == NichingMethod::Sharing || parameters_.niching == NichingMethod::DynamicSharing;
    if (!shares || !parameters_.conserve_niches) {
      return;
    }
    std::vector<std::uint32_t>& peaks = work_.dynamic_niches.peaks;
    nichePeaks(work_.census, radii_.niche, work_.places, work_.metric, work_.order, peaks);
    for (const std::uint32_t peak : peaks) {
      if (2 * work_.elites.size() < parameters_.population_size &&
          std::find(work_.elites.begin(), work_.elites.end(), peak) == work_.elites.end()) {
        work_.elites.push_back(peak);
      }
    }
  }

  void admitImmigrants() {
    for (std::uint32_t i = 0; i < parameters_.random_immigrants && !outOfBudget(); ++i) {
      TrialPoint point = randomTrialPoint(objective_, engine_);
      std::uint32_t place = 0;
      settle(point, place);
      seatNewcomer(place, work_.elites, work_.places, work_.census, work_.population,
                   work_.population_places);
    }
  }

  bool outOfBudget() const {
    if (limit_ != nullptr && limit_->isOver()) return true;
    return parameters_.evaluation_limit != 0 && result_.cost.evaluations >= parameters_.evaluation_limit;
  }

  void noteBest(std::uint32_t generation) {
    const TrialPoint best = std::isfinite(best_below_.squared_distance)
                                ? best_below_
                                : *std::min_element(work_.population.begin(), work_.population.end());
    if (generation == 0 || best < result_.best) {
      result_.best = best;
      result_.best_generation = generation;
    }
    result_.generations = generation;
  }

  void observe(std::uint32_t generation, const GenerationObserver& observer) const {
    if (observer) {
      observer({generation, &work_.population, &result_.best});
    }
  }

  const PairObjective& objective_;
  const GeneticParameters& parameters_;
  const NicheRadii& radii_;
  RandomEngine& engine_;
  SearchWorkspace& work_;
  WorkLimit* limit_;  ///< null: none
  double epsilon_;
  std::uint32_t offspring_count_;
  double mutation_probability_ = 0.0;
  double mutation_radius_ = 0.0;
  bool is_descended_ = true;  ///< the population, where individuals are descended at all
  /// Of all local minima met, where individuals do not stand on them: Baldwinian only, else infinitely far.
  TrialPoint best_below_{NodeIndex{}, NodeIndex{}, std::numeric_limits<double>::infinity()};
  GeneticResult result_;
};

}  // namespace

GeneticResult geneticSearch(const PairObjective& objective, const GeneticParameters& parameters,
                            const NicheRadii& radii, const std::vector<TrialPoint>& inherited,
                            RandomEngine& engine, SearchWorkspace& workspace,
                            const GenerationObserver& observer, WorkLimit* limit) {
  return GeneticRun(objective, parameters, radii, engine, workspace, limit).run(inherited, observer);
}

}  // namespace concave_distance

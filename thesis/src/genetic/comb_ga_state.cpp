#include "comb_ga_state.h"

#include <algorithm>

#include "crowding_schemes.h"
#include "generation_gap.h"
#include "mating_methods.h"
#include "mutation_methods.h"
#include "search/mutation.h"
#include "search/replacement.h"
#include "search/selection.h"
#include "search/sharing.h"
#include "strict_mating.h"

namespace concave_distance {

CombGaState::CombGaState(const PairObjective& objective, const CombGaParameters& parameters,
                         const NicheRadii& radii, RandomEngine& engine, SearchWorkspace& work)
    : objective_(objective),
      parameters_(parameters),
      radii_(radii),
      engine_(engine),
      work_(work),
      epsilon_(parameters.fitness_epsilon * fitnessEpsilon(objective.bodyA(), objective.bodyB())),
      offspring_count_(offspringCount(parameters.population_size, parameters.generation_gap)) {}

bool CombGaState::outOfBudget() const {
  return parameters_.evaluation_limit != 0 && cost_.evaluations >= parameters_.evaluation_limit;
}

void CombGaState::evaluate(TrialPoint& point, std::uint32_t& place) {
  point = objective_.evaluate(point.node_a, point.node_b, cost_);
  place = work_.places.placeOf(point);
}

void CombGaState::settle(TrialPoint& point, std::uint32_t& place) {
  const bool is_first_population = cost_.generations == 0;
  if (parameters_.local_optimization == LocalOptimization::None ||
      (is_first_population && !parameters_.descend_first_population)) {
    return evaluate(point, place);
  }
  const TrialPoint minimum =
      descendBy(parameters_.descent_moves, objective_, point, &work_.basins, work_.trail, cost_);
  if (parameters_.local_optimization == LocalOptimization::Lamarckian) {
    point = minimum;
  } else {
    point.squared_distance = minimum.squared_distance;
    best_below_ = std::min(best_below_, minimum);
  }
  place = work_.places.placeOf(point);
}

void CombGaState::startPopulation(const std::vector<TrialPoint>& inherited) {
  const std::size_t size = parameters_.population_size;
  const std::size_t kept = std::min(inherited.size(), size);
  work_.places.clear();
  work_.population.assign(inherited.begin(), inherited.begin() + static_cast<std::ptrdiff_t>(kept));
  while (work_.population.size() < size) work_.population.push_back(randomTrialPoint(objective_, engine_));
  work_.population_places.resize(size);
  std::size_t settled = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0 && outOfBudget()) {
      // Seats that nothing is left for go to those settled already, in turn.
      work_.population[i] = work_.population[i - settled];
      work_.population_places[i] = work_.population_places[i - settled];
      continue;
    }
    settle(work_.population[i], work_.population_places[i]);
    ++settled;
  }
  cost_.inherited += static_cast<std::uint32_t>(std::min(kept, settled));
  work_.census.take(work_.population_places, work_.places.size());
}

void CombGaState::chooseElites() {
  findElites(work_.census, work_.places, parameters_.elite_count, work_.elites);
  const bool shares =
      parameters_.scheme == NichingScheme::Sharing || parameters_.scheme == NichingScheme::DynamicSharing;
  if (!shares || !parameters_.conserve_niches) return;
  nichePeaks(work_.census, radii_.niche, work_.places, work_.metric, work_.order, work_.peaks);
  for (const std::uint32_t peak : work_.peaks) {
    if (2 * work_.elites.size() < parameters_.population_size &&
        std::find(work_.elites.begin(), work_.elites.end(), peak) == work_.elites.end()) {
      work_.elites.push_back(peak);
    }
  }
}

void CombGaState::countNiches() {
  if (parameters_.scheme == NichingScheme::Sharing) {
    nicheCounts(work_.census, work_.places, work_.metric, radii_.sharing, parameters_.sharing_exponent,
                work_.niche_counts);
  } else if (parameters_.scheme == NichingScheme::DynamicSharing) {
    dynamicNicheCounts(work_.census, work_.places, work_.metric, radii_.sharing, parameters_.sharing_exponent,
                       parameters_.dynamic_niche_limit, niches_, work_.niche_counts);
  } else {
    work_.niche_counts.assign(work_.census.places.size(), 1.0);
  }
}

/// Every individual's potential fitness, divided by the niche count of its place.
void CombGaState::weigh() {
  const Census& census = work_.census;
  work_.weights.clear();
  for (const std::uint32_t place : work_.population_places) {
    const double fitness = potentialFitness(work_.places.point(place).squared_distance, epsilon_);
    work_.weights.push_back(fitness / work_.niche_counts[census.entry_of_place[place]]);
  }
}

/// With Mahfoud's crowding everybody mates at most once, as far as the generation gap goes; else fitness
/// selects.
void CombGaState::selectParents() {
  if (parameters_.scheme == NichingScheme::DeterministicCrowding) {
    drawSeats(parameters_.population_size, offspring_count_, engine_, work_.selected);
  } else {
    countNiches();
    weigh();
    select(parameters_.selection, work_.weights, offspring_count_, engine_, wheel_, work_.selected);
  }
  shuffle(work_.selected, engine_);
}

void CombGaState::pairUp() {
  if (!parameters_.mating_restriction) return;
  if (parameters_.strict_mating_restriction) {
    restrictMatingStrictly(work_.selected, work_.population_places, radii_.mating, work_.places,
                           work_.metric);
  } else {
    restrictMating(work_.selected, work_.population_places, radii_.mating, work_.places, work_.metric,
                   engine_);
  }
}

bool CombGaState::mayMate(std::size_t i) {
  return !(parameters_.mating_restriction && parameters_.strict_mating_restriction) ||
         work_.places.delta(work_.offspring_places[i], work_.offspring_places[i + 1], work_.metric) <=
             radii_.mating;
}

/// The children of a couple, each counted that has genes of two places.
Children CombGaState::mateCouple(const TrialPoint& parent_1, const TrialPoint& parent_2) {
  const double exchange = parameters_.exchange_probability;
  if (exchange > 0.0 && uniformUnit(engine_) < exchange) {
    const std::vector<TrialPoint>& minima = work_.basins.minima();
    const auto donor_or = [&](const TrialPoint& parent) {
      return minima.empty() ? parent
                            : minima[uniformIndex(engine_, static_cast<std::uint32_t>(minima.size()))];
    };
    const TrialPoint donor_1 = donor_or(parent_2);
    const TrialPoint donor_2 = donor_or(parent_1);
    cost_.children += (samePlace(parent_1, donor_1) ? 0U : 1U) + (samePlace(parent_2, donor_2) ? 0U : 1U);
    return exchangeGenes(parent_1, donor_1, parent_2, donor_2);
  }
  cost_.children += 2;
  return mateBy(parameters_.mating, objective_, parent_1, parent_2, work_.metric, engine_);
}

/// Makes the offspring of the couples of those selected; who does not mate is its parent's copy.
void CombGaState::mateCouples() {
  work_.offspring.clear();
  work_.offspring_places.clear();
  for (const std::uint32_t parent : work_.selected) {
    work_.offspring.push_back(work_.population[parent]);
    work_.offspring_places.push_back(work_.population_places[parent]);
  }
  work_.offspring_is_new.assign(work_.offspring.size(), false);
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

/// Runs the contest of the thesis's crowding. Afterwards the offspring are those who won, new where a child
/// has.
void CombGaState::competeBeforeDescent(bool parents_are_new) {
  for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
    if (work_.offspring_is_new[i]) evaluate(work_.offspring[i], work_.offspring_places[i]);
  }
  compete(work_, &competeWithCloserParent);
  for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
    const bool is_child = work_.offspring_places[i] != work_.population_places[work_.selected[i]];
    work_.offspring_is_new[i] = is_child || parents_are_new;
  }
}

void CombGaState::mutateOffspring() {
  const double probability = mutationProbability(parameters_, cost_.generations);
  const double radius = mutationRadius(parameters_, objective_, cost_.generations);
  for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
    if (mutateByChance(work_.offspring[i], parameters_.mutation, probability, radius, work_.metric,
                       engine_)) {
      work_.offspring_is_new[i] = true;
    }
  }
}

/// When the budget is spent, new individuals are their parents' copies again.
void CombGaState::settleOffspring() {
  for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
    if (!work_.offspring_is_new[i]) continue;
    if (outOfBudget()) {
      work_.offspring[i] = work_.population[work_.selected[i]];
      work_.offspring_places[i] = work_.population_places[work_.selected[i]];
    } else {
      settle(work_.offspring[i], work_.offspring_places[i]);
    }
    work_.offspring_is_new[i] = false;
  }
}

void CombGaState::takeSeats(const std::vector<std::uint32_t>& seats) {
  for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
    work_.population[seats[i]] = work_.offspring[i];
    work_.population_places[seats[i]] = work_.offspring_places[i];
  }
}

void CombGaState::seatOffspring() {
  if (parameters_.scheme == NichingScheme::DeterministicCrowding) {
    compete(work_, &competePaired);
    takeSeats(work_.selected);
  } else if (parameters_.scheme == NichingScheme::SimpleCrowding) {
    for (std::size_t i = 0; i < work_.offspring.size(); ++i) {
      const std::uint32_t seat = crowdedOut(work_.population_places, work_.offspring_places[i],
                                            parameters_.crowding_factor, work_.places, work_.metric, engine_);
      work_.population[seat] = work_.offspring[i];
      work_.population_places[seat] = work_.offspring_places[i];
    }
  } else {
    drawSeats(parameters_.population_size, offspring_count_, engine_, seats_);
    takeSeats(seats_);
  }
}

void CombGaState::breed() {
  selectParents();
  pairUp();
  mateCouples();
  const bool parents_are_new = cost_.generations == 1 && !parameters_.descend_first_population;
  if (parents_are_new) work_.offspring_is_new.assign(work_.offspring.size(), true);
  if (parameters_.scheme == NichingScheme::DeterministicCrowdingWithSelection) {
    competeBeforeDescent(parents_are_new);
  }
  mutateOffspring();
  settleOffspring();
  seatOffspring();
}

void CombGaState::admitImmigrants() {
  for (std::uint32_t i = 0; i < parameters_.random_immigrants && !outOfBudget(); ++i) {
    TrialPoint point = randomTrialPoint(objective_, engine_);
    std::uint32_t place = 0;
    settle(point, place);
    seatNewcomer(place, work_.elites, work_.places, work_.census, work_.population, work_.population_places);
  }
}

void CombGaState::runGeneration() {
  ++cost_.generations;
  chooseElites();
  breed();
  work_.census.take(work_.population_places, work_.places.size());
  restoreElites(work_.elites, work_.places, work_.census, work_.population, work_.population_places);
  admitImmigrants();
}

}  // namespace concave_distance

#include "comb_ga_state.h"

#include <algorithm>

#include "crowding_schemes.h"
#include "generation_gap.h"
#include "mating_methods.h"
#include "mutation_methods.h"
#include "search/reproduction.h"
#include "search/selection.h"
#include "search/sharing.h"
#include "strict_mating.h"

namespace concave_distance {

CombGaState::CombGaState(const GeneticState& core, const CombGaParameters& parameters)
    : GeneticState(core),
      all_(parameters),
      offspring_count_(offspringCount(parameters.population_size, parameters.generation_gap)) {}

void CombGaState::evaluate(TrialPoint& point, std::uint32_t& place) {
  point = objective.evaluate(point.node_a, point.node_b, cost);
  place = work.places.placeOf(point);
}

void CombGaState::settle(TrialPoint& point, std::uint32_t& place) {
  const bool is_first_population = cost.generations == 0;
  if (all_.local_optimization == LocalOptimization::None ||
      (is_first_population && !all_.descend_first_population)) {
    return evaluate(point, place);
  }
  const TrialPoint minimum = descendBy(all_.descent_moves, objective, point, &work.basins, work.trail, cost);
  if (all_.local_optimization == LocalOptimization::Lamarckian) {
    point = minimum;
  } else {
    point.squared_distance = minimum.squared_distance;
    best_below = std::min(best_below, minimum);
  }
  place = work.places.placeOf(point);
}

bool CombGaState::mayMate(std::size_t i) {
  return !(all_.mating_restriction && all_.strict_mating_restriction) ||
         work.places.delta(work.offspring_places[i], work.offspring_places[i + 1], work.metric) <=
             radii.mating;
}

Children CombGaState::mate(const TrialPoint& parent_1, const TrialPoint& parent_2) {
  return mateBy(all_.mating, objective, parent_1, parent_2, work.metric, radii.mating, engine);
}

void CombGaState::countNiches() {
  if (all_.scheme == NichingScheme::Sharing) {
    nicheCounts(work.census, work.places, work.metric, radii.sharing, all_.sharing_exponent,
                work.niche_counts);
  } else if (all_.scheme == NichingScheme::DynamicSharing) {
    dynamicNicheCounts(work.census, work.places, work.metric, radii.sharing, all_.sharing_exponent,
                       all_.dynamic_niche_limit, niches_, work.niche_counts);
  } else {
    work.niche_counts.assign(work.census.places.size(), 1.0);
  }
}

/// With Mahfoud's crowding everybody mates at most once, as far as the generation gap goes; else fitness
/// selects.
void CombGaState::selectByScheme() {
  if (all_.scheme == NichingScheme::DeterministicCrowding) {
    drawSeats(all_.population_size, offspring_count_, engine, work.selected);
  } else {
    countNiches();
    weigh(*this);
    select(all_.selection, work.weights, offspring_count_, engine, wheel_, work.selected);
  }
  shuffle(work.selected, engine);
}

void CombGaState::restrictByScheme() {
  if (all_.mating_restriction && all_.strict_mating_restriction) {
    restrictMatingStrictly(work.selected, work.population_places, radii.mating, work.places, work.metric);
  } else {
    pairUp(*this);
  }
}

/// Runs the contest of the thesis's crowding. Afterwards the offspring are those who won, new where a child
/// has.
void CombGaState::competeBeforeDescent(bool parents_are_new) {
  for (std::size_t i = 0; i < work.offspring.size(); ++i) {
    if (work.offspring_is_new[i]) evaluate(work.offspring[i], work.offspring_places[i]);
  }
  compete(*this, &competeWithCloserParent);
  for (std::size_t i = 0; i < work.offspring.size(); ++i) {
    const bool is_child = work.offspring_places[i] != work.population_places[work.selected[i]];
    work.offspring_is_new[i] = is_child || parents_are_new;
  }
}

void CombGaState::mutateByMethod() {
  const double probability = mutationProbability(all_, cost.generations);
  const double radius = mutationRadius(all_, objective, cost.generations);
  for (std::size_t i = 0; i < work.offspring.size(); ++i) {
    if (mutateByChance(work.offspring[i], all_.mutation, probability, radius, work.metric, engine)) {
      work.offspring_is_new[i] = true;
    }
  }
}

void CombGaState::seatByScheme() {
  if (all_.scheme == NichingScheme::DeterministicCrowding) {
    compete(*this, &competePaired);
    takeSeats(*this, work.selected);
  } else if (all_.scheme == NichingScheme::SimpleCrowding) {
    for (std::size_t i = 0; i < work.offspring.size(); ++i) {
      const std::uint32_t seat = crowdedOut(work.population_places, work.offspring_places[i],
                                            all_.crowding_factor, work.places, work.metric, engine);
      work.population[seat] = work.offspring[i];
      work.population_places[seat] = work.offspring_places[i];
    }
  } else {
    drawSeats(all_.population_size, offspring_count_, engine, seats_);
    takeSeats(*this, seats_);
  }
}

void CombGaState::breed() {
  selectByScheme();
  restrictByScheme();
  mateCouples(*this);
  const bool parents_are_new = cost.generations == 1 && !all_.descend_first_population;
  if (parents_are_new) work.offspring_is_new.assign(work.offspring.size(), true);
  if (all_.scheme == NichingScheme::DeterministicCrowdingWithSelection) competeBeforeDescent(parents_are_new);
  mutateByMethod();
  settleOffspring(*this);
  seatByScheme();
}

}  // namespace concave_distance

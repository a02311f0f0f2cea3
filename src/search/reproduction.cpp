#include "reproduction.h"

#include "mating.h"
#include "mutation.h"
#include "selection.h"
#include "sharing.h"

namespace concave_distance {
namespace {

constexpr double kSharingExponent = 1.0;  // alpha_s

const TrialPoint& anyMinimumMet(GeneticState& state) {
  const std::vector<TrialPoint>& minima = state.work.basins.minima();
  return minima[uniformIndex(state.engine, static_cast<std::uint32_t>(minima.size()))];
}

/// The children of a couple, each counted that has genes of two places.
Children mateCouple(GeneticState& state, const TrialPoint& parent_1, const TrialPoint& parent_2) {
  SearchWorkspace& work = state.work;
  const double exchange = state.parameters.exchange_probability;
  if (exchange > 0.0 && uniformUnit(state.engine) < exchange) {
    const bool has_minima = !work.basins.minima().empty();
    const TrialPoint donor_1 = has_minima ? anyMinimumMet(state) : parent_2;
    const TrialPoint donor_2 = has_minima ? anyMinimumMet(state) : parent_1;
    state.cost.children +=
        (samePlace(parent_1, donor_1) ? 0U : 1U) + (samePlace(parent_2, donor_2) ? 0U : 1U);
    return exchangeGenes(parent_1, donor_1, parent_2, donor_2);
  }
  state.cost.children += 2;
  return mate(parent_1, parent_2, work.metric, state.engine);
}

/// The partner of the first parent: its mate if that stands on another place, else one of the population
/// that does, else a newcomer.
TrialPoint partnerElsewhere(GeneticState& state) {
  const SearchWorkspace& work = state.work;
  const std::uint32_t place = work.population_places[work.selected[0]];
  if (work.population_places[work.selected[1]] != place) return work.population[work.selected[1]];
  for (std::size_t i = 0; i < work.population.size(); ++i) {
    if (work.population_places[i] != place) return work.population[i];
  }
  const TrialPoint newcomer = randomTrialPoint(state.objective, state.engine);
  return state.objective.evaluate(newcomer.node_a, newcomer.node_b, state.cost);
}

/// Mates the first couple: each child takes a node from either parent, or a place on the way between them.
void mateFirstCouple(GeneticState& state) {
  SearchWorkspace& work = state.work;
  const TrialPoint first = work.population[work.selected[0]];
  const TrialPoint second = partnerElsewhere(state);
  const bool exchanges = uniformUnit(state.engine) < state.parameters.exchange_probability;
  const Children children = exchanges ? exchangeGenes(first, second, first, second)
                                      : mate(first, second, work.metric, state.engine);
  work.offspring[0] = children.first;
  work.offspring[1] = children.second;
  work.offspring_is_new[0] = work.offspring_is_new[1] = true;
  state.cost.children += 2;
}

/// Fills work.weights: every individual's potential fitness, divided by work.niche_counts of its place.
void weigh(GeneticState& state) {
  SearchWorkspace& work = state.work;
  const Census& census = work.census;
  std::vector<double>& counts = work.niche_counts;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double squared_distance = work.places.point(census.places[i]).squared_distance;
    counts[i] = potentialFitness(squared_distance, state.epsilon) / counts[i];
  }
  work.weights.clear();
  for (const std::uint32_t place : work.population_places) {
    work.weights.push_back(counts[census.entry_of_place[place]]);
  }
}

/// Selects by fitness, shared among niches, into work.selected.
void selectParents(GeneticState& state) {
  SearchWorkspace& work = state.work;
  nicheCounts(work.census, work.places, work.metric, state.radii.sharing, kSharingExponent,
              work.niche_counts);
  weigh(state);
  stochasticUniversalSampling(work.weights, state.parameters.population_size, state.engine, work.selected);
  shuffle(work.selected, state.engine);
}

/// Makes work.offspring of the couples of those selected.
void mateCouples(GeneticState& state) {
  SearchWorkspace& work = state.work;
  work.offspring.clear();
  work.offspring_places.clear();
  const std::uint32_t children_before = state.cost.children;
  for (const std::uint32_t parent : work.selected) {
    work.offspring.push_back(work.population[parent]);
    work.offspring_places.push_back(work.population_places[parent]);
  }
  work.offspring_is_new.assign(work.offspring.size(), false);
  for (std::size_t i = 0; i + 1 < work.offspring.size(); i += 2) {
    // Parents on one place have children on it: nothing to mate.
    if (uniformUnit(state.engine) < state.parameters.crossover_probability &&
        work.offspring_places[i] != work.offspring_places[i + 1] && !state.isOver()) {
      const Children children = mateCouple(state, work.offspring[i], work.offspring[i + 1]);
      work.offspring[i] = children.first;
      work.offspring[i + 1] = children.second;
      work.offspring_is_new[i] = true;
      work.offspring_is_new[i + 1] = true;
    }
  }
  if (state.couples == Couples::AtLeastOne && state.cost.children == children_before) mateFirstCouple(state);
}

void mutateOffspring(GeneticState& state) {
  SearchWorkspace& work = state.work;
  const double probability =
      state.parameters.mutation_probability.value_or(1.0 / state.parameters.population_size);
  for (std::size_t i = 0; i < work.offspring.size(); ++i) {
    if (uniformUnit(state.engine) < probability) {
      work.offspring[i] = mutate(work.offspring[i], work.metric, state.engine);
      work.offspring_is_new[i] = true;
    }
  }
}

/// Settles new individuals.
void settleOffspring(GeneticState& state) {
  SearchWorkspace& work = state.work;
  bool may_stop = state.couples == Couples::AsDrawn;
  for (std::size_t i = 0; i < work.offspring.size(); ++i) {
    if (!work.offspring_is_new[i]) {
      continue;
    }
    if (may_stop && state.isOver()) {
      const std::uint32_t parent = work.selected[i];
      work.offspring[i] = work.population[parent];
      work.offspring_places[i] = work.population_places[parent];
    } else {
      state.settle(work.offspring[i], work.offspring_places[i]);
    }
    work.offspring_is_new[i] = false;
    may_stop = true;
  }
}

}  // namespace

void breed(GeneticState& state) {
  selectParents(state);
  SearchWorkspace& work = state.work;
  restrictMating(work.selected, work.population_places, state.radii.mating, work.places, work.metric,
                 state.engine);
  mateCouples(state);
  mutateOffspring(state);
  settleOffspring(state);
  work.population.swap(work.offspring);
  work.population_places.swap(work.offspring_places);
}

}  // namespace concave_distance

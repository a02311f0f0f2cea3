#include "reproduction.h"

#include "base/selection.h"
#include "mating.h"
#include "mating_restriction.h"
#include "mutation.h"
#include "replacement.h"
#include "sharing.h"

namespace concave_distance {
namespace {

/// Fitness of every individual, shared among its niche where the method says so.
void weigh(GeneticState& state) {
  SearchWorkspace& work = state.work;
  const Census& census = work.census;
  std::vector<double>& counts = work.niche_counts;
  if (state.parameters.niching == NichingMethod::Sharing) {
    nicheCounts(census, work.places, work.metric, state.radii.sharing, state.parameters.sharing_exponent,
                counts);
  } else if (state.parameters.niching == NichingMethod::DynamicSharing) {
    dynamicNicheCounts(census, work.places, work.metric, state.radii.sharing,
                       state.parameters.sharing_exponent, state.parameters.dynamic_niche_limit,
                       work.dynamic_niches, counts);
  } else {
    counts.assign(census.places.size(), 1.0);
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double squared_distance = work.places.point(census.places[i]).squared_distance;
    counts[i] = potentialFitness(squared_distance, state.epsilon) / counts[i];
  }
  work.weights.clear();
  for (const std::uint32_t place : work.population_places) {
    work.weights.push_back(counts[census.entry_of_place[place]]);
  }
}

/// Whether the couple of offspring i and i + 1 is near enough.
bool mayMate(GeneticState& state, std::size_t i) {
  SearchWorkspace& work = state.work;
  return !(state.parameters.mating_restriction && state.parameters.strict_mating_restriction) ||
         work.places.delta(work.offspring_places[i], work.offspring_places[i + 1], work.metric) <=
             state.radii.mating;
}

const TrialPoint& anyMinimumMet(GeneticState& state) {
  const std::vector<TrialPoint>& minima = state.work.basins.minima();
  return minima[uniformIndex(state.engine, static_cast<std::uint32_t>(minima.size()))];
}

Children mateCouple(GeneticState& state, const TrialPoint& parent_1, const TrialPoint& parent_2) {
  SearchWorkspace& work = state.work;
  const double exchange = state.parameters.exchange_probability;
  if (exchange > 0.0 && uniformUnit(state.engine) < exchange) {
    if (work.basins.minima().empty()) {
      return exchangeGenes(parent_1, parent_2, parent_2, parent_1);
    }
    const TrialPoint& donor = anyMinimumMet(state);
    return exchangeGenes(parent_1, donor, parent_2, anyMinimumMet(state));
  }
  return mate(state.parameters.mating, state.objective, parent_1, parent_2, work.metric, state.radii.mating,
              state.engine);
}

}  // namespace

void selectParents(GeneticState& state) {
  SearchWorkspace& work = state.work;
  weigh(state);
  select(state.parameters.selection, work.weights, state.offspring_count, state.engine, work.wheel,
         work.selected);
  shuffle(work.selected, state.engine);
}

void drawParents(GeneticState& state) {
  SearchWorkspace& work = state.work;
  drawSeats(state.parameters.population_size, state.offspring_count, state.engine, work.selected);
  shuffle(work.selected, state.engine);
  work.seats.resize(work.selected.size());
}

void mateCouples(GeneticState& state) {
  SearchWorkspace& work = state.work;
  if (state.parameters.mating_restriction) {
    if (state.parameters.strict_mating_restriction) {
      restrictMatingStrictly(work.selected, work.population_places, state.radii.mating, work.places,
                             work.metric);
    } else {
      restrictMating(work.selected, work.population_places, state.radii.mating, work.places, work.metric,
                     state.engine);
    }
  }
  work.offspring.clear();
  work.offspring_places.clear();
  for (const std::uint32_t parent : work.selected) {
    work.offspring.push_back(work.population[parent]);
    work.offspring_places.push_back(work.population_places[parent]);
  }
  work.offspring_is_new.assign(work.offspring.size(), !state.is_descended);
  for (std::size_t i = 0; i + 1 < work.offspring.size(); i += 2) {
    // Parents on one place have children on it: nothing to mate.
    if (uniformUnit(state.engine) < state.parameters.crossover_probability &&
        work.offspring_places[i] != work.offspring_places[i + 1] && mayMate(state, i) &&
        !state.outOfBudget()) {
      const Children children = mateCouple(state, work.offspring[i], work.offspring[i + 1]);
      work.offspring[i] = children.first;
      work.offspring[i + 1] = children.second;
      work.offspring_is_new[i] = true;
      work.offspring_is_new[i + 1] = true;
    }
  }
}

void mutateOffspring(GeneticState& state) {
  SearchWorkspace& work = state.work;
  for (std::size_t i = 0; i < work.offspring.size(); ++i) {
    if (uniformUnit(state.engine) < state.mutation_probability) {
      work.offspring[i] = mutate(work.offspring[i], state.mutation_radius, work.metric, state.engine);
      work.offspring_is_new[i] = true;
    }
  }
}

void evaluateOffspring(GeneticState& state) {
  SearchWorkspace& work = state.work;
  for (std::size_t i = 0; i < work.offspring.size(); ++i) {
    if (work.offspring_is_new[i]) state.evaluate(work.offspring[i], work.offspring_places[i]);
  }
}

void settleOffspring(GeneticState& state) {
  SearchWorkspace& work = state.work;
  for (std::size_t i = 0; i < work.offspring.size(); ++i) {
    if (!work.offspring_is_new[i]) {
      continue;
    }
    if (state.outOfBudget()) {
      const std::uint32_t parent = work.selected[i];
      work.offspring[i] = work.population[parent];
      work.offspring_places[i] = work.population_places[parent];
    } else {
      state.settle(work.offspring[i], work.offspring_places[i]);
    }
    work.offspring_is_new[i] = false;
  }
}

}  // namespace concave_distance

#include "generation.h"

#include <algorithm>

#include "crowding.h"
#include "mutation.h"
#include "replacement.h"
#include "reproduction.h"

namespace concave_distance {
namespace {

/// The contest of deterministic crowding; afterwards the offspring are those who won, new where a child
/// has.
void compete(GeneticState& state) {
  SearchWorkspace& work = state.work;
  const auto rules = state.parameters.niching == NichingMethod::DeterministicCrowding
                         ? &competePaired
                         : &competeWithCloserParent;
  for (std::size_t i = 0; i + 1 < work.offspring.size(); i += 2) {
    const auto parent = [&](std::size_t k) {
      return Contestant{work.population[work.selected[k]], work.population_places[work.selected[k]]};
    };
    const auto child = [&](std::size_t k) { return Contestant{work.offspring[k], work.offspring_places[k]}; };
    Contestant first = parent(i);
    Contestant second = parent(i + 1);
    rules(first, second, child(i), child(i + 1), work.places, work.metric);
    work.offspring[i] = first.point;
    work.offspring_places[i] = first.place;
    work.offspring[i + 1] = second.point;
    work.offspring_places[i + 1] = second.place;
    for (const std::size_t k : {i, i + 1}) {
      const bool is_child = work.offspring_places[k] != work.population_places[work.selected[k]];
      work.offspring_is_new[k] = is_child || !state.is_descended;
    }
  }
}

void takeSeats(GeneticState& state) {
  SearchWorkspace& work = state.work;
  for (std::size_t i = 0; i < work.offspring.size(); ++i) {
    work.population[work.seats[i]] = work.offspring[i];
    work.population_places[work.seats[i]] = work.offspring_places[i];
  }
}

void seatOffspring(GeneticState& state) {
  drawSeats(state.parameters.population_size, state.offspring_count, state.engine, state.work.seats);
  takeSeats(state);
}

void crowdIn(GeneticState& state) {
  SearchWorkspace& work = state.work;
  for (std::size_t i = 0; i < work.offspring.size(); ++i) {
    const std::uint32_t seat =
        crowdedOut(work.population_places, work.offspring_places[i], state.parameters.crowding_factor,
                   work.places, work.metric, state.engine);
    work.population[seat] = work.offspring[i];
    work.population_places[seat] = work.offspring_places[i];
  }
}

void stepAsNiching(GeneticState& state) {
  SearchWorkspace& work = state.work;
  switch (state.parameters.niching) {
    case NichingMethod::None:
    case NichingMethod::Sharing:
    case NichingMethod::DynamicSharing:
      selectParents(state);
      mateCouples(state);
      mutateOffspring(state);
      settleOffspring(state);
      seatOffspring(state);
      return;
    case NichingMethod::SimpleCrowding:
      selectParents(state);
      mateCouples(state);
      mutateOffspring(state);
      settleOffspring(state);
      crowdIn(state);
      return;
    case NichingMethod::DeterministicCrowding:
      drawParents(state);
      mateCouples(state);
      mutateOffspring(state);
      settleOffspring(state);
      compete(state);
      std::copy(work.selected.begin(), work.selected.end(), work.seats.begin());
      takeSeats(state);
      return;
    case NichingMethod::DeterministicCrowdingWithSelection:
      selectParents(state);
      mateCouples(state);
      evaluateOffspring(state);
      compete(state);
      mutateOffspring(state);
      settleOffspring(state);
      seatOffspring(state);
      return;
  }
}

}  // namespace

void chooseElites(GeneticState& state) {
  SearchWorkspace& work = state.work;
  findElites(work.census, work.places, state.parameters.elite_count, work.elites);
  const bool shares = state.parameters.niching == NichingMethod::Sharing ||
                      state.parameters.niching == NichingMethod::DynamicSharing;
  if (!shares || !state.parameters.conserve_niches) {
    return;
  }
  std::vector<std::uint32_t>& peaks = work.dynamic_niches.peaks;
  nichePeaks(work.census, state.radii.niche, work.places, work.metric, work.order, peaks);
  for (const std::uint32_t peak : peaks) {
    if (2 * work.elites.size() < state.parameters.population_size &&
        std::find(work.elites.begin(), work.elites.end(), peak) == work.elites.end()) {
      work.elites.push_back(peak);
    }
  }
}

void breed(GeneticState& state) {
  stepAsNiching(state);
  state.is_descended = true;
}

void admitImmigrants(GeneticState& state) {
  SearchWorkspace& work = state.work;
  for (std::uint32_t i = 0; i < state.parameters.random_immigrants && !state.outOfBudget(); ++i) {
    TrialPoint point = randomTrialPoint(state.objective, state.engine);
    std::uint32_t place = 0;
    state.settle(point, place);
    seatNewcomer(place, work.elites, work.places, work.census, work.population, work.population_places);
  }
}

}  // namespace concave_distance

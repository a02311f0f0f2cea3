#include "replacement.h"

#include <algorithm>

namespace concave_distance {
namespace {

bool contains(const std::vector<std::uint32_t>& values, std::uint32_t value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// The individual whose seat a newcomer takes; the population's size when there is none.
std::size_t seatToGive(const std::vector<std::uint32_t>& elites, const Census& census,
                       const std::vector<TrialPoint>& population,
                       const std::vector<std::uint32_t>& population_places) {
  const auto crowd = std::max_element(census.counts.begin(), census.counts.end());
  if (*crowd > 1) {
    const std::uint32_t place = census.places[static_cast<std::size_t>(crowd - census.counts.begin())];
    return static_cast<std::size_t>(std::find(population_places.begin(), population_places.end(), place) -
                                    population_places.begin());
  }
  std::size_t worst = population.size();
  for (std::size_t i = 0; i < population.size(); ++i) {
    if (!contains(elites, population_places[i]) &&
        (worst == population.size() || population[worst] < population[i])) {
      worst = i;
    }
  }
  return worst;
}

}  // namespace

void findElites(const Census& census, const TrialPointTable& places, std::uint32_t elite_count,
                std::vector<std::uint32_t>& elites) {
  elites.clear();
  while (elites.size() < std::min<std::size_t>(elite_count, census.places.size())) {
    const std::uint32_t* best = nullptr;
    for (const std::uint32_t& place : census.places) {
      if (!contains(elites, place) && (best == nullptr || places.point(place) < places.point(*best))) {
        best = &place;
      }
    }
    elites.push_back(*best);
  }
}

bool seatNewcomer(std::uint32_t place, const std::vector<std::uint32_t>& elites,
                  const TrialPointTable& places, Census& census, std::vector<TrialPoint>& population,
                  std::vector<std::uint32_t>& population_places) {
  if (place < census.entry_of_place.size() && census.entry_of_place[place] != Census::kNone) {
    return true;
  }
  const std::size_t seat = seatToGive(elites, census, population, population_places);
  if (seat == population.size()) {
    return false;
  }
  census.move(population_places[seat], place, places.size());
  population[seat] = places.point(place);
  population_places[seat] = place;
  return true;
}

void restoreElites(const std::vector<std::uint32_t>& elites, const TrialPointTable& places, Census& census,
                   std::vector<TrialPoint>& population, std::vector<std::uint32_t>& population_places) {
  for (const std::uint32_t elite : elites) {
    if (!seatNewcomer(elite, elites, places, census, population, population_places)) {
      return;  // more elites than seats
    }
  }
}

}  // namespace concave_distance

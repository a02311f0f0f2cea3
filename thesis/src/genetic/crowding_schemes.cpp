#include "crowding_schemes.h"

#include <limits>

namespace concave_distance {

void compete(SearchWorkspace& work, Contest contest) {
  for (std::size_t i = 0; i + 1 < work.offspring.size(); i += 2) {
    const auto parent = [&](std::size_t k) {
      return Contestant{work.population[work.selected[k]], work.population_places[work.selected[k]]};
    };
    const auto child = [&](std::size_t k) { return Contestant{work.offspring[k], work.offspring_places[k]}; };
    Contestant first = parent(i);
    Contestant second = parent(i + 1);
    contest(first, second, child(i), child(i + 1), work.places, work.metric);
    work.offspring[i] = first.point;
    work.offspring_places[i] = first.place;
    work.offspring[i + 1] = second.point;
    work.offspring_places[i + 1] = second.place;
  }
}

void compete(Contestant& seat, const Contestant& child) {
  if (child.point.squared_distance < seat.point.squared_distance) {
    seat = child;
  }
}

void competePaired(Contestant& parent_1, Contestant& parent_2, const Contestant& child_1,
                   const Contestant& child_2, TrialPointTable& places, PairMetric& metric) {
  const double straight = places.delta(parent_1.place, child_1.place, metric) +
                          places.delta(parent_2.place, child_2.place, metric);
  const double crossed = places.delta(parent_1.place, child_2.place, metric) +
                         places.delta(parent_2.place, child_1.place, metric);
  if (straight <= crossed) {
    compete(parent_1, child_1);
    compete(parent_2, child_2);
  } else {
    compete(parent_1, child_2);
    compete(parent_2, child_1);
  }
}

void competeWithCloserParent(Contestant& parent_1, Contestant& parent_2, const Contestant& child_1,
                             const Contestant& child_2, TrialPointTable& places, PairMetric& metric) {
  const auto is_closer_to_first = [&](const Contestant& child) {
    return places.delta(parent_1.place, child.place, metric) <=
           places.delta(parent_2.place, child.place, metric);
  };
  // Both answers before the first replacement: "parent" means those who were mated.
  const bool child_1_to_first = is_closer_to_first(child_1);
  const bool child_2_to_first = is_closer_to_first(child_2);
  compete(child_1_to_first ? parent_1 : parent_2, child_1);
  compete(child_2_to_first ? parent_1 : parent_2, child_2);
}

std::uint32_t crowdedOut(const std::vector<std::uint32_t>& population_places, std::uint32_t child_place,
                         std::uint32_t crowding_factor, TrialPointTable& places, PairMetric& metric,
                         RandomEngine& engine) {
  std::uint32_t closest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < crowding_factor; ++i) {
    const std::uint32_t candidate =
        uniformIndex(engine, static_cast<std::uint32_t>(population_places.size()));
    const double delta = places.delta(population_places[candidate], child_place, metric);
    if (i == 0 || delta < least) {
      least = delta;
      closest = candidate;
    }
  }
  return closest;
}

}  // namespace concave_distance

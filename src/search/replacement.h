#pragma once

#include <cstdint>
#include <vector>

#include "trial_point_table.h"

namespace concave_distance {

/// The places of the `elite_count` best trial points of a population, best first; fewer when fewer are there.
void findElites(const Census& census, const TrialPointTable& places, std::uint32_t elite_count,
                std::vector<std::uint32_t>& elites);

/// Seats a newcomer where nobody stands yet; with somebody on its place nothing happens. The seat is taken
/// from the most crowded place, so that no niche dies for it; when nobody shares a place, from the worst
/// individual that is no elite. False when there is no such seat. `census` is kept up to date.
bool seatNewcomer(std::uint32_t place, const std::vector<std::uint32_t>& elites,
                  const TrialPointTable& places, Census& census, std::vector<TrialPoint>& population,
                  std::vector<std::uint32_t>& population_places);

/// Puts every elite that nobody of the new population stands on back into it, because sampling of shared
/// fitness can lose the best.
void restoreElites(const std::vector<std::uint32_t>& elites, const TrialPointTable& places, Census& census,
                   std::vector<TrialPoint>& population, std::vector<std::uint32_t>& population_places);

/// An individual as the crowding methods see it: its trial point and the place that stands for it.
struct Contestant {
  TrialPoint point;
  std::uint32_t place;
};

/// Replaces the seat's holder by the child when that is strictly fitter.
void compete(Contestant& seat, const Contestant& child);

/// Deterministic crowding (Mahfoud 1992): the two pairings of parents and children are compared by their sum
/// of mesh distances, and in the closer one each child that is strictly fitter replaces its parent.
/// Children have been descended and evaluated: an undescended child would lose to any local minimum.
void competePaired(Contestant& parent_1, Contestant& parent_2, const Contestant& child_1,
                   const Contestant& child_2, TrialPointTable& places, PairMetric& metric);

/// Lets both children compete with both parents; who wins takes the parent's place.
using Contest = void (*)(Contestant& parent_1, Contestant& parent_2, const Contestant& child_1,
                         const Contestant& child_2, TrialPointTable& places, PairMetric& metric);

}  // namespace concave_distance

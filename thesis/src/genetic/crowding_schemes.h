#pragma once

#include <cstdint>
#include <vector>

#include "base/random_engine.h"
#include "search/search_workspace.h"

namespace concave_distance {

/// An individual as the crowding methods see it: its trial point and the place that stands for it.
struct Contestant {
  TrialPoint point;
  std::uint32_t place;
};

/// Lets both children compete with both parents; who wins takes the parent's place.
using Contest = void (*)(Contestant& parent_1, Contestant& parent_2, const Contestant& child_1,
                         const Contestant& child_2, TrialPointTable& places, PairMetric& metric);

/// Lets the children of each couple compete with their parents; afterwards the offspring are those who won.
void compete(SearchWorkspace& work, Contest contest);

/// Replaces the seat's holder by the child when that is strictly fitter.
void compete(Contestant& seat, const Contestant& child);

/// Deterministic crowding (Mahfoud 1992): the two pairings of parents and children are compared by their sum
/// of mesh distances, and in the closer one each child that is strictly fitter replaces its parent.
/// Children have been descended and evaluated: an undescended child would lose to any local minimum.
void competePaired(Contestant& parent_1, Contestant& parent_2, const Contestant& child_1,
                   const Contestant& child_2, TrialPointTable& places, PairMetric& metric);

/// The thesis's form (Carretero, sec. 4.4.2, 4.6.2): each child for itself against the parent closer to it;
/// the second child meets whoever holds that parent's seat after the first.
void competeWithCloserParent(Contestant& parent_1, Contestant& parent_2, const Contestant& child_1,
                             const Contestant& child_2, TrialPointTable& places, PairMetric& metric);

/// Simple crowding (De Jong 1975; Carretero, sec. 4.4.1): the index of the individual closest to the child
/// among `crowding_factor` drawn from the population with replacement; the child takes its seat whatever its
/// fitness.
std::uint32_t crowdedOut(const std::vector<std::uint32_t>& population_places, std::uint32_t child_place,
                         std::uint32_t crowding_factor, TrialPointTable& places, PairMetric& metric,
                         RandomEngine& engine);

}  // namespace concave_distance

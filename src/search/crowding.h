#pragma once

#include <cstdint>

#include "trial_point_table.h"

namespace concave_distance {

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

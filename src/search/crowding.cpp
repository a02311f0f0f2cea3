#include "crowding.h"

namespace concave_distance {

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

}  // namespace concave_distance

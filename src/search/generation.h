#pragma once

#include "genetic_state.h"

namespace concave_distance {

/// The places that survive the next generation, into work.elites.
void chooseElites(GeneticState& state);
/// Parents, children and who of them takes which seat, in the block order of the method of niching
/// (Carretero, fig. 4.3, 4.4).
void breed(GeneticState& state);
/// Random individuals take seats where nobody stands yet.
void admitImmigrants(GeneticState& state);

}  // namespace concave_distance

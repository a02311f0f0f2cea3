#pragma once

#include "genetic_state.h"

namespace concave_distance {

/// Replaces the population by its offspring (Carretero, fig. 4.3): parents selected by fitness that is shared
/// among niches, mated within the mating radius, children mutated and settled. Who does not mate is its
/// parent's copy, and so is who was to be settled when the time is over.
void breed(GeneticState& state);

}  // namespace concave_distance

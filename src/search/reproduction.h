#pragma once

#include <cstdint>
#include <vector>

#include "genetic_state.h"
#include "replacement.h"

namespace concave_distance {

/// Fills work.weights: every individual's potential fitness, divided by work.niche_counts of its place.
void weigh(GeneticState& state);
/// Selects by fitness, shared among niches, into work.selected.
void selectParents(GeneticState& state);
/// Lets everybody mate once (Mahfoud), in random order. Into work.selected.
void drawParents(GeneticState& state);
/// Rearranges work.selected so that couples are within the mating radius, where mating is restricted.
void pairUp(GeneticState& state);
/// Makes work.offspring of the couples of those selected; who does not mate is its parent's copy.
void mateCouples(GeneticState& state);
void mutateOffspring(GeneticState& state);
/// Settles new individuals; when the budget is spent, they are their parents' copies again.
void settleOffspring(GeneticState& state);
/// Lets the children of each couple compete with their parents; afterwards the offspring are those who won.
void compete(GeneticState& state, Contest contest);
/// Gives each of the offspring its seat in the population. @param seats indices of individuals
void takeSeats(GeneticState& state, const std::vector<std::uint32_t>& seats);

}  // namespace concave_distance

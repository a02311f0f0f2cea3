#pragma once

#include "genetic_state.h"

namespace concave_distance {

/// By fitness, shared among niches where the method says so, into work.selected.
void selectParents(GeneticState& state);
/// Mahfoud: everybody mates, or of a generation gap's share each at most once. Into work.selected.
void drawParents(GeneticState& state);
/// Couples of those selected become work.offspring; who does not mate is its parent's copy.
void mateCouples(GeneticState& state);
void mutateOffspring(GeneticState& state);
/// New individuals stay where they are, to be descended later.
void evaluateOffspring(GeneticState& state);
/// New individuals are settled; when the budget is spent, they are their parents' copies again.
void settleOffspring(GeneticState& state);

}  // namespace concave_distance

#pragma once

#include <cstdint>

#include "first_guess.h"
#include "thesis/src/annealing/annealing_parameters.h"
#include "thesis/src/genetic/comb_ga_parameters.h"

namespace concave_distance::evaluation {

/// What a row's parameters are before its own are read.
enum class RowBase : std::uint8_t {
  Thesis,   ///< the thesis's algorithm and nothing else
  Ours,     ///< with this package's operators (GeneticParameters(), AnnealingParameters())
  Shipped,  ///< what a pair's tracker searches with in a first cycle (TrackerParameters().cold)
  /// The same, and along a motion what it searches with in each further cycle (TrackerParameters().warm).
  ShippedCycles
};

/// comb-GA as the thesis has it: no elite, no exchange of genes, no immigrants, niches are not conserved, no
/// epsilon in the fitness; each gene mutates with p_m, to a random node (Carretero, sec. 3.3.2.c); both
/// children near the fitter parent (sec. 3.3.2.b); descents after mutation and not before the first selection
/// (fig. 2.13); mating restriction with sharing only (4.7), and strict (4.6.3).
CombGaParameters thesisGeneticParameters(NichingScheme scheme);

/// comb-SA as the thesis has it: random moves with variable displacement (sec. 5.3.1.b), no new points
/// between them.
AnnealingParameters thesisAnnealingParameters();

/// (6.7), (6.8) alone: a niche whose share is rounded to nothing is not handed on.
FirstGuess thesisFirstGuess();

/// What a warm cycle of a tracker begins with, but for what it has followed and kept.
FirstGuess shippedFirstGuess();

}  // namespace concave_distance::evaluation

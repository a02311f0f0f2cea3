#include "row_bases.h"

#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance::evaluation {

CombGaParameters thesisGeneticParameters(NichingScheme scheme) {
  CombGaParameters parameters;
  parameters.scheme = scheme;
  parameters.mutation = MutationMethod::RandomNodes;
  parameters.mating = MatingMethod::MeshNearFitter;
  parameters.mating_restriction = scheme == NichingScheme::Sharing;
  parameters.strict_mating_restriction = true;
  parameters.descend_first_population = false;
  parameters.exchange_probability = 0.0;
  parameters.random_immigrants = 0;
  parameters.elite_count = 0;
  parameters.conserve_niches = false;
  parameters.fitness_epsilon = 0.0;
  return parameters;
}

AnnealingParameters thesisAnnealingParameters() {
  AnnealingParameters parameters;
  parameters.new_point_probability = 0.0;
  return parameters;
}

FirstGuess thesisFirstGuess() {
  FirstGuess guess;
  guess.inheritance.one_each = false;
  return guess;
}

FirstGuess shippedFirstGuess() {
  const TrackerParameters shipped;
  FirstGuess guess;
  guess.inheritance.per_niche = shipped.inherited_per_niche;
  guess.inheritance.limit = shipped.inherited_limit;
  guess.random_starts = shipped.random_starts;
  return guess;
}

}  // namespace concave_distance::evaluation

#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace concave_distance {

/// Keeps several niches in a population.
enum class NichingMethod : std::uint8_t {
  Sharing,
  DeterministicCrowding  ///< Mahfoud's: no selection but the contest with the parents
};

/// Every parameter of the niched genetic algorithm (Carretero, ch. 3 and 4). Lengths in metres.
struct GeneticParameters {
  std::uint32_t population_size = 100;         ///< N_pop, even, >= 2
  std::uint32_t max_generations = 30;          ///< G_max
  double crossover_probability = 0.6;          ///< p_x
  std::optional<double> mutation_probability;  ///< p_m; empty: 1 / N_pop (Table 5.22)
  NichingMethod niching = NichingMethod::Sharing;
  std::optional<double> sharing_radius;  ///< sigma_s; empty: automaticRadii()
  double sharing_exponent = 1.0;         ///< alpha_s
  /// epsilon of the potential fitness 1 / (d^2 + epsilon^2), as a share of the longer of both grids' maximum
  /// edge lengths: differences of distance below it are the grid's. Selection and inheritance use the same.
  /// The thesis has none: 0.
  double fitness_epsilon = 1.0;
  std::optional<double> mating_radius;  ///< sigma_m; empty: 1.25 sigma_s
  bool mating_restriction = true;
  /// Share of the couples whose children, instead of standing between their parents, each take one node from
  /// their parent and the other from any local minimum met so far. A niche is a pair of places, one on each
  /// body; a place that is part of one niche is likely to be part of another.
  double exchange_probability = 0.8;
  std::optional<double> niche_radius;  ///< sigma_n; empty: sigma_s
  /// Random individuals tried in each generation; one that stands where nobody does takes a seat of the most
  /// crowded place (random immigrants, Grefenstette 1992): what no parents lead to is found all the same.
  std::uint32_t random_immigrants = 5;
  std::uint32_t elite_count = 1;  ///< best individuals that always survive
  /// With sharing the best of every niche (greedy identification with sigma_n) survives too, as long as these
  /// take no more than half of the population: species conservation (Li, Balazs, Parks and Clarkson 2002).
  /// Sampling loses niches that expect less than one individual.
  bool conserve_niches = true;
  /// No further descent once this many node pairs have been evaluated; what is left of the generation keeps
  /// its parents, and the run ends. 0: no limit.
  std::uint64_t evaluation_limit = 0;

  /// @throws Error naming the parameter, the value seen and the allowed range
  void validate(const std::string& where) const;
};

/// The three radii of niching, mesh distance over both bodies (Delta, Carretero eq. (4.5)), metres.
struct NicheRadii {
  double sharing;
  double mating;
  double niche;
};

}  // namespace concave_distance

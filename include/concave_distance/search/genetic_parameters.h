#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace concave_distance {

/// The parameters of the niched genetic algorithm (Carretero, ch. 3 and 4). Lengths in metres.
struct GeneticParameters {
  std::uint32_t population_size = 100;         ///< N_pop, even, >= 2
  std::uint32_t max_generations = 30;          ///< G_max
  double crossover_probability = 0.6;          ///< p_x
  std::optional<double> mutation_probability;  ///< p_m; empty: 1 / N_pop (Table 5.22)
  std::optional<double> sharing_radius;        ///< sigma_s; empty: automaticRadii()
  std::optional<double> mating_radius;         ///< sigma_m; empty: 1.25 sigma_s
  /// Share of the couples whose children, instead of standing between their parents, each take one node from
  /// their parent and the other from any local minimum met so far. A niche is a pair of places, one on each
  /// body; a place that is part of one niche is likely to be part of another.
  double exchange_probability = 0.8;
  std::optional<double> niche_radius;  ///< sigma_n; empty: sigma_s
  /// Random individuals tried in each generation; one that stands where nobody does takes a seat of the most
  /// crowded place (random immigrants, Grefenstette 1992): what no parents lead to is found all the same.
  std::uint32_t random_immigrants = 5;

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

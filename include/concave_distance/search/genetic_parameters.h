#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "concave_distance/base/selection_method.h"
#include "concave_distance/search/descent_moves.h"

namespace concave_distance {

enum class MatingMethod : std::uint8_t {
  Mesh,            ///< children on all of the path between the parents
  MeshNearFitter,  ///< the thesis's: both within a radius of the fitter parent (Carretero, sec. 3.3.2.b)
  Phenotypic,
  Genotypic
};
enum class NichingMethod : std::uint8_t {
  None,
  Sharing,
  DynamicSharing,
  DeterministicCrowding,  ///< Mahfoud's: no selection but the contest with the parents
  /// The thesis's (Carretero, fig. 4.4): parents are selected as without niching, and children compete with
  /// them before mutation and descent.
  DeterministicCrowdingWithSelection,
  SimpleCrowding
};
/// Says what becomes of a new individual (Carretero, sec. 3.1.5, 5.2.1.a).
enum class LocalOptimization : std::uint8_t {
  None,        ///< -nl: it stays where it is
  Lamarckian,  ///< -wl: it moves to the local minimum that it descends to
  Baldwinian   ///< it stays where it is and counts as fit as that local minimum
};

/// How a mutation moves an individual (Carretero, sec. 3.3.2.c).
enum class MutationMethod : std::uint8_t {
  /// An individual is moved with probability p_m: one gene or both go a part of the way to a random node.
  RandomMove,
  /// Each gene becomes a random node with probability p_m: the text's x_rand itself, to which the thesis's
  /// figures are closer than to what lies between it and x.
  RandomNodes
};

/// How a quantity falls over the generations (Carretero, sec. 3.3.2.c). A temperature T falls by one a
/// generation, from G_max in the first to 1 in the last.
enum class Cooling : std::uint8_t {
  Constant,
  Linear,       ///< T / G_max
  Exponential,  ///< exp(-5 g / G_max) (sec. 2.3.2.c: "exponentially decreases")
  /// p_b = exp(-E / (k_B T)) (2.6) for an energy E of k_B G_max, over that of the first generation.
  Boltzmann
};

/// Every parameter of the combinatorial genetic algorithm (Carretero, ch. 3 and 4). Lengths in metres. A
/// scene file and the node have those that geneticParameters() lists, experiments all.
struct GeneticParameters {
  std::uint32_t population_size = 100;  ///< N_pop, even, >= 2
  std::uint32_t max_generations = 30;   ///< G_max
  double crossover_probability = 0.6;   ///< p_x
  MutationMethod mutation = MutationMethod::RandomMove;
  std::optional<double> mutation_probability;      ///< p_m; empty: 1 / N_pop (Table 5.22)
  double final_mutation_probability_factor = 1.0;  ///< variable mutation rate: p_m ends at this multiple
  Cooling mutation_probability_cooling = Cooling::Linear;  ///< how it gets there
  /// r_max of random moves, mesh distance; empty: anywhere on the shell, or when it cools, at first the
  /// longer of both bodies' geodesic extents.
  std::optional<double> mutation_radius;
  Cooling mutation_radius_cooling = Cooling::Constant;
  SelectionMethod selection = SelectionMethod::StochasticUniversalSampling;
  MatingMethod mating = MatingMethod::Mesh;
  NichingMethod niching = NichingMethod::Sharing;
  LocalOptimization local_optimization = LocalOptimization::Lamarckian;
  DescentMoves descent_moves = DescentMoves::OneNode;
  /// Whether the first population is descended before parents are selected from it. The thesis descends after
  /// mutation only (Carretero, fig. 2.13), but for populations that inherit (sec. 6.2.2).
  bool descend_first_population = true;
  std::optional<double> sharing_radius;  ///< sigma_s; empty: automaticRadii()
  double sharing_exponent = 1.0;         ///< alpha_s
  /// epsilon of the potential fitness 1 / (d^2 + epsilon^2), as a share of the longer of both grids' maximum
  /// edge lengths: differences of distance below it are the grid's. Selection and inheritance use the same.
  /// The thesis has none: 0.
  double fitness_epsilon = 1.0;
  std::uint32_t dynamic_niche_limit = 20;  ///< most peaks of dynamic sharing
  std::optional<double> mating_radius;     ///< sigma_m; empty: 1.25 sigma_s
  bool mating_restriction = true;
  /// Who finds no partner within the mating radius does not mate (Carretero, sec. 4.6.3); else, after two
  /// tries, with anybody (Deb and Goldberg 1989).
  bool strict_mating_restriction = false;
  /// Share of the couples whose children, instead of standing between their parents, each take one node from
  /// their parent and the other from any local minimum met so far (without local optimisation: from the other
  /// parent). A niche is a pair of places, one on each body; a place that is part of one niche is likely to
  /// be part of another. 0 for the thesis's own rows.
  double exchange_probability = 0.8;
  std::optional<double> niche_radius;  ///< sigma_n; empty: sigma_s
  std::uint32_t crowding_factor = 3;   ///< C_f of simple crowding
  double generation_gap = 1.0;         ///< share of the population replaced a generation, (0, 1]
  /// Random individuals tried in each generation; one that stands where nobody does takes a seat of the most
  /// crowded place (random immigrants, Grefenstette 1992): what no parents lead to is found all the same.
  /// 0 for the thesis's own rows.
  std::uint32_t random_immigrants = 5;
  std::uint32_t elite_count = 1;  ///< best individuals that always survive
  /// With sharing and dynamic sharing: the best of every niche (greedy identification with sigma_n) survives
  /// too, as long as these take no more than half of the population: species conservation (Li, Balazs, Parks
  /// and Clarkson 2002). Sampling loses niches that expect less than one individual. Off for the thesis's
  /// own rows.
  bool conserve_niches = true;
  /// Stop when the best and the set of niches have not changed for this many generations; 0: never early.
  std::uint32_t convergence_generations = 0;
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

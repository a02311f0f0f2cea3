#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "thesis/src/genetic/parent_selection.h"

namespace concave_distance {

/// How a feasible point moves towards its counterpart.
enum class LocalMove : std::uint8_t {
  MoveCloser,  ///< by q_min, which stays inside (Carretero, sec. 2.1.5)
  /// By a share of the way (ContinuousPoint::stride, halved and more when it fails), then back onto the body
  /// by projection onto violated planes: slides along surfaces, edges and into corners, where q_min is 0.
  SlideCloser
};

/// How an infeasible point comes back.
enum class RepairMethod : std::uint8_t {
  SafeMoveAway,  ///< k_r q_min away from its counterpart, taken back when f worsens: the thesis's choice
  MoveAway,      ///< the same, kept whatever f says
  Project        ///< straight onto the furthest violated plane; taken back when f worsens
};

/// The local step (Carretero, sec. 2.1.5, fig. 2.5). Defaults are the thesis's.
struct LocalStepParameters {
  bool enabled = true;  ///< -wl / -nl
  LocalMove move = LocalMove::MoveCloser;
  RepairMethod repair = RepairMethod::SafeMoveAway;
  double repair_scale = 1.5;      ///< k_r of moving away, > 0
  std::uint32_t repeats = 1;      ///< steps each time a point is optimised, >= 1
  std::uint32_t projections = 8;  ///< most planes a sliding or projected point is put onto one after another
};

/// How a trial point is moved at random (Carretero, sec. 2.2.3).
enum class RandomMove : std::uint8_t {
  Cartesian,       ///< one coordinate anew within its bounding box (2.7), (2.8)
  RandomDirection  ///< both points, each up to half its box's diagonal in its own direction (2.9)-(2.11)
};

enum class ContinuousMating : std::uint8_t {
  LinearScaling,    ///< a random point on the line between the parents (2.14)
  FitnessWeighted,  ///< nearer to the fitter parent (2.15); the second child between the first and that
                    ///< parent
  /// (2.15) to the letter, which gives both children the same place.
  FitnessWeightedTwice
};

enum class InitialPoints : std::uint8_t {
  BoundingBoxes,  ///< uniform in both boxes (Carretero, sec. 2.1.6)
  Projected       ///< the same, then put onto the body by projections: starts on surfaces, or inside
};

/// Every parameter of cont-GA (Carretero, ch. 2); the defaults are those of table 5.1, the thesis's
/// algorithm.
struct ContinuousGeneticParameters {
  std::uint32_t population_size = 80;          ///< N_pop, even, >= 2
  std::uint32_t max_generations = 100;         ///< G_max
  double crossover_probability = 0.6;          ///< p_x
  std::optional<double> mutation_probability;  ///< p_m per individual; empty: 1 / N_pop
  double penalty_weight = 10.0;                ///< k_p, metres: scale it with the bodies
  SelectionMethod selection = SelectionMethod::StochasticUniversalSampling;
  ContinuousMating mating = ContinuousMating::FitnessWeighted;
  RandomMove mutation = RandomMove::RandomDirection;
  /// Mutations shrink over the generations. (2.12) and (2.13) scale by the p_b of annealing, which a GA has
  /// none of: here p_b = exp(-5 g / G_max).
  bool variable_displacement = true;
  LocalStepParameters local_step;

  // What the thesis does not have; the defaults leave it out.
  InitialPoints initial_points = InitialPoints::BoundingBoxes;
  std::uint32_t elite_count = 0;  ///< best individuals that always survive
  /// A child takes the seat of its closer parent, if it is better (Mahfoud 1992); no other selection.
  bool deterministic_crowding = false;
  std::uint32_t random_immigrants = 0;  ///< random individuals a generation, in the seats of the worst
  bool prefer_feasible = false;     ///< the run's best is the best feasible point, as long as there is one
  std::uint32_t final_repeats = 0;  ///< local steps on the run's best at the end (sequential hybrid)

  /// @throws Error naming the parameter, the value seen and the allowed range
  void validate(const std::string& where) const;
};

/// Table 5.1 (the defaults), and with the switches that measurably help (thesis/doc/continuous.md).
ContinuousGeneticParameters thesisContinuousGenetic();
ContinuousGeneticParameters improvedContinuousGenetic();

/// Every parameter of cont-SA (Carretero, sec. 2.2); the defaults are those of table 2.4.
struct ContinuousAnnealingParameters {
  std::uint32_t initial_temperature = 5000;  ///< t_ini: one iteration a degree
  double boltzmann_constant = 0.0005;        ///< k_B; k_B t is a squared length: scale it with the bodies
  double penalty_weight = 10.0;              ///< k_p, metres
  RandomMove move = RandomMove::RandomDirection;
  /// Scale moves by the last Boltzmann factor p_b (2.6), at most 1 (2.12), (2.13).
  bool variable_displacement = true;
  LocalStepParameters local_step;

  // What the thesis does not have.
  InitialPoints initial_points = InitialPoints::BoundingBoxes;
  bool prefer_feasible = false;
  std::uint32_t final_repeats = 0;

  /// @throws Error naming the parameter, the value seen and the allowed range
  void validate(const std::string& where) const;
};

ContinuousAnnealingParameters thesisContinuousAnnealing();
ContinuousAnnealingParameters improvedContinuousAnnealing();

}  // namespace concave_distance

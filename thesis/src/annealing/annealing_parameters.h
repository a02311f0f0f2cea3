#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "thesis/src/genetic/descent_moves.h"

namespace concave_distance {

enum class AnnealingMove : std::uint8_t {
  NewPoint,   ///< a random node pair from anywhere (Carretero, sec. 3.2.2.a)
  RandomMove  ///< along the surface from where the trial point is (sec. 3.2.2.b)
};

/// Every parameter of combinatorial simulated annealing, comb-SA (Carretero, sec. 2.2, 3.2).
struct AnnealingParameters {
  /// t_ini: the temperature falls by one an iteration, so that this is the number of iterations as well.
  std::uint32_t initial_temperature = 2500;
  /// k_B of eq. (2.6), square metres for each unit of temperature: scale it with the bodies.
  double boltzmann_constant = 1e-4;
  AnnealingMove move = AnnealingMove::RandomMove;
  /// r_max, mesh distance, metres; empty: the longer of both bodies' geodesic extents.
  std::optional<double> move_radius;
  bool variable_displacement = true;  ///< r_max is scaled by the last acceptance probability (sec. 3.2.2.c)
  /// Share of the iterations of RandomMove that try a new point instead: a move that shrinks with p_b does
  /// not leave the valley that the trial point is in.
  double new_point_probability = 0.35;
  bool local_optimization = true;  ///< every new trial point is descended (-wl / -nl)
  DescentMoves descent_moves = DescentMoves::OneNode;
  /// No further iteration once this many node pairs have been evaluated. 0: no limit.
  std::uint64_t evaluation_limit = 0;

  /// @throws Error naming the parameter, the value seen and the allowed range
  void validate(const std::string& where) const;
};

}  // namespace concave_distance

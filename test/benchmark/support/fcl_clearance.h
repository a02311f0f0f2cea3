#pragma once

#include <cstddef>

#include "benchmark/support/motion_stage.h"

namespace concave_distance::benchmark {

/// The least distance of a motion, from below and from above.
struct ClearanceBracket {
  double lower = 0.0;         ///< metres, proven by the motion's bound and FCL's distances
  double upper = 0.0;         ///< metres, occurs at `time`
  double time = 0.0;          ///< seconds
  std::size_t distances = 0;  ///< that FCL was asked for
  bool is_whole = true;       ///< false: it ended with its limit
};

/// Steps so short that between two of them no pair can come nearer than `tolerance` below their distances.
/// FCL is asked where bodies' boxes are nearer than the least so far, which it is given as a seed; every 32nd
/// step first. @param most distances, after which it ends
ClearanceBracket clearanceByFixedSteps(const MotionStage& stage, const Motion& motion, double tolerance,
                                       std::size_t most);

/// Adaptive bisection (Schwarzer, Saha and Latombe 2005), for the least distance instead of yes or no: a
/// piece of the motion and a pair wait in the order of their bound, half of (distances at both ends - path
/// between them); the first in line is asked of FCL where its path is short, or halved, until no bound is
/// below the least by more than `tolerance`.
ClearanceBracket clearanceByBisection(const MotionStage& stage, const Motion& motion, double tolerance,
                                      std::size_t most);

}  // namespace concave_distance::benchmark

#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "benchmark/support/motion_stage.h"

namespace concave_distance::benchmark {

struct Sampling {
  double step = 1e-3;      ///< metres that no point exceeds from sample to sample, by the motion's bound
  double threshold = 0.0;  ///< metres, of Sampled::first_below; 0: none is looked for
  bool refines = true;     ///< by golden section around the nearest samples
  double ceiling = 1e3;    ///< metres; larger distances are not looked for, and the least is this then
};

/// Holds what sampling sees of a motion. Each number occurs in the motion; the truth may be less.
struct Sampled {
  double least = std::numeric_limits<double>::infinity();        ///< metres
  double least_time = 0.0;                                       ///< seconds
  std::size_t pair = 0;                                          ///< of the stage
  double first_below = std::numeric_limits<double>::infinity();  ///< seconds; never: infinity
  std::size_t samples = 0;
  std::size_t distances = 0;  ///< samples at which FCL was asked
};

/// Samples a motion densely by FCL's distance. What bodies cannot do from their boxes is not asked of FCL; no
/// bound of the motion is used but for the number of samples.
Sampled sampleMotion(const MotionStage& stage, const Motion& motion, const Sampling& sampling);

/// Returns whether the samples of fixed steps meet a contact.
/// @param step rad, of the joint that turns most; infinity: the waypoints alone
bool touchesAtSteps(const MotionStage& stage, const Motion& motion, double step);

/// Seconds of the samples with at most `step` metres of motion from one to the next.
std::vector<double> sampleTimes(const MotionStage& stage, const Motion& motion, double step);

}  // namespace concave_distance::benchmark

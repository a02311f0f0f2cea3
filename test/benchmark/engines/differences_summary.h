#pragma once

#include <string>
#include <vector>

#include "benchmark/engines/engine_differences.h"

namespace concave_distance::benchmark {

inline constexpr double kRate = 1000.0;  // samples a second that figures are taken from

struct Run {
  std::string engine;
  Trajectory trajectory;
  bool variant = false;  ///< in the summary only
};

/// What a scene's trajectories come to beside its closed forms, on the standard output.
void printBall(const ComparedScene& scene, const std::vector<Run>& runs);
void printSlope(const ComparedScene& scene, const std::vector<Run>& runs);
void printFeet(const ComparedScene& scene, const std::vector<Run>& runs);

}  // namespace concave_distance::benchmark

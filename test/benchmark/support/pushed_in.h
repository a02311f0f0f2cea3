#pragma once

#include <algorithm>
#include <vector>

#include "benchmark/support/benchmark_pairs.h"
#include "concave_distance/tracking/pair_tracker.h"

namespace concave_distance::benchmark {

inline constexpr double kUsualDepth = 2e-3;  ///< of the smaller diameter

/// The pose with B pushed into A until the place that was nearest is `depth` deep, metres.
inline Eigen::Isometry3d pushedIn(const BenchmarkPair& pair, const Eigen::Isometry3d& pose, double depth) {
  TrackerParameters parameters;
  parameters.niches_wanted = false;
  const PairSolution solution = solveOnce(pair.name, pair.a, pair.b, parameters, pose);
  const Eigen::Vector3d displacement = solution.point_a_in_a - solution.point_b_in_a;
  return Eigen::Translation3d(displacement * (1.0 + depth / solution.distance)) * pose;
}

/// `count` instants along the motion.
inline std::vector<Eigen::Isometry3d> posesApart(const BenchmarkPair& pair, int count) {
  std::vector<Eigen::Isometry3d> poses;
  for (int k = 0; k < count; ++k) poses.push_back(pair.motion(static_cast<double>(k) / (count - 1)));
  return poses;
}

/// The same, pushed into each other. @param depth in smaller diameters
inline std::vector<Eigen::Isometry3d> posesInContact(const BenchmarkPair& pair, int count, double depth) {
  std::vector<Eigen::Isometry3d> poses = posesApart(pair, count);
  const double metres = depth * std::min(pair.a->diameter(), pair.b->diameter());
  for (Eigen::Isometry3d& pose : poses) pose = pushedIn(pair, pose, metres);
  return poses;
}

}  // namespace concave_distance::benchmark

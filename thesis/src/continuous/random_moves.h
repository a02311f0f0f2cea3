#pragma once

#include <Eigen/Geometry>

#include "base/random_engine.h"
#include "continuous_parameters.h"

namespace concave_distance {

/// The two points of a trial point, each in its body's frame, metres.
struct PointPair {
  Eigen::Vector3d point_a;
  Eigen::Vector3d point_b;
};

/// Uniform in both boxes (Carretero, sec. 2.1.6).
PointPair randomPair(const Eigen::AlignedBox3d& box_a, const Eigen::AlignedBox3d& box_b,
                     RandomEngine& engine);

/// A random move of a trial point (Carretero, sec. 2.2.3).
/// @param scale p_b of (2.12), (2.13), in [0, 1]; 1 for a fixed displacement, (2.7)-(2.11)
PointPair moveRandomly(RandomMove move, const PointPair& x, const Eigen::AlignedBox3d& box_a,
                       const Eigen::AlignedBox3d& box_b, double scale, RandomEngine& engine);

/// p_b of (2.6) at most 1: exp((f_before - f_now) / (k_B t)); 1 on improvement, where (2.6) exceeds it, and 0
/// for a worse point at temperature 0.
double boltzmannFactor(double f_before, double f_now, double boltzmann_constant, double temperature);

}  // namespace concave_distance

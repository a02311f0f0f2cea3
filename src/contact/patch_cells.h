#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace concave_distance {

/// Size, metres, of the cells of a patch of this area; `now`, where that still fits. 0: none yet
double cellSize(double area, double now);

/// The axis that the push is nearest to, with its sign, and a cell of the plane across it: the two walls of a
/// slot do not share a cell, the two surfaces of one contact do. Places and pushes at round numbers are
/// common, so that no limit between cells is at one: else rounding would decide.
std::uint64_t cellOf(const Eigen::Vector3d& point, const Eigen::Vector3d& push, double size);

/// The axis with its sign.
inline std::uint64_t directionOf(std::uint64_t cell) {
  return cell >> 60U;
}

}  // namespace concave_distance

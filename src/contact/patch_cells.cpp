#include "patch_cells.h"

#include <algorithm>
#include <cmath>

namespace concave_distance {
namespace {

// Cells along the width of a patch, about.
constexpr double kCellsAcross = 4.0;
// Cells change their size when they are this much too large or too small.
constexpr double kCellSlack = 2.5;

}  // namespace

double cellSize(double area, double now) {
  const double wanted = std::sqrt(area) / kCellsAcross;
  if (now > wanted / kCellSlack && now < wanted * kCellSlack) return now;
  return std::exp2(std::round(std::log2(wanted)));
}

std::uint64_t cellOf(const Eigen::Vector3d& point, const Eigen::Vector3d& push, double size) {
  constexpr double kOffset = 0.381966;
  constexpr std::int64_t kHalf = 1 << 29;
  Eigen::Index axis = 0;
  push.cwiseAbs().cwiseProduct(Eigen::Vector3d(1.0, 1.03, 1.07)).maxCoeff(&axis);
  std::uint64_t key = static_cast<std::uint64_t>(2 * axis + (push[axis] < 0.0 ? 1 : 0));
  for (const Eigen::Index across : {(axis + 1) % 3, (axis + 2) % 3}) {
    const double cell = std::clamp(std::floor(point[across] / size + kOffset), -static_cast<double>(kHalf),
                                   static_cast<double>(kHalf - 1));
    key = key << 30U | static_cast<std::uint64_t>(static_cast<std::int64_t>(cell) + kHalf);
  }
  return key;
}

}  // namespace concave_distance

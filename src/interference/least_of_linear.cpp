#include "least_of_linear.h"

#include <limits>
#include <utility>

namespace concave_distance::detail {

LeastOfLinear::Peak LeastOfLinear::peak() {
  Peak best{-std::numeric_limits<double>::infinity(), Eigen::Vector3d::Constant(1.0 / 3.0)};
  for (std::size_t i = 0; i < count_; ++i) {
    if (functions_[i].maxCoeff() <= best.value) continue;
    polygon_.count = 3;
    for (Eigen::Index k = 0; k < 3; ++k)
      polygon_.corners[static_cast<std::size_t>(k)] = Eigen::Vector3d::Unit(k);
    for (std::size_t j = 0; j < count_ && polygon_.count > 0; ++j) {
      if (j != i) cutOff(functions_[i], functions_[j]);
    }
    for (std::size_t k = 0; k < polygon_.count; ++k) {
      const double value = functions_[i].dot(polygon_.corners[k]);
      if (value > best.value) best = {value, polygon_.corners[k]};
    }
  }
  return best;
}

// Cuts off where `other` is lower.
void LeastOfLinear::cutOff(const Eigen::Vector3d& function, const Eigen::Vector3d& other) {
  const Eigen::Vector3d above = other - function;
  if (above.minCoeff() >= 0.0) return;
  cut_.count = 0;
  for (std::size_t k = 0; k < polygon_.count; ++k) {
    const Eigen::Vector3d& from = polygon_.corners[k];
    const Eigen::Vector3d& to = polygon_.corners[(k + 1) % polygon_.count];
    const double at_from = above.dot(from);
    const double at_to = above.dot(to);
    if (at_from >= 0.0) cut_.corners[cut_.count++] = from;
    const bool crosses = (at_from > 0.0 && at_to < 0.0) || (at_from < 0.0 && at_to > 0.0);
    if (crosses) cut_.corners[cut_.count++] = from + at_from / (at_from - at_to) * (to - from);
    if (cut_.count + 2 > cut_.corners.size()) break;  // roundings alone make so many corners
  }
  std::swap(polygon_, cut_);
}

}  // namespace concave_distance::detail

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace concave_distance::benchmark {

/// The value below which `share` of the sample lies (nearest rank); NaN for an empty sample.
inline double percentile(std::vector<double> sample, double share) {
  if (sample.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::sort(sample.begin(), sample.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sample.size())));
  return sample[std::min(sample.size() - 1, rank > 0 ? rank - 1 : 0)];
}

inline double median(const std::vector<double>& sample) {
  return percentile(sample, 0.5);
}

inline double mean(const std::vector<double>& sample) {
  double sum = 0.0;
  for (const double x : sample) {
    sum += x;
  }
  return sum / static_cast<double>(sample.size());
}

}  // namespace concave_distance::benchmark

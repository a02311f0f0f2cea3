#include "selection.h"

#include <numeric>
#include <utility>

namespace concave_distance {

void stochasticUniversalSampling(const std::vector<double>& weights, std::uint32_t count,
                                 RandomEngine& engine, std::vector<std::uint32_t>& selected) {
  selected.clear();
  const double step = std::accumulate(weights.begin(), weights.end(), 0.0) / count;
  const double start = uniformUnit(engine) * step;
  double upper_end = weights[0];
  std::uint32_t individual = 0;
  for (std::uint32_t pointer = 0; pointer < count; ++pointer) {
    // Multiplied and not summed, so that rounding does not grow with the count; what it leaves at the end of
    // the wheel belongs to the last individual with a weight.
    const double position = start + pointer * step;
    while (position >= upper_end && individual + 1 < weights.size()) {
      upper_end += weights[++individual];
    }
    selected.push_back(individual);
  }
}

void shuffle(std::vector<std::uint32_t>& values, RandomEngine& engine) {
  for (auto left = static_cast<std::uint32_t>(values.size()); left > 1; --left) {
    std::swap(values[left - 1], values[uniformIndex(engine, left)]);
  }
}

}  // namespace concave_distance

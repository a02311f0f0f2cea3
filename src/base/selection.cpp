#include "selection.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace concave_distance {

void select(SelectionMethod method, const std::vector<double>& weights, std::uint32_t count,
            RandomEngine& engine, std::vector<double>& wheel, std::vector<std::uint32_t>& selected) {
  switch (method) {
    case SelectionMethod::StochasticUniversalSampling:
      stochasticUniversalSampling(weights, count, engine, selected);
      return;
    case SelectionMethod::Roulette:
      rouletteWheel(weights, count, engine, wheel, selected);
      return;
  }
}

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

void rouletteWheel(const std::vector<double>& weights, std::uint32_t count, RandomEngine& engine,
                   std::vector<double>& wheel, std::vector<std::uint32_t>& selected) {
  wheel.resize(weights.size());
  std::partial_sum(weights.begin(), weights.end(), wheel.begin());
  selected.clear();
  for (std::uint32_t spin = 0; spin < count; ++spin) {
    const double position = uniformUnit(engine) * wheel.back();
    const auto slice = std::upper_bound(wheel.begin(), wheel.end(), position);
    selected.push_back(static_cast<std::uint32_t>(
        std::min<std::ptrdiff_t>(slice - wheel.begin(), static_cast<std::ptrdiff_t>(wheel.size()) - 1)));
  }
}

void shuffle(std::vector<std::uint32_t>& values, RandomEngine& engine) {
  for (auto left = static_cast<std::uint32_t>(values.size()); left > 1; --left) {
    std::swap(values[left - 1], values[uniformIndex(engine, left)]);
  }
}

}  // namespace concave_distance

#include "parent_selection.h"

#include <algorithm>
#include <numeric>

#include "search/selection.h"

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

}  // namespace concave_distance

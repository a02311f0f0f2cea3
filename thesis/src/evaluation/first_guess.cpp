#include "first_guess.h"

namespace concave_distance::evaluation {

void inheritFixedCount(const std::vector<TrialPoint>& niches, std::uint32_t count,
                       std::vector<TrialPoint>& population) {
  population.clear();
  for (const TrialPoint& niche : niches) population.insert(population.end(), count, niche);
}

}  // namespace concave_distance::evaluation

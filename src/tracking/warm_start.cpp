#include "warm_start.h"

#include <algorithm>
#include <cmath>

#include "search/sharing.h"

namespace concave_distance {

void inherit(const std::vector<TrialPoint>& niches, const Inheritance& inheritance, double epsilon,
             std::vector<TrialPoint>& population, std::vector<double>& scratch) {
  population.clear();
  if (niches.empty()) {
    return;
  }
  const auto niche_count = static_cast<double>(niches.size());
  const auto total = static_cast<std::size_t>(
      std::min(std::floor(inheritance.per_niche * niche_count), static_cast<double>(inheritance.limit)));
  const std::size_t one_each = inheritance.one_each ? std::min(total, niches.size()) : 0;
  for (std::size_t i = 0; i < one_each; ++i) {
    population.push_back(niches[i]);
  }
  const std::size_t to_share = total - one_each;
  if (to_share == 0) {
    return;
  }
  double sum = 0.0;
  for (const TrialPoint& niche : niches) {
    sum += potentialFitness(niche.squared_distance, epsilon);
  }
  scratch.clear();
  std::size_t given = 0;
  for (const TrialPoint& niche : niches) {
    const double phi = potentialFitness(niche.squared_distance, epsilon);
    const double share = static_cast<double>(to_share) * (phi / sum);
    const auto whole = static_cast<std::size_t>(share);
    population.insert(population.end(), std::min(whole, to_share - given), niche);
    given += std::min(whole, to_share - given);
    scratch.push_back(share - std::floor(share));
  }
  while (given < to_share) {
    const auto largest = std::max_element(scratch.begin(), scratch.end());
    population.push_back(niches[static_cast<std::size_t>(largest - scratch.begin())]);
    *largest = -1.0;
    ++given;
  }
}

}  // namespace concave_distance

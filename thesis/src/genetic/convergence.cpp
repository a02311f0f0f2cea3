#include "convergence.h"

namespace concave_distance {

void ConvergenceCheck::reset(std::uint32_t generations) {
  generations_ = generations;
  unchanged_ = 0;
  last_niches_.clear();
}

bool ConvergenceCheck::update(const Census& census, double niche_radius, TrialPointTable& places,
                              PairMetric& metric) {
  if (generations_ == 0) {
    return false;
  }
  nichePeaks(census, niche_radius, places, metric, order_, niches_);
  unchanged_ = niches_ == last_niches_ ? unchanged_ + 1 : 0;
  niches_.swap(last_niches_);
  return unchanged_ >= generations_;
}

}  // namespace concave_distance

#pragma once

#include <algorithm>
#include <vector>

#include "distance/niches/niche_decider.h"

namespace concave_distance::test {

/// Distances of what was judged a niche, ascending, metres.
inline std::vector<double> nichesOf(const concave_distance::detail::NicheDecider& decider) {
  using concave_distance::detail::NicheDecider;
  std::vector<double> distances;
  for (const NicheDecider::Judged& judged : decider.judged()) {
    if (judged.decision == NicheDecider::Decision::Niche) distances.push_back(judged.candidate.distance);
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

}  // namespace concave_distance::test

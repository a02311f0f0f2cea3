#pragma once

#include <algorithm>
#include <vector>

#include "distance/niches/minima_verdicts.h"

namespace concave_distance::test {

/// Distances of what was judged a niche, ascending, metres.
inline std::vector<double> nichesOf(const concave_distance::detail::MinimaVerdicts& verdicts) {
  using concave_distance::detail::MinimaVerdicts;
  std::vector<double> distances;
  for (const MinimaVerdicts::Judged& judged : verdicts.judged()) {
    if (judged.verdict == MinimaVerdicts::Verdict::Niche) distances.push_back(judged.seed.distance);
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

}  // namespace concave_distance::test

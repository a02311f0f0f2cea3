#include "multi_start_descent.h"

#include "search/local_descent.h"
#include "search/mutation.h"

namespace concave_distance {

GeneticResult multiStartDescent(const PairObjective& objective, std::uint32_t descents, RandomEngine& engine,
                                SearchWorkspace& workspace, std::uint64_t evaluation_limit) {
  GeneticResult result;
  for (std::uint32_t i = 0; i < descents; ++i) {
    const TrialPoint minimum = descend(objective, randomTrialPoint(objective, engine), &workspace.basins,
                                       workspace.trail, result.cost);
    if (i == 0 || minimum < result.best) {
      result.best = minimum;
    }
    if (evaluation_limit != 0 && result.cost.evaluations >= evaluation_limit) {
      break;
    }
  }
  return result;
}

}  // namespace concave_distance

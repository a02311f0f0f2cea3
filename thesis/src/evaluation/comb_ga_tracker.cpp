#include "comb_ga_tracker.h"

#include <optional>

#include "thesis/src/genetic/comb_ga.h"

namespace concave_distance::evaluation {

CombGaTracker::CombGaTracker(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                             const std::shared_ptr<const BodyMesh>& b, const TrackerParameters& parameters,
                             const CombGaParameters& cold, const CombGaParameters& warm)
    : bodies_(a, b), cycle_(name, bodies_.a(), bodies_.b(), parameters, 0, bodies_.poseError()) {
  cycle_.search().replaceSearch(
      [cold, warm](GeneticState& state, const std::vector<TrialPoint>& inherited, bool as_warm) {
        CombGaParameters parameters = as_warm ? warm : cold;
        parameters.population_size = state.parameters.population_size;
        const GeneticResult result = combGa(state.objective, parameters, state.radii, inherited, state.engine,
                                            state.work, {}, state.limit, state.couples);
        if (parameters.local_optimization == LocalOptimization::None)
          state.work.basins.addMinimum(result.best);
        return result.cost;
      });
}

void CombGaTracker::update(const Eigen::Isometry3d& a_from_b, double time, PairSolution& solution) {
  const std::optional<Eigen::Isometry3d> pose = bodies_.isMoved() ? bodies_.poseOf(a_from_b) : std::nullopt;
  cycle_.update(pose ? *pose : a_from_b, time, solution);
  if (pose) bodies_.moveBack(a_from_b, solution);
}

}  // namespace concave_distance::evaluation

#include "genetic_state.h"

#include "local_descent.h"
#include "sharing.h"

namespace concave_distance {

GeneticState::GeneticState(const PairObjective& objective, const GeneticParameters& parameters,
                           const NicheRadii& radii, RandomEngine& engine, SearchWorkspace& work,
                           WorkLimit* limit, Couples couples)
    : objective(objective),
      parameters(parameters),
      radii(radii),
      engine(engine),
      work(work),
      limit(limit),
      couples(couples),
      epsilon(fitnessEpsilon(objective.bodyA(), objective.bodyB())) {}

void GeneticState::settle(TrialPoint& point, std::uint32_t& place) {
  point = descend(objective, point, &work.basins, work.trail, cost);
  place = work.places.placeOf(point);
}

}  // namespace concave_distance

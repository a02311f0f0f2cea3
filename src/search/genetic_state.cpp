#include "genetic_state.h"

#include "local_descent.h"
#include "reproduction.h"
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
      epsilon(fitnessEpsilon(parameters, objective.bodyA(), objective.bodyB())) {}

void GeneticState::settle(TrialPoint& point, std::uint32_t& place) {
  point = descend(objective, point, &work.basins, work.trail, cost);
  place = work.places.placeOf(point);
}

Children GeneticState::mate(const TrialPoint& parent_1, const TrialPoint& parent_2) {
  return concave_distance::mate(parent_1, parent_2, work.metric, radii.mating, engine);
}

void GeneticState::breed() {
  const bool crowds = parameters.niching == NichingMethod::DeterministicCrowding;
  if (crowds) {
    drawParents(*this);
  } else {
    selectParents(*this);
  }
  pairUp(*this);
  mateCouples(*this);
  mutateOffspring(*this);
  settleOffspring(*this);
  if (crowds) {
    compete(*this, &competePaired);
    takeSeats(*this, work.selected);
  } else {
    work.population.swap(work.offspring);
    work.population_places.swap(work.offspring_places);
  }
}

bool GeneticState::outOfBudget() const {
  if (limit != nullptr && limit->isOver()) return true;
  return parameters.evaluation_limit != 0 && cost.evaluations >= parameters.evaluation_limit;
}

}  // namespace concave_distance

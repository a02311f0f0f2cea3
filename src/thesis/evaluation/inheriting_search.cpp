#include "inheriting_search.h"

#include "search/automatic_radii.h"
#include "search/pair_objective.h"
#include "search/sharing.h"

namespace concave_distance::evaluation {

InheritingSearch::InheritingSearch(const GeneticParameters& parameters, const Inheritance& inheritance,
                                   const BodyMesh& a, const BodyMesh& b, std::uint64_t seed,
                                   SearchWorkspace& workspace)
    : parameters_(parameters),
      inheritance_(inheritance),
      a_(&a),
      b_(&b),
      engine_(seed),
      workspace_(&workspace),
      radii_(automaticRadii(a, b, parameters)) {}

GeneticResult InheritingSearch::search(const Eigen::Isometry3d& a_from_b) {
  const PairObjective objective(*a_, *b_, a_from_b);
  workspace_->basins.clear();
  const GeneticResult result =
      geneticSearch(objective, parameters_, radii_, inherited_, engine_, *workspace_);
  identifyNiches(workspace_->population, radii_.niche, workspace_->metric, workspace_->niches,
                 workspace_->order);
  known_.clear();
  for (const IdentifiedNiche& niche : workspace_->niches) known_.push_back(niche.best);
  inherit(known_, inheritance_, fitnessEpsilon(parameters_, *a_, *b_), inherited_, scratch_);
  return result;
}

}  // namespace concave_distance::evaluation

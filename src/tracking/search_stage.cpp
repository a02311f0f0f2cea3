#include "search_stage.h"

#include <algorithm>
#include <cstddef>

namespace concave_distance {
namespace {

/// So many of the known niches from `first` on, as node pairs at the minima below them.
void inheritNodePairs(const SearchStage& stage, std::size_t first, std::size_t count, SearchCost& cost) {
  const std::vector<NicheRecord>& records = stage.archive.records();
  stage.known.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const WitnessPair& witness = records[(first + i) % records.size()].niche.witness;
    const TrialPoint near = nodePairNear(stage.frame, witness);
    stage.known.push_back(stage.search.descendKnown(stage.frame, near, cost));
  }
}

void proposeAll(const SearchStage& stage, const std::vector<TrialPoint>& found, WorkLimit& limit) {
  for (std::size_t i = 0; i < found.size() && (i == 0 || !limit.isOver()); ++i) {
    const WitnessPair nodes = nodeWitness(stage.frame, found[i]);
    stage.niches.propose(stage.frame, stage.niches.refine(stage.frame, nodes));
  }
}

}  // namespace

void proposeMinima(const SearchStage& stage, const NicheSearch::Run& run, SearchCost& cost,
                   WorkLimit& limit) {
  stage.search.begin(stage.frame.a, stage.frame.b, stage.parameters);
  const std::size_t known = stage.archive.records().size();
  inheritNodePairs(stage, 0, std::min<std::size_t>(known, stage.parameters.inherited_limit), cost);
  proposeAll(stage, stage.search.propose(stage.frame, stage.parameters, stage.known, run, cost, limit),
             limit);
}

void proposeAsHelper(const SearchStage& stage, NicheSearch::Run run, SearchCost& cost,
                     const WorkLimit& limit) {
  stage.search.begin(stage.frame.a, stage.frame.b, stage.parameters);
  stage.known.clear();
  if (run.warm) {
    const std::size_t known = stage.archive.records().size();
    run.population = stage.search.helpersPopulation(known, stage.parameters);
    const std::size_t heirs =
        std::min<std::size_t>(known, NicheSearch::inheritedOf(run.population, stage.parameters));
    inheritNodePairs(stage, run.cycle * heirs, heirs, cost);
  }
  WorkLimit own_limit = limit;
  const std::vector<TrialPoint>& found =
      stage.search.propose(stage.frame, stage.parameters, stage.known, run, cost, own_limit);
  // Where the look for all minima may end early, what the search has found is looked at with them.
  if (limit.isTimed()) {
    proposeAll(stage, found, own_limit);
  } else {
    stage.niches.offer(found);
  }
}

}  // namespace concave_distance

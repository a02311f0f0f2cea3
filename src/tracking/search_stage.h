#pragma once

#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/search/trial_point.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "exact_niches.h"
#include "niche_archive.h"
#include "niche_placement.h"
#include "niche_search.h"

namespace concave_distance {

/// Runs stage `propose` of the exact levels: the niches known go into the search, what it finds goes to those
/// that are to be admitted.
struct SearchStage {
  const PairFrame& frame;
  const TrackerParameters& parameters;
  const NicheArchive& archive;
  NicheSearch& search;
  ExactNiches& niches;
  std::vector<TrialPoint>& known;  ///< buffer
};

/// Runs a whole population, for level `refined`, where nothing else finds new niches.
void proposeMinima(const SearchStage& stage, const NicheSearch::Run& run, SearchCost& cost, WorkLimit& limit);

/// Level `certified`, where the list is proven without: the population that the search has earned. Known
/// niches take their turn in it from cycle to cycle. When the limit cuts the search short, the answer is not
/// cut.
void proposeAsHelper(const SearchStage& stage, NicheSearch::Run run, SearchCost& cost,
                     const WorkLimit& limit);

}  // namespace concave_distance

#pragma once

#include <cstddef>
#include <vector>

#include "scene_truth.h"
#include "surface_regions.h"
#include "trial.h"

namespace concave_distance::evaluation {

/// What one run has found at one instant.
struct FoundPlaces {
  std::vector<FoundPlace>
      reported;                 ///< niches of the final population, or a tracker's up to the truth's cutoff
  std::vector<FoundPlace> met;  ///< all local minima that the search has met
};

/// Gathers what runs have found and then decides, once for each instant, in whose regions of the surfaces it
/// lies (SurfaceRegions): finding all minima costs more than a run.
class NicheQuestions {
 public:
  explicit NicheQuestions(const SceneTruth& scene) : scene_(&scene), asked_(scene.instants.size()) {}

  void ask(std::size_t instant, std::size_t run, FoundPlaces places);
  /// Adds each run's shares to its record: means over the instants.
  void settle(std::vector<TrialRecord>& records) const;

 private:
  struct Asked {
    std::size_t run;
    FoundPlaces places;
  };
  const SceneTruth* scene_;
  std::vector<std::vector<Asked>> asked_;  ///< per instant
};

}  // namespace concave_distance::evaluation

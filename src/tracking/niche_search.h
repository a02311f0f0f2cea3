#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "niche_placement.h"
#include "search/genetic_state.h"
#include "search/search_workspace.h"

namespace concave_distance {

/// Holds buffers for the nodes around a pair's genes.
struct NodeRings {
  std::vector<NodeIndex> a;
  std::vector<NodeIndex> b;
};

/// Runs stage `propose`: the niched genetic algorithm, warm-started from the niches that are known.
class NicheSearch {
 public:
  NicheSearch(const BodyMesh& a, const BodyMesh& b) : workspace_(a, b) {}

  /// Makes what the first run needs for these parameters, the grids of the bodies among it.
  void prepare(const BodyMesh& a, const BodyMesh& b, const TrackerParameters& parameters);
  void forgetParameters() { prepared_ = false; }

  /// Says what one run is for.
  struct Run {
    const std::string& pair;  ///< names the random stream, with the seed and the cycle
    std::uint64_t cycle;
    bool warm;       ///< inherits `known` and takes the warm parameters
    bool is_helper;  ///< niches are found by other means too: a cold run takes the warm parameters as well
    bool breeds;     ///< has a child of two parents, whatever is drawn and whatever the limit says
    std::uint32_t population = 0;  ///< 0: as the parameters say
  };

  /// Begins the search of a cycle: forgets the basins of the last one.
  void begin(const BodyMesh& a, const BodyMesh& b, const TrackerParameters& parameters);
  /// Moves a node pair to the minimum below it, which propose() then does not return.
  TrialPoint descendKnown(const PairFrame& frame, const TrialPoint& pair, SearchCost& cost);

  /// Runs once with the niches known, given as node pairs.
  /// @return local minima on the node graphs that the run has met beside those, the nearest first
  const std::vector<TrialPoint>& propose(const PairFrame& frame, const TrackerParameters& parameters,
                                         const std::vector<TrialPoint>& known, const Run& run,
                                         SearchCost& cost, WorkLimit& limit);

  /// Returns the population of a helper's next warm run, where so many niches are known.
  std::uint32_t helpersPopulation(std::size_t niche_count, const TrackerParameters& parameters) const;
  /// Returns how many of these inherit: not more than a quarter are random.
  static std::uint32_t inheritedOf(std::uint32_t population, const TrackerParameters& parameters);
  /// Sets the population of a helper's next run: twice as many couples where the last one has found a new
  /// niche, one less where it has not, between an eighth of what its share (TrackerParameters::search_share)
  /// of the other work pays for and all of it; one at least. Work is counted, not timed, so that one seed
  /// gives one answer.
  /// @param found new niches that the search has proposed in this cycle
  /// @param work of the other stages, in evaluations of the search
  void earn(std::size_t found, double work, double share);

  SearchWorkspace& workspace() { return workspace_; }
  NodeRings& rings() { return rings_; }
  const NicheRadii& radii(bool warm) const { return warm ? warm_radii_ : cold_radii_; }
  void restart() { couples_ = 1; }

 private:
  bool prepared_ = false;
  NicheRadii cold_radii_{};
  NicheRadii warm_radii_{};
  SearchWorkspace workspace_;
  NodeRings rings_;
  std::vector<TrialPoint> inherited_;
  std::vector<TrialPoint> found_;
  std::vector<double> scratch_;
  std::uint32_t couples_ = 1;  ///< of a helper's next warm run
  std::uint32_t last_population_ = 0;
  double last_cost_ = 0.0;  ///< evaluations, of the last run
};

}  // namespace concave_distance

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/search/genetic_parameters.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance {

/// How one pair is solved and followed. Lengths in metres.
struct TrackerParameters {
  AccuracyLevel accuracy = AccuracyLevel::Certified;
  /// Of levels `certified` and `complete`: how far below the distance the proven bound may stay; the larger
  /// of the two counts.
  double absolute_tolerance = 0.0;
  double relative_tolerance = 0.0;  ///< of the distance
  /// Seconds from the start of a cycle after which it ends with its results so far. Half is for the niches, a
  /// third for the proof, the rest for describing what was found; unused time goes to the next. Building a
  /// body's normal cones, done once, is not interrupted.
  double time_budget = std::numeric_limits<double>::infinity();
  /// Bytes of working memory for the solves of one pair, including what is kept between cycles. The
  /// benchmarks' largest solve takes a quarter of the default.
  std::size_t memory_limit = std::size_t{512} << 20U;
  /// When set, a solve ends as if its time had run out; nullptr: none.
  const std::atomic<bool>* stop = nullptr;
  /// Of a first cycle, a service call, after a reset: at level `nodes`, and where no normal cones are swept.
  /// A cold cycle that sweeps them finds every niche by that, and searches as a warm one does.
  GeneticParameters cold;
  GeneticParameters warm;            ///< every further cycle; usually a small population and few generations
  double inherited_per_niche = 3.0;  ///< alpha_Gamma (Carretero, eq. (6.8))
  std::uint32_t inherited_limit = 30;  ///< N_popGamma_max (6.8)
  std::uint32_t random_starts = 8;     ///< random individuals a warm cycle descends besides
  /// Niches of which a warm cycle asks, the nearest always and the others in turn, whether the body opposite
  /// has a closer place anywhere (projectWitness); of the nearest the surroundings are asked too. A cold
  /// cycle asks all. 0: none.
  std::uint32_t projected_niches = 1;
  /// Random nodes that a warm cycle projects onto the other body and back; a cold one 16 times as many.
  std::uint32_t projected_nodes = 4;
  /// A warm cycle searches for newborn niches (evolution and projected immigrants) when B has moved by this
  /// fraction of the finer grid's longest edge since the last search, or after `search_interval` cycles at
  /// the latest; the cycles between follow the known niches and ask the nearest one only.
  double search_motion = 0.5;
  std::uint32_t search_interval = 16;
  /// Groups of four normal cones that a warm cycle compares to find what the search has not, when B has moved
  /// by `search_motion` or more since the last cycle; in proportion less when it has moved less, but no less
  /// than a `search_interval`-th. A sweep over all takes as many cycles as it needs. A cold cycle compares
  /// all. 0: none.
  std::uint32_t swept_cones = 3000;
  /// Niches that a warm cycle floods again, in turn, to see whether they still have their prominence, when B
  /// has moved by `search_motion` or more since the last cycle; in proportion fewer when it has moved less.
  /// The nearest is looked at in every cycle besides; a cold cycle looks at all.
  std::uint32_t reviewed_niches = 1;
  bool extrapolate = false;        ///< start from where the relative velocity has carried the witnesses
  double least_prominence = 1e-2;  ///< niches with less are merged into their deeper neighbour
  /// Of level `complete`: prominences are measured up to this, at a price that grows with it; up to
  /// `least_prominence` none is: it is only decided who has the least.
  double prominence_limit = 0.0;
  double cutoff = std::numeric_limits<double>::infinity();  ///< niches farther than this are not reported
  std::uint32_t largest_niche_count = 64;                   ///< of the report; a cut is always reported
  bool niches_wanted = true;                                ///< false: only the distance is asked for
  bool keep_through_material = false;  ///< report niches through material, flagged, instead of dropping them
  std::uint64_t seed = 1;

  TrackerParameters();
  /// @throws Error naming the parameter, the value seen and the allowed range
  void validate(const std::string& where) const;
};

/// The time and memory left for the effects after a solve of this many seconds.
WorkLimit remainingWork(const TrackerParameters& parameters, double seconds_spent);

}  // namespace concave_distance

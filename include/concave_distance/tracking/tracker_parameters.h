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
  /// At level `certified` the proven bound may stay this far below the distance; the larger of the two
  /// tolerances counts.
  double absolute_tolerance = 0.0;
  double relative_tolerance = 0.0;  ///< of the distance
  /// Seconds from the start of a cycle after which it ends with its results so far. Two fifths are for the
  /// proof of the distance, the rest for search and niches; unused time goes to the next. Building a
  /// body's normal cones, done once, is not interrupted.
  double time_budget = std::numeric_limits<double>::infinity();
  /// Facet pairs (a facet of each body) that a stage of a solve may hold at once, kept ones included; one
  /// costs at most 250 bytes. The benchmarks' largest solve holds a quarter of the default.
  std::uint32_t facet_pair_limit = 1U << 22U;
  /// When set, a solve ends as if its time had run out; nullptr: none.
  const std::atomic<bool>* stop = nullptr;
  /// These are for a first cycle, a service call and after a reset. Level `certified`, which finds every
  /// niche by other means, takes the warm ones then, too; at a pose alone (PairTracker::solve(), solveOnce())
  /// it searches only where it has a time budget.
  GeneticParameters cold;
  GeneticParameters warm;            ///< every further cycle; usually a small population and few generations
  double inherited_per_niche = 3.0;  ///< alpha_Gamma (Carretero, eq. (6.8))
  std::uint32_t inherited_limit = 30;  ///< N_popGamma_max (6.8)
  std::uint32_t random_starts = 8;     ///< random individuals a warm cycle descends besides
  /// At level `certified`, where the search is not the only one to find niches, it may grow to this share of
  /// the other stages' work while it finds new niches. At least two individuals breed in every
  /// cycle that moves; 0: no search.
  double search_share = 0.05;
  double least_prominence = 1e-2;  ///< a ratio (doc/algorithm.md); niches with less join a deeper one
  /// Prominences are measured up to this, at a price that grows with it; up to
  /// `least_prominence` none is: it is only decided who has the least.
  double prominence_limit = 0.0;
  double cutoff = std::numeric_limits<double>::infinity();  ///< niches farther than this are not reported
  std::uint32_t largest_niche_count = 64;                   ///< of the report; a cut is always reported
  /// Metres that each body's surface is moved out by, as if a ball of this radius were swept along it.
  /// Distance, bound, cutoff, niches and prominences are those of the padded surfaces
  /// (PairSolution::signed_distance).
  double margin_a = 0.0;
  double margin_b = 0.0;
  bool niches_wanted = true;           ///< false: only the distance is asked for
  bool hidden = false;                 ///< report niches whose segment meets a triangle too, flagged
  bool keep_through_material = false;  ///< report niches through material, flagged, instead of dropping them
  /// Gives each niche listed its SignedPlace, at the exact levels. Costs nothing while the bodies are apart.
  bool signed_values = false;
  std::uint64_t seed = 1;

  TrackerParameters();
  double margin() const { return margin_a + margin_b; }
  /// @throws Error naming the parameter, the value seen and the allowed range
  void validate(const std::string& where) const;
};

/// The time left, and the facet pairs, for the effects after a solve of this many seconds.
WorkLimit remainingWork(const TrackerParameters& parameters, double seconds_spent);

}  // namespace concave_distance

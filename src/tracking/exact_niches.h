#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "distance/niches/convex_pair.h"
#include "distance/niches/local_minima.h"
#include "niche_archive.h"
#include "niche_placement.h"

namespace concave_distance {

/// Runs stages `follow` and `admit` of the exact levels: takes known niches to where their minima have moved,
/// and decides which of all minima are niches. At `refined` the minima are those that are known and proposed;
/// at `certified` all there are.
class ExactNiches {
 public:
  struct Cycle {
    std::uint64_t number;
    Eigen::Isometry3d last_a_from_b;  ///< of the cycle before, if there was one
    double elapsed;                   ///< seconds; 0: unknown
    bool is_tracked;                  ///< a next cycle uses what this one finds
    double cutoff;                    ///< metres, of the niches of the meshes
    detail::ConvexNiches convex;      ///< OnlyTheNearest: the last of proposeProven()
    bool catches_up;                  ///< a list that comes late is better than a part of it now
  };

  /// Returns whether nothing can have changed since the last admit().
  bool isUnchanged(double displacement) const { return current_ && displacement == 0.0; }

  /// Level `refined`: every known niche is a minimum to be admitted again; where none is known, as in a
  /// body that has swallowed the other, the nearest of all minima is followed.
  void follow(const PairFrame& frame, const NicheArchive& archive, WorkLimit& limit);
  /// Adds a local minimum that was proposed, to be admitted with all others.
  void propose(const PairFrame& frame, const WitnessPair& minimum);
  /// Level `certified`: what the search has found, looked at only where a niche is new, to say whether the
  /// search has proposed it: the list is proven without. To stay as it is until the next admit().
  void offer(const std::vector<TrialPoint>& found) { offered_ = &found; }
  /// The closest points by a proof: where niches are missing, one of them.
  /// @param is_meeting the points are where the surfaces meet
  void proposeProven(const PairFrame& frame, const WitnessPair& closest, bool is_meeting);

  /// Admits what was followed and proposed since the last call: the archive's records are the niches
  /// afterwards, with ids that go on and events for those that end.
  /// @param certain_distance metres; no two points are closer
  /// @param time_share of the limit's time, after which it ends
  void admit(const PairFrame& frame, const TrackerParameters& parameters, const Cycle& cycle,
             double certain_distance, double time_share, NicheArchive& archive, PairSolution& solution,
             WorkLimit& limit);

  /// Descends to the local minimum around a pair of triangles.
  WitnessPair refine(const PairFrame& frame, const WitnessPair& near) {
    return frame.refine(near.triangle_a, near.triangle_b, refinement_).witness;
  }
  bool isFinished() const { return found_.finished; }
  /// Level `refined`: of all that was followed and proposed, niche or not; nullptr: nothing was.
  const MinimumCandidate* nearestProposed() const;
  /// New niches of the last admit() that the search has proposed.
  std::size_t evolved() const { return evolved_; }
  /// Returns what the last admit() took, in evaluations of the search.
  double work() const;
  const LocalMinimaCost& cost() const { return found_.cost; }

  void clear();
  void renew() { current_ = false; }

 private:
  void matchPrevious(const NicheArchive& archive, const PairFrame& frame,
                     const Eigen::Isometry3d& last_a_from_b);
  void attributeOffered(const PairFrame& frame);
  bool isSearched(const LocalMinimum& minimum) const {
    return minimum.proposal != LocalMinimum::kNoProposal && minimum.proposal < searched_;
  }
  void endOthers(const NicheArchive& archive, std::vector<NicheEvent>& events) const;
  void carryOthers(const std::vector<NicheRecord>& known, const PairFrame& frame, NicheArchive& archive,
                   WorkLimit& limit, std::vector<NicheEvent>& events);

  LocalMinimaMemory memory_;
  RefinementWorkspace refinement_;
  LocalMinimaRequest request_;
  LocalMinima found_;
  std::vector<MinimumCandidate> followed_;
  std::optional<TrianglePair> nearest_;  ///< of what was followed and proposed last
  std::size_t searched_ = 0;             ///< of the proposals: those of the search
  const std::vector<TrialPoint>* offered_ = nullptr;
  std::size_t evolved_ = 0;
  std::vector<std::size_t> heirs_;  ///< of every niche found: the record whose id it takes
  std::vector<NicheRecord> next_;
  bool current_ = false;  ///< the archive holds what the parameters ask for at the last pose
};

}  // namespace concave_distance

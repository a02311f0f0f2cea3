#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "basin_search.h"
#include "bounded_path.h"
#include "decision_cache.h"
#include "decision_counts.h"
#include "niche_properties.h"
#include "niche_rule.h"
#include "overlap_parts.h"
#include "suspended_search.h"

namespace concave_distance::detail {

/// Decides which local minima are niches of their own, proves it at each pose, and keeps what proves it for
/// the next one: paths to deeper places and boundaries around niches. It belongs to one pair of bodies.
class NicheDecider {
 public:
  static constexpr std::uint32_t kNone = DecisionCache::kNone;
  static constexpr std::uint32_t kUndecided = 0xfffffffeU;

  enum class Decision : std::uint8_t {
    Open,
    Niche,      ///< nothing deeper is reached below the rule's level
    Ripple,     ///< something deeper is, or the same set of minima has another candidate
    Undecided,  ///< the limit was reached
    Unwanted    ///< neither a known ripple nor wanted, or after as many niches as are wanted
  };
  struct Judged {
    MinimumCandidate candidate;
    Decision decision = Decision::Open;
    bool was_found = false;      ///< not by a candidate, but by a search or by locate()
    std::uint32_t into = kNone;  ///< of a ripple: the deeper one, if known
    TrianglePair below;          ///< and if not: a facet pair deeper than it
    std::uint64_t basin = 0;     ///< of a niche: the same while its boundary is; 0: none
  };
  using Counts = DecisionCounts;
  struct Request {
    double cutoff = std::numeric_limits<double>::infinity();  ///< metres; no place beyond it is judged
    NicheRule rule;
    std::size_t most_niches = std::numeric_limits<std::size_t>::max();
    /// Niches through material are wanted; else nothing is judged that begins there.
    bool through_material = false;
    bool is_tracked = true;         ///< what proves a decision is kept for the next pose
    double certain_distance = 0.0;  ///< metres, as LocalMinimaRequest::certain_distance
    /// Where the bodies meet at this pose, with a candidate for each part; nullptr: nowhere.
    const OverlapParts* overlap = nullptr;
    /// Returns whether a candidate that is no known ripple is wanted; empty: all are. The occluder is kept
    /// with the candidate's triangle pair.
    std::function<bool(const MinimumCandidate&, Occluder&)> is_wanted;
  };

  void clear();

  /// Goes on with a long search that time has ended, before begin(). Returns false when the limit was reached
  /// again. A pose may be left out: what proves decisions is kept.
  bool goOn(WorkLimit& limit) { return suspended_.goOn(memory_, limit); }

  /// At a new pose: puts the candidates in ascending order; results stand in the same order, and after them
  /// places that only searches have found.
  void begin(const PairFrame& frame, std::vector<MinimumCandidate>& candidates, const Request& request,
             WorkLimit& limit);
  /// Judges candidates whose decision needs no search, until there are Request::most_niches more.
  void judgeByMemory(const PairFrame& frame, const Request& request, WorkLimit& limit);
  /// Judges those that judgeByMemory() has left open.
  void judgeBySearches(const PairFrame& frame, const Request& request, WorkLimit& limit);
  /// Says that time has ended this pose's judging: what proves decisions is kept for the next one even where
  /// it was not used.
  void endCut() { memory_.endCut(); }
  bool hasJudgedAll() const { return next_ >= candidate_count_; }
  /// Judges all of them, until there are Request::most_niches.
  void judge(const PairFrame& frame, std::vector<MinimumCandidate>& candidates, const Request& request,
             WorkLimit& limit);

  /// At the pose of the last begin(): the niche of the local minimum around a triangle pair, as an index of
  /// judged(); kNone when that is none of them or beyond the cutoff, kUndecided when the limit was reached. A
  /// place that is a niche of its own is judged and added.
  std::uint32_t locate(const PairFrame& frame, const TrianglePair& around, const Request& request,
                       WorkLimit& limit);
  /// Returns the niche with this basin, or kNone when it is no longer kept.
  std::uint32_t nicheWith(std::uint64_t basin) const;
  /// Returns the niche that a part of the overlap is, as locate() does.
  std::uint32_t nicheOfPart(std::uint32_t part) const;

  /// At the pose of the last begin(): the lowest level (metres) from which a path leads from a niche to a
  /// place as near; infinite when that is above `highest`, NaN when the limit was reached.
  double passOf(const PairFrame& frame, std::uint32_t niche, double highest, const Request& request,
                WorkLimit& limit);

  const std::vector<Judged>& judged() const { return judged_; }
  const Counts& counts() const { return counts_; }

 private:
  class Stage;
  /// Follows the ripples downhill from `index` and returns the candidate at which the path ends.
  std::uint32_t endOf(std::uint32_t index) const;
  std::uint32_t nicheOf(std::uint32_t index) const;

  DecisionCache memory_;
  BasinSearch search_;
  SuspendedSearch suspended_;
  BoundedPathBuffers path_;
  RefinementWorkspace refinement_;
  std::vector<Judged> judged_;
  std::vector<std::uint32_t> part_candidates_;  ///< by part of the overlap
  PairTable deepest_{4};                        ///< first candidate of each pair of pieces
  std::uint32_t candidate_count_ = 0;           ///< of judged_, the rest was found
  std::uint32_t next_ = 0;                      ///< of the candidates, the first that is not judged
  std::uint32_t end_ = 0;                       ///< of the candidates looked up in the memory
  std::uint32_t turn_ = 0;                      ///< of the candidates, whose is the next search
  bool searches_are_long_ = false;
  bool is_far_ = false;
  Counts counts_;
};

}  // namespace concave_distance::detail

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "basin_search.h"
#include "bounded_path.h"
#include "decision_cache.h"
#include "niche_properties.h"

namespace concave_distance::detail {

/// Which local minima are niches of their own, proven at each pose; and what proves it, kept for the next
/// one: paths to deeper places and borders around niches. Belongs to one pair of bodies.
class NicheDecider {
 public:
  static constexpr std::uint32_t kNone = DecisionCache::kNone;
  static constexpr std::uint32_t kUndecided = 0xfffffffeU;

  enum class Verdict : std::uint8_t {
    Open,
    Niche,      ///< nothing deeper is reached below (1 + least prominence) times its distance
    Ripple,     ///< something deeper is, or the same set of minima has another seed
    Undecided,  ///< the limit was reached
    Unwanted    ///< neither a known ripple nor wanted, or after as many niches as are wanted
  };
  struct Judged {
    MinimumCandidate seed;
    Verdict verdict = Verdict::Open;
    bool was_found = false;      ///< not by a seed, but by a flood or by locate()
    std::uint32_t into = kNone;  ///< of a ripple: the deeper one, if known
    TrianglePair below;          ///< and if not: a facet pair deeper than it
    std::uint64_t region = 0;    ///< of a niche: the same while its border is; 0: none
  };
  struct Counts {
    std::uint32_t by_path = 0;    ///< ripples by known paths
    std::uint32_t aimed = 0;      ///< links of paths that have got other points
    std::uint32_t by_border = 0;  ///< niches by known borders
    std::uint32_t mended = 0;     ///< niches by borders with more facet pairs inside
    std::uint32_t floods = 0;
    std::uint32_t flooded_cells = 0;
    std::uint32_t measured = 0;  ///< elements of borders, anew
  };
  struct Request {
    double cutoff = std::numeric_limits<double>::infinity();  ///< metres; no place beyond it is judged
    double least_prominence = 1e-2;
    std::size_t most_niches = std::numeric_limits<std::size_t>::max();
    /// Niches through material are wanted; else nothing is judged that begins there.
    bool through_material = false;
    bool is_tracked = true;  ///< what proves a verdict is kept for the next pose
    /// Whether a seed that is no known ripple is wanted; empty: all are. The occluder is kept with the seed's
    /// triangle pair.
    std::function<bool(const MinimumCandidate&, Occluder&)> is_wanted;
  };

  void clear();

  /// At a new pose: puts the seeds in ascending order; results stand in the same order, and after them places
  /// that only floods have found.
  void begin(const PairFrame& frame, std::vector<MinimumCandidate>& seeds, const Request& request,
             WorkLimit& limit);
  /// Judges seeds whose verdict needs no flood, until there are Request::most_niches more.
  void judgeByMemory(const PairFrame& frame, const Request& request, WorkLimit& limit);
  /// Judges those that the last call has left open.
  void judgeByFloods(const PairFrame& frame, const Request& request, WorkLimit& limit);
  bool hasJudgedAll() const { return next_ >= seed_count_; }
  /// All of it, until there are Request::most_niches.
  void judge(const PairFrame& frame, std::vector<MinimumCandidate>& seeds, const Request& request,
             WorkLimit& limit);

  /// At the pose of the last begin(): the niche of the local minimum around a triangle pair, as an index of
  /// judged(); kNone when that is none of them or beyond the cutoff, kUndecided when the limit was reached. A
  /// place that is a niche of its own is judged and added.
  std::uint32_t locate(const PairFrame& frame, const TrianglePair& around, const Request& request,
                       WorkLimit& limit);
  /// The niche with this region; kNone when there is none any more.
  std::uint32_t nicheWith(std::uint64_t region) const;

  const std::vector<Judged>& judged() const { return judged_; }
  const Counts& counts() const { return counts_; }
  std::size_t memoryBytes() const;

 private:
  class Stage;
  /// Of a ripple and those it leads to, the last.
  std::uint32_t endOf(std::uint32_t index) const;
  std::uint32_t nicheOf(std::uint32_t index) const;

  DecisionCache memory_;
  BasinSearch flood_;
  BoundedPathBuffers path_;
  RefinementWorkspace refinement_;
  std::vector<Judged> judged_;
  PairTable deepest_{4};          ///< first seed of each pair of pieces
  std::uint32_t seed_count_ = 0;  ///< of judged_, the rest was found
  std::uint32_t next_ = 0;        ///< of the seeds, the first that is not judged
  std::uint32_t end_ = 0;         ///< of the seeds looked up in the memory
  std::uint32_t turn_ = 0;        ///< of the seeds, whose is the next flood
  bool floods_are_long_ = false;
  bool is_far_ = false;
  Counts counts_;
};

}  // namespace concave_distance::detail

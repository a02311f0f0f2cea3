#pragma once

#include <algorithm>

#include "niche_decider.h"

namespace concave_distance::detail {

/// Proves niches at one pose: keeps the basin that a search has found enclosed, with its boundary, and tells
/// at later poses whether it still is (doc/proofs.md).
class DecisionBasins {
 public:
  /// @param search holds the last search; a broken boundary is searched with it
  DecisionBasins(DecisionCache& memory, BasinSearch& search, const PairFrame& frame,
                 NicheDecider::Counts& counts, WorkLimit& limit)
      : memory_(memory), search_(search), frame_(frame), counts_(counts), limit_(limit) {}

  /// True when the boundary of a kept basin holds, if need be with facet pairs beyond it added. The boundary
  /// is whole afterwards, because the basin may be asked for again; where the limit does not admit that the
  /// basin is dropped.
  /// @param meets as in BasinSearch::proceed()
  template <typename Meets>
  bool isEnclosed(std::uint32_t index, const BasinSearch::Levels& levels, const Meets& meets) {
    if (!takeCrossed(index, levels.highest)) return true;
    const BasinSearch::End end =
        memory_.boundaries().has_unmeasured ? BasinSearch::End::Long : searchBeyond(index, levels, meets);
    if (end == BasinSearch::End::Cut && limit_.hasRefusedTime() && !limit_.hasRefusedPairs()) {
      extendPartly(index);
      return false;
    }
    if (end != BasinSearch::End::Enclosed) {
      restoreBoundary(index);
      return false;
    }
    if (!extend(index)) return false;
    ++counts_.mended;
    return true;
  }

  /// Keeps the basin that the last search has visited.
  /// @param id of the basin; 0: a new one
  /// @param first the deepest candidate in it, whose triangle pair is `around`
  /// @return its id, or 0 when it is not kept
  std::uint64_t keep(std::uint64_t id, std::uint32_t first, const TrianglePair& around);

  using Progress = BasinProgress;
  /// Does as keep() until time ends it. The basin is asked for only when it is whole.
  void keepSome(const TrianglePair& around, Progress& progress);

 private:
  /// A basin that has grown to more than twice its size and this many facet pairs is searched anew.
  static constexpr std::size_t kSmallBasin = 64;

  /// Takes what is nearer than `level` (m) out of the boundary. Returns false when nothing is, for certain.
  bool takeCrossed(std::uint32_t index, double level);

  /// Searches the facet pairs beyond the elements that have left the basin's boundary.
  template <typename Meets>
  BasinSearch::End searchBeyond(std::uint32_t index, const BasinSearch::Levels& levels, const Meets& meets) {
    const DecisionCache::KeptBasin& basin = memory_.basin(index);
    const auto is_inside = [&](TriangleIndex a, TriangleIndex b) { return memory_.isIn(a, b, index); };
    search_.beginBeyond(levels);
    for (const BoundaryElement& element : memory_.boundaries().crossed) {
      const TrianglePair pair = element.pairBeyond();
      if (!is_inside(pair.a, pair.b) && !search_.enterBeyond(pair.a, pair.b, 0.0, limit_)) {
        return BasinSearch::End::Cut;
      }
    }
    const std::size_t largest = 2 * basin.facet_pairs_at_begin + kSmallBasin;
    const std::size_t most = largest - std::min(basin.facet_pairs, largest);
    const BasinSearch::End end = search_.proceed(frame_, most, meets, is_inside, limit_);
    counts_.visited_pairs += static_cast<std::uint32_t>(search_.lookedAt());
    return end;
  }

  /// Puts the elements that have left the boundary, but for those inside by now, back into it.
  void restoreBoundary(std::uint32_t index);

  /// Returns an empty basin, or kNone.
  std::uint32_t begin(std::uint64_t id, const TrianglePair& around);
  /// Extends a kept basin by what the last search has visited; where the limit does not admit that it drops
  /// it and returns false.
  bool extend(std::uint32_t index);
  /// Does so for a search that time has cut, so that the next one goes on from there: the surroundings of the
  /// facet pairs that it has looked at become boundary, as far as they are not known at a distance of 0.
  void extendPartly(std::uint32_t index);
  /// Parts a facet pair of the basin from those that the search has only reached.
  void partFromReached(const TrianglePair& pair, std::uint32_t index);
  /// Adds the next facet pair, or where all are in it the next step of the boundary. False when
  /// the limit admits no more.
  bool addNext(Progress& progress);
  bool isAdded(const Progress& progress) const {
    return progress.facet_pairs == search_.facet_pairs().size() &&
           progress.boundary_steps == search_.boundarySteps().size();
  }

  DecisionCache& memory_;
  BasinSearch& search_;
  const PairFrame& frame_;
  NicheDecider::Counts& counts_;
  WorkLimit& limit_;
  std::vector<char> is_reached_;
};

}  // namespace concave_distance::detail

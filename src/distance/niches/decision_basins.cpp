#include "decision_stage.h"

#include <algorithm>
#include <cmath>

// These members prove niches: by searches of basins, and by kept basins (doc/proofs.md).

namespace concave_distance::detail {
namespace {

/// A search that has visited this many facet pairs may be replaced by cheaper tests.
constexpr std::size_t kLongSearch = 512;
/// Around more facet pairs no boundary is kept.
constexpr std::size_t kLargestBasin = std::size_t{1} << 18U;
/// A basin that has grown to more than twice its size and this many facet pairs is made anew.
constexpr std::size_t kSmallBasin = 64;

}  // namespace

void NicheDecider::Stage::searchInTurn() {
  const std::uint32_t count = decider_.end_ - decider_.next_;
  if (count == 0) return;
  std::uint32_t done = 0;
  for (; done < count && !limit_.isOver(); ++done) {
    const std::uint32_t i = decider_.next_ + (decider_.turn_ + done) % count;
    if (decider_.judged_[i].decision == Decision::Open) search(i);
  }
  decider_.turn_ = (decider_.turn_ + done) % count;
}

bool NicheDecider::Stage::isEnclosed(std::uint32_t i, std::uint32_t index) {
  DecisionCache::KeptBasin& basin = memory_.basin(index);
  const BasinSearch::Levels levels = levelsOf(decider_.judged_[i].candidate.distance);
  decider_.counts_.measured += basin.boundary.takeCrossed(memory_.boundaries(), frame_, levels.highest);
  if (memory_.boundaries().crossed.empty()) {
    ++decider_.counts_.by_boundary;
    return true;
  }
  const BasinSearch::End end = searchBeyond(i, index, levels);
  if (end != BasinSearch::End::Enclosed) {
    restoreBoundary(index);
    return false;
  }
  if (!extend(index)) {
    memory_.drop(index);
    return false;
  }
  ++decider_.counts_.mended;
  return true;
}

BasinSearch::End NicheDecider::Stage::searchBeyond(std::uint32_t i, std::uint32_t index,
                                                   const BasinSearch::Levels& levels) {
  const DecisionCache::KeptBasin& basin = memory_.basin(index);
  const auto is_inside = [&](TriangleIndex a, TriangleIndex b) { return memory_.isIn(a, b, index); };
  BasinSearch& search = decider_.search_;
  search.beginBeyond(levels);
  for (const BoundaryElement& element : memory_.boundaries().crossed) {
    const TrianglePair pair = element.pairBeyond();
    if (!is_inside(pair.a, pair.b) && !search.enterBeyond(pair.a, pair.b, 0.0, limit_)) {
      return BasinSearch::End::Cut;
    }
  }
  const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
  const std::size_t largest = 2 * basin.facet_pairs_at_begin + kSmallBasin;
  const std::size_t most = largest - std::min(basin.facet_pairs, largest);
  const BasinSearch::End end = search.proceed(frame_, most, meets, is_inside, limit_);
  decider_.counts_.visited_pairs += static_cast<std::uint32_t>(search.lookedAt());
  return end;
}

void NicheDecider::Stage::restoreBoundary(std::uint32_t index) {
  for (const BoundaryElement& element : memory_.boundaries().crossed) {
    if (!memory_.basin(index).boundary.add(memory_.boundaries(), frame_, element, 0.0, limit_)) {
      return memory_.drop(index);
    }
  }
}

void NicheDecider::Stage::search(std::uint32_t i) {
  const MinimumCandidate candidate = decider_.judged_[i].candidate;
  const std::uint32_t number = indexOf(candidate);
  std::uint64_t id = 0;
  if (const std::uint32_t broken = memory_.basinOf(number, i); broken != kNone) {
    // Kept for the next pose when there is no time for a search.
    memory_.basin(broken).confirmed = limit_.isOver();
    if (limit_.isOver()) return set(i, Decision::Undecided);
    id = memory_.basin(broken).id;
    memory_.drop(broken);
  }
  deepest_ = deepestLike(i);
  // Searches of this pose may have left a path.
  if (followsDown(i, number) || (were_long_ && settlesLong(i))) return;
  ++decider_.counts_.searches;
  BasinSearch& search = decider_.search_;
  const TrianglePair start = frame_.facetPairOf(candidate.a, candidate.b);
  search.begin(start.a, start.b, levelsOf(candidate.distance));
  const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
  const auto is_inside = [](TriangleIndex, TriangleIndex) { return false; };
  BasinSearch::End end = search.proceed(frame_, kLongSearch, meets, is_inside, limit_);
  if (end == BasinSearch::End::Long) {
    if (settlesLong(i)) return;
    end = search.proceed(frame_, std::numeric_limits<std::size_t>::max(), meets, is_inside, limit_);
  }
  decider_.counts_.visited_pairs += static_cast<std::uint32_t>(search.lookedAt());
  switch (end) {
    case BasinSearch::End::Enclosed:
      set(i, Decision::Niche);
      if (request_.is_tracked && candidate.distance > tolerance_) keepBasin(i, id);
      break;
    case BasinSearch::End::Below: {
      set(i, Decision::Ripple);
      const BasinSearch::FacetPair& last = search.facet_pairs()[search.last()];
      decider_.judged_[i].below = {last.a, last.b};
      if (request_.is_tracked) {
        keepPath(number);
        keepLow(last.a, last.b);
      }
      descend(i);
      break;
    }
    case BasinSearch::End::Met:
      set(i, Decision::Ripple,
          memory_.candidateIn(search.facet_pairs()[search.last()].a, search.facet_pairs()[search.last()].b));
      if (request_.is_tracked) keepPath(number);
      break;
    default:
      set(i, Decision::Undecided);
      break;
  }
}

double NicheDecider::Stage::passOf(std::uint32_t i, double highest) const {
  const MemoryScope memory(limit_);
  const MinimumCandidate& candidate = decider_.judged_[i].candidate;
  const TrianglePair start = frame_.facetPairOf(candidate.a, candidate.b);
  BasinSearch search;  // it may grow large: its memory is not kept
  search.begin(start.a, start.b,
               {candidate.distance - tolerance_, candidate.distance + tolerance_, highest + tolerance_});
  const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
  const auto is_inside = [](TriangleIndex, TriangleIndex) { return false; };
  const BasinSearch::End end =
      search.proceed(frame_, std::numeric_limits<std::size_t>::max(), meets, is_inside, limit_);
  decider_.counts_.visited_pairs += static_cast<std::uint32_t>(search.lookedAt());
  if (end == BasinSearch::End::Cut) return std::numeric_limits<double>::quiet_NaN();
  if (end == BasinSearch::End::Enclosed) return std::numeric_limits<double>::infinity();
  return std::max(search.highestLevel(), candidate.distance);
}

void NicheDecider::Stage::keepBasin(std::uint32_t i, std::uint64_t id) {
  const std::vector<BasinSearch::FacetPair>& visited = decider_.search_.facet_pairs();
  if (visited.size() > kLargestBasin) return;
  const std::uint32_t index = memory_.takeBasin(id, limit_);
  if (index == kNone) return;
  DecisionCache::KeptBasin& basin = memory_.basin(index);
  basin.confirmed = true;
  basin.first = i;
  basin.facet_pairs_at_begin = visited.size();
  const MinimumCandidate& candidate = decider_.judged_[i].candidate;
  const TrianglePairDistance closest =
      triangleDistance(frame_.cornersOfA(candidate.a), frame_.cornersOfB(candidate.b));
  basin.boundary.begin(memory_.boundaries(), closest.point_a, frame_.pointInB(closest.point_b));
  decider_.judged_[i].basin = basin.id;
  if (!extend(index)) memory_.drop(index);
}

bool NicheDecider::Stage::extend(std::uint32_t index) {
  DecisionCache::KeptBasin& basin = memory_.basin(index);
  for (const BasinSearch::FacetPair& facet_pair : decider_.search_.facet_pairs()) {
    const std::uint32_t number = memory_.facetPairOf(facet_pair.a, facet_pair.b, limit_);
    if (number == kNone || !memory_.join(number, index, limit_)) return false;
  }
  bool has_room = true;
  decider_.search_.forEachBoundaryStep(
      [&](TriangleIndex a, TriangleIndex b) { return memory_.isIn(a, b, index); },
      [&](const BasinSearch::BoundaryStep& step) {
        const TriangleIndex beyond = step.element.side == Side::A ? step.beyond_a : step.beyond_b;
        has_room = has_room && basin.boundary.add(memory_.boundaries(), frame_, {step.element, beyond},
                                                  std::sqrt(step.squared_level), limit_);
      });
  return has_room;
}

}  // namespace concave_distance::detail

#include "decision_stage.h"

#include <algorithm>
#include <cmath>

// Niches: floods, and regions with a border that stand for them (doc/proofs.md).

namespace concave_distance::detail {
namespace {

/// A flood that has visited this many facet pairs may be replaced by cheaper tests.
constexpr std::size_t kLongFlood = 512;
/// Around more facet pairs no border is kept.
constexpr std::size_t kLargestRegion = std::size_t{1} << 18U;
/// A region that has grown to more than twice its size and this many facet pairs is made anew.
constexpr std::size_t kSmallRegion = 64;

}  // namespace

void NicheDecider::Stage::floodInTurn() {
  const std::uint32_t count = verdicts_.end_ - verdicts_.next_;
  if (count == 0) return;
  std::uint32_t done = 0;
  for (; done < count && !limit_.isOver(); ++done) {
    const std::uint32_t i = verdicts_.next_ + (verdicts_.turn_ + done) % count;
    if (verdicts_.judged_[i].verdict == Verdict::Open) flood(i);
  }
  verdicts_.turn_ = (verdicts_.turn_ + done) % count;
}

bool NicheDecider::Stage::isEnclosed(std::uint32_t i, std::uint32_t index) {
  DecisionCache::Region& region = memory_.region(index);
  const BasinSearch::Levels levels = levelsOf(verdicts_.judged_[i].seed.distance);
  verdicts_.counts_.measured += region.border.takeCrossed(memory_.borders(), frame_, levels.highest);
  if (memory_.borders().crossed.empty()) {
    ++verdicts_.counts_.by_border;
    return true;
  }
  const BasinSearch::End end = floodBeyond(i, index, levels);
  if (end != BasinSearch::End::Enclosed) {
    restoreBorder(index);
    return false;
  }
  if (!extend(index)) {
    memory_.drop(index);
    return false;
  }
  ++verdicts_.counts_.mended;
  return true;
}

BasinSearch::End NicheDecider::Stage::floodBeyond(std::uint32_t i, std::uint32_t index,
                                                  const BasinSearch::Levels& levels) {
  const DecisionCache::Region& region = memory_.region(index);
  const auto is_inside = [&](TriangleIndex a, TriangleIndex b) { return memory_.isIn(a, b, index); };
  BasinSearch& flood = verdicts_.flood_;
  flood.beginBeyond(levels);
  for (const BorderElement& element : memory_.borders().crossed) {
    const TrianglePair pair = element.pairBeyond();
    if (!is_inside(pair.a, pair.b) && !flood.enterBeyond(pair.a, pair.b, 0.0, limit_)) {
      return BasinSearch::End::Cut;
    }
  }
  const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
  const std::size_t largest = 2 * region.facet_pairs_at_begin + kSmallRegion;
  const std::size_t most = largest - std::min(region.facet_pairs, largest);
  const BasinSearch::End end = flood.proceed(frame_, most, meets, is_inside, limit_);
  verdicts_.counts_.flooded_cells += static_cast<std::uint32_t>(flood.lookedAt());
  return end;
}

void NicheDecider::Stage::restoreBorder(std::uint32_t index) {
  for (const BorderElement& element : memory_.borders().crossed) {
    if (!memory_.region(index).border.add(memory_.borders(), frame_, element, 0.0, limit_)) {
      return memory_.drop(index);
    }
  }
}

void NicheDecider::Stage::flood(std::uint32_t i) {
  const MinimumCandidate seed = verdicts_.judged_[i].seed;
  const std::uint32_t number = numberOf(seed);
  std::uint64_t id = 0;
  if (const std::uint32_t broken = memory_.regionOf(number, i); broken != kNone) {
    // Kept for the next pose when there is no time for a flood.
    memory_.region(broken).confirmed = limit_.isOver();
    if (limit_.isOver()) return set(i, Verdict::Undecided);
    id = memory_.region(broken).id;
    memory_.drop(broken);
  }
  deepest_ = deepestLike(i);
  // Floods of this pose may have left a path.
  if (followsDown(i, number) || (were_long_ && settlesLong(i))) return;
  ++verdicts_.counts_.floods;
  BasinSearch& flood = verdicts_.flood_;
  const TrianglePair start = frame_.facetPairOf(seed.a, seed.b);
  flood.begin(start.a, start.b, levelsOf(seed.distance));
  const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
  const auto is_inside = [](TriangleIndex, TriangleIndex) { return false; };
  BasinSearch::End end = flood.proceed(frame_, kLongFlood, meets, is_inside, limit_);
  if (end == BasinSearch::End::Long) {
    if (settlesLong(i)) return;
    end = flood.proceed(frame_, std::numeric_limits<std::size_t>::max(), meets, is_inside, limit_);
  }
  verdicts_.counts_.flooded_cells += static_cast<std::uint32_t>(flood.lookedAt());
  switch (end) {
    case BasinSearch::End::Enclosed:
      set(i, Verdict::Niche);
      if (request_.is_tracked && seed.distance > tolerance_) keepRegion(i, id);
      break;
    case BasinSearch::End::Below: {
      set(i, Verdict::Ripple);
      const BasinSearch::FacetPair& last = flood.facet_pairs()[flood.last()];
      verdicts_.judged_[i].below = {last.a, last.b};
      if (request_.is_tracked) {
        keepPath(number);
        keepLow(last.a, last.b);
      }
      descend(i);
      break;
    }
    case BasinSearch::End::Met:
      set(i, Verdict::Ripple,
          memory_.seedIn(flood.facet_pairs()[flood.last()].a, flood.facet_pairs()[flood.last()].b));
      if (request_.is_tracked) keepPath(number);
      break;
    default:
      set(i, Verdict::Undecided);
      break;
  }
}

void NicheDecider::Stage::keepRegion(std::uint32_t i, std::uint64_t id) {
  const std::vector<BasinSearch::FacetPair>& visited = verdicts_.flood_.facet_pairs();
  if (visited.size() > kLargestRegion) return;
  const std::uint32_t index = memory_.takeRegion(id, limit_);
  if (index == kNone) return;
  DecisionCache::Region& region = memory_.region(index);
  region.confirmed = true;
  region.first = i;
  region.facet_pairs_at_begin = visited.size();
  const MinimumCandidate& seed = verdicts_.judged_[i].seed;
  const TrianglePairDistance closest = triangleDistance(frame_.cornersOfA(seed.a), frame_.cornersOfB(seed.b));
  region.border.begin(memory_.borders(), closest.point_a, frame_.pointInB(closest.point_b));
  verdicts_.judged_[i].region = region.id;
  if (!extend(index)) memory_.drop(index);
}

bool NicheDecider::Stage::extend(std::uint32_t index) {
  DecisionCache::Region& region = memory_.region(index);
  for (const BasinSearch::FacetPair& facet_pair : verdicts_.flood_.facet_pairs()) {
    const std::uint32_t number = memory_.facetPairOf(facet_pair.a, facet_pair.b, limit_);
    if (number == kNone || !memory_.join(number, index, limit_)) return false;
  }
  bool has_room = true;
  verdicts_.flood_.forEachBorderStep(
      [&](TriangleIndex a, TriangleIndex b) { return memory_.isIn(a, b, index); },
      [&](const BasinSearch::BorderStep& step) {
        const TriangleIndex beyond = step.element.side == Side::A ? step.beyond_a : step.beyond_b;
        has_room = has_room && region.border.add(memory_.borders(), frame_, {step.element, beyond},
                                                 std::sqrt(step.squared_level), limit_);
      });
  return has_room;
}

}  // namespace concave_distance::detail

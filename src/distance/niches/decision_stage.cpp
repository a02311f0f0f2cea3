#include "decision_stage.h"

#include <algorithm>

#include "distant_components.h"
#include "mesh/surface/connected_pieces.h"

namespace concave_distance::detail {
namespace {

/// A search that has visited this many facet pairs may be replaced by cheaper tests.
constexpr std::size_t kLongSearch = 512;
/// Where there is a deadline, a basin of more facet pairs is kept step by step in the next cycles.
constexpr std::size_t kLargeBasin = 8192;

}  // namespace

void NicheDecider::Stage::decideFar() {
  for (std::uint32_t i = 0; i < decider_.judged_.size(); ++i) {
    if (decider_.judged_[i].decision != Decision::Open) continue;
    const std::uint32_t deepest = deepestLike(i);
    set(i, deepest == i ? Decision::Niche : Decision::Ripple, deepest == i ? kNone : deepest);
  }
}

void NicheDecider::Stage::decideByMemory() {
  std::size_t niches = 0;
  for (std::uint32_t& end = decider_.end_; end < candidate_count_ && niches < request_.most_niches; ++end) {
    if (decider_.judged_[end].decision == Decision::Open) decideByMemory(end);
    niches += decider_.judged_[end].decision == Decision::Niche ? 1 : 0;
  }
}

void NicheDecider::Stage::decideBySearches() {
  if (limit_.isTimed()) searchInTurn();
  std::size_t niches = 0;
  for (std::uint32_t& i = decider_.next_; i < decider_.end_ && niches < request_.most_niches; ++i) {
    if (decider_.judged_[i].decision == Decision::Open) search(i);
    niches += decider_.judged_[i].decision == Decision::Niche ? 1 : 0;
  }
  decider_.end_ = decider_.next_;
}

void NicheDecider::Stage::decideByMemory(std::uint32_t i) {
  const MinimumCandidate candidate = decider_.judged_[i].candidate;
  deepest_ = deepestLike(i);
  const std::uint32_t number = indexOf(candidate);
  if (number == kNone) return set(i, Decision::Undecided);
  if (const std::uint32_t other = memory_.candidateOf(number);
      other != kNone && other != i && isEarlier(other, i)) {
    return set(i, Decision::Ripple, other);
  }
  if (i > 0 && i < candidate_count_ && isSamePlace(decider_.judged_[i - 1].candidate, candidate))
    return set(i, Decision::Ripple, i - 1);
  if (followsDown(i, number)) return;
  if (request_.is_wanted && !request_.is_wanted(candidate, memory_.facet_pair(number).occluder)) {
    return set(i, Decision::Unwanted);
  }
  // Only then do candidates lie on both sides of a closed shell (collectConeItems()).
  if (!request_.through_material && frame_.hasJoints() && isThroughMaterial(frame_.witnessOf(candidate))) {
    return set(i, Decision::Unwanted);
  }
  if (i == 0 && isNearestOfAll(candidate.distance)) return set(i, Decision::Niche);
  const std::uint32_t known = memory_.basinOf(number, i);
  if (known == kNone) return;
  DecisionCache::KeptBasin& basin = memory_.basin(known);
  const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
  basin.confirmed = basins_.isEnclosed(known, levelsOf(candidate.distance), meets);
  if (basin.confirmed) {
    decider_.judged_[i].basin = basin.id;
    return set(i, Decision::Niche);
  }
}

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

void NicheDecider::Stage::search(std::uint32_t i) {
  const MinimumCandidate candidate = decider_.judged_[i].candidate;
  const std::uint32_t number = indexOf(candidate);
  std::uint64_t id = 0;
  if (const std::uint32_t broken = memory_.basinOf(number, i); broken != kNone) {
    // Kept for the next pose when there is no time for a search.
    memory_.basin(broken).confirmed = limit_.isOver();
    if (limit_.isOver()) return set(i, Decision::Undecided);
    id = memory_.basin(broken).id;
    if (!memory_.drop(broken)) id = 0;
  }
  deepest_ = deepestLike(i);
  // Searches of this pose may have left a path.
  if (followsDown(i, number) || (were_long_ && settlesLong(i))) return;
  ++decider_.counts_.searches;
  BasinSearch& search = decider_.search_;
  const TrianglePair start = frame_.facetPairOf(candidate.a, candidate.b);
  const bool can_suspend = request_.is_tracked && i < candidate_count_ && candidate.distance > tolerance_ &&
                           !decider_.suspended_.isThere();
  if (!beginSearch(i, start)) return set(i, Decision::Undecided);
  BasinSearch::End end = proceed(search, kLongSearch, i);
  if (end == BasinSearch::End::Long) {
    if (settlesLong(i)) return;
    end = proceed(search, std::numeric_limits<std::size_t>::max(), i);
  }
  decider_.counts_.visited_pairs += static_cast<std::uint32_t>(search.lookedAt());
  switch (end) {
    case BasinSearch::End::Enclosed:
      set(i, Decision::Niche);
      if (can_suspend && limit_.shareOf(1.0) > 0.0 && search.lookedAt() > kLargeBasin) {
        decider_.suspended_.suspend(search, start, frame_);
        break;
      }
      if (request_.is_tracked && candidate.distance > tolerance_) {
        decider_.judged_[i].basin = basins_.keep(id, i, {candidate.a, candidate.b});
      }
      break;
    case BasinSearch::End::Below: {
      set(i, Decision::Ripple);
      const BasinSearch::FacetPair& last = search.facet_pairs()[search.last()];
      decider_.judged_[i].below = {last.a, last.b};
      if (request_.is_tracked) {
        paths_.keepPath(search, number);
        paths_.keepLow({last.a, last.b});
      }
      descend(i);
      break;
    }
    case BasinSearch::End::Met:
      set(i, Decision::Ripple,
          candidateIn(search.facet_pairs()[search.last()].a, search.facet_pairs()[search.last()].b));
      if (request_.is_tracked) paths_.keepPath(search, number);
      break;
    default:
      set(i, Decision::Undecided);
      if (can_suspend && search.lookedAt() >= kLongSearch && !limit_.hasRefusedPairs()) {
        decider_.suspended_.suspend(search, start, frame_);
      }
      break;
  }
}

bool NicheDecider::Stage::beginSearch(std::uint32_t i, const TrianglePair& start) {
  const MinimumCandidate& candidate = decider_.judged_[i].candidate;
  decider_.search_.begin(start.a, start.b, levelsOf(candidate.distance));
  if (candidate.part == MinimumCandidate::kNoPart) return true;
  for (std::uint32_t pair = 0; pair < request_.overlap->pairs().size(); ++pair) {
    const MeetingPair& met = request_.overlap->pairs()[pair];
    if (request_.overlap->partOf(pair) != candidate.part) continue;
    if (!decider_.search_.enterBeyond(met.a, met.b, 0.0, limit_)) return false;
  }
  return true;
}

BasinSearch::End NicheDecider::Stage::proceed(BasinSearch& search, std::size_t most, std::uint32_t i) const {
  const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
  const auto is_inside = [](TriangleIndex, TriangleIndex) { return false; };
  return search.proceed(frame_, most, meets, is_inside, limit_);
}

double NicheDecider::Stage::passOf(std::uint32_t i, double highest) const {
  const MinimumCandidate& candidate = decider_.judged_[i].candidate;
  const TrianglePair start = frame_.facetPairOf(candidate.a, candidate.b);
  BasinSearch search;  // it may grow large: its memory is not kept
  search.begin(start.a, start.b,
               {candidate.distance - tolerance_, candidate.distance + tolerance_, highest + tolerance_},
               BasinSearch::Purpose::MeasurePass);
  const BasinSearch::End end = proceed(search, std::numeric_limits<std::size_t>::max(), i);
  decider_.counts_.visited_pairs += static_cast<std::uint32_t>(search.lookedAt());
  if (end == BasinSearch::End::Cut) return std::numeric_limits<double>::quiet_NaN();
  if (end == BasinSearch::End::Enclosed) return std::numeric_limits<double>::infinity();
  return std::max(search.highestLevel(), candidate.distance);
}

bool NicheDecider::Stage::followsDown(std::uint32_t i, std::uint32_t number) {
  const double distance = decider_.judged_[i].candidate.distance;
  const auto is_earlier = [&](std::uint32_t other) { return other != i && isEarlier(other, i); };
  DecisionPaths::End end;
  if (!paths_.followDown(number, request_.rule.levelOf(distance), distance - tolerance_, is_earlier, end)) {
    return false;
  }
  set(i, Decision::Ripple, end.into);
  decider_.judged_[i].below = end.facet_pair;
  ++decider_.counts_.by_path;
  return true;
}

void NicheDecider::Stage::resolve(std::uint32_t i) {
  while (i != kNone && decider_.judged_[i].decision == Decision::Ripple) {
    if (decider_.judged_[i].into == kNone) descend(i);
    const std::uint32_t into = decider_.judged_[i].into;
    if (into != kNone && decider_.judged_[into].decision == Decision::Open) decide(into);
    i = into;
  }
}

void NicheDecider::Stage::descend(std::uint32_t i) {
  const TrianglePair from = frame_.closestIn(decider_.judged_[i].below).first;
  const WitnessPair bottom =
      refineWitness(frame_.a, frame_.b, frame_.a_from_b, from.a, from.b, decider_.refinement_).witness;
  const std::uint32_t place = enterPlace(bottom);
  // Strictly down: no way leads in a circle.
  if (place == kNone || decider_.judged_[place].candidate.distance >= decider_.judged_[i].candidate.distance)
    return;
  decider_.judged_[i].into = place;
}

bool NicheDecider::Stage::settlesLong(std::uint32_t i) {
  // Where not all candidates are known, what was found may be deeper than all of them.
  const bool is_deepest = i == deepest_ || !isEarlier(deepest_, i);
  const bool settled = is_deepest ? isNearest(i) : hasPathDown(i);
  decider_.searches_are_long_ = decider_.searches_are_long_ || settled;
  return settled;
}

bool NicheDecider::Stage::isNearest(std::uint32_t i) {
  const MinimumCandidate candidate = decider_.judged_[i].candidate;
  const WitnessPair minimum =
      refineWitness(frame_.a, frame_.b, frame_.a_from_b, candidate.a, candidate.b, decider_.refinement_)
          .witness;
  if (!isNearestOfItsPieces(frame_, minimum)) {
    const TrianglePair pair{candidate.a, candidate.b};
    CertificateRequest certificate;
    certificate.limit = &limit_;
    if (certifyDistance(frame_.a, frame_.b, frame_.a_from_b, &pair, 1, certificate, proof_).lower_bound <
        candidate.distance - tolerance_) {
      return false;
    }
  }
  set(i, Decision::Niche);
  return true;
}

bool NicheDecider::Stage::hasPathDown(std::uint32_t i) {
  std::uint32_t into = kNone;
  const auto has_arrived = [&](TriangleIndex a, TriangleIndex b) {
    into = candidateIn(a, b);
    return into != kNone && into != i && isEarlier(into, i);
  };
  const MinimumCandidate& from = decider_.judged_[i].candidate;
  const MinimumCandidate& to = decider_.judged_[deepest_].candidate;
  for (const int first_moves : {0, 1}) {
    if (BoundedPath(frame_, decider_.path_, limit_)
            .find(frame_.facetPairOf(from.a, from.b), frame_.facetPairOf(to.a, to.b),
                  request_.rule.levelOf(from.distance), first_moves, has_arrived)) {
      set(i, Decision::Ripple, into != kNone && into != i ? into : deepest_);
      return true;
    }
  }
  return false;
}

}  // namespace concave_distance::detail

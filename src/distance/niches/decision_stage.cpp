#include "decision_stage.h"

#include <algorithm>
#include <cmath>

#include "mesh/surface/connected_pieces.h"

namespace concave_distance::detail {

void NicheDecider::Stage::enter(const std::vector<MinimumCandidate>& candidates) {
  were_long_ = decider_.searches_are_long_;
  decider_.searches_are_long_ = false;
  for (const MinimumCandidate& candidate : candidates) {
    const auto index = static_cast<std::uint32_t>(decider_.judged_.size());
    decider_.judged_.emplace_back();
    decider_.judged_.back().candidate = candidate;
    const std::uint32_t number = indexOf(candidate);
    if (number == kNone) continue;
    memory_.enterCandidate(number, index);
  }
  candidate_count_ = decider_.candidate_count_ = static_cast<std::uint32_t>(decider_.judged_.size());
}

std::uint32_t NicheDecider::Stage::placeAround(const TrianglePair& pair) {
  const std::uint32_t in_facet_pair = candidateAround(pair.a, pair.b);
  if (in_facet_pair != kNone) return in_facet_pair;
  return enterPlace(
      refineWitness(frame_.a, frame_.b, frame_.a_from_b, pair.a, pair.b, decider_.refinement_).witness);
}

std::uint32_t NicheDecider::Stage::enterPlace(const WitnessPair& minimum) {
  if (!frame_.areOnSurface(minimum.triangle_a, minimum.triangle_b)) return kNone;
  const MinimumCandidate candidate = frame_.candidateOf(minimum);
  const std::uint32_t in_facet_pair = candidateAround(minimum.triangle_a, minimum.triangle_b);
  // Given candidates may lie a little above the minimum of their facet pair.
  if (in_facet_pair != kNone &&
      decider_.judged_[in_facet_pair].candidate.distance <= candidate.distance + tolerance_) {
    return in_facet_pair;
  }
  const auto begin = decider_.judged_.begin();
  const auto found = begin + candidate_count_;
  const auto is_there = [&](const Judged& other) { return isSamePlace(other.candidate, candidate); };
  const auto is_nearer = [](const Judged& judged, double distance) {
    return judged.candidate.distance < distance;
  };
  const auto nearest = std::lower_bound(begin, found, candidate.distance - tolerance_, is_nearer);
  const auto farthest = std::lower_bound(nearest, found, candidate.distance + 2.0 * tolerance_, is_nearer);
  auto known = std::find_if(nearest, farthest, is_there);
  if (known == farthest) known = std::find_if(found, decider_.judged_.end(), is_there);
  if (known != decider_.judged_.end()) return static_cast<std::uint32_t>(known - begin);
  if (!request_.through_material && isThroughMaterial(minimum)) return kNone;
  decider_.judged_.emplace_back();
  decider_.judged_.back().candidate = candidate;
  decider_.judged_.back().was_found = true;
  return static_cast<std::uint32_t>(decider_.judged_.size() - 1);
}

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
  const std::uint32_t known = memory_.basinOf(number, i);
  if (known == kNone) return;
  DecisionCache::KeptBasin& basin = memory_.basin(known);
  basin.confirmed = isEnclosed(i, known);
  if (basin.confirmed) {
    decider_.judged_[i].basin = basin.id;
    return set(i, Decision::Niche);
  }
}

bool NicheDecider::Stage::isSamePlace(const MinimumCandidate& l, const MinimumCandidate& r) const {
  return l.is_measured && r.is_measured &&
         (l.point_a - r.point_a).squaredNorm() + (l.point_b - r.point_b).squaredNorm() <=
             tolerance_ * tolerance_;
}

std::uint32_t NicheDecider::Stage::deepestLike(std::uint32_t i) {
  const MinimumCandidate& candidate = decider_.judged_[i].candidate;
  const TriangleIndex piece_a{frame_.pieces_a->piece_of_triangle[candidate.a.value]};
  const TriangleIndex piece_b{frame_.pieces_b->piece_of_triangle[candidate.b.value]};
  const std::uint32_t known = decider_.deepest_.find(piece_a, piece_b);
  if (known != PairTable::kAbsent) return known;
  decider_.deepest_.insert(piece_a, piece_b, i);
  return i;
}

}  // namespace concave_distance::detail

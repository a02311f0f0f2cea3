#include <algorithm>

#include "base/refill.h"
#include "decision_stage.h"

// How candidates and places come to be judged.

namespace concave_distance::detail {

void NicheDecider::Stage::enter(const std::vector<MinimumCandidate>& candidates) {
  were_long_ = decider_.searches_are_long_;
  decider_.searches_are_long_ = false;
  decider_.part_candidates_.clear();
  if (request_.overlap != nullptr) {
    refill(decider_.part_candidates_, request_.overlap->parts().size(), kNone);
  }
  for (const MinimumCandidate& candidate : candidates) {
    decider_.judged_.emplace_back();
    decider_.judged_.back().candidate = candidate;
  }
  candidate_count_ = decider_.candidate_count_ = static_cast<std::uint32_t>(decider_.judged_.size());
  if (request_.overlap != nullptr) enterParts();
  for (std::uint32_t i = 0; i < candidate_count_; ++i) {
    const MinimumCandidate& candidate = decider_.judged_[i].candidate;
    if (candidate.part != MinimumCandidate::kNoPart) continue;
    if (const std::uint32_t part = partAround(candidate); part != kNone) {
      set(i, Decision::Ripple, decider_.part_candidates_[part]);
      continue;
    }
    const std::uint32_t number = indexOf(candidate);
    if (number != kNone) memory_.enterCandidate(number, i);
  }
}

// Paths below a margin may join parts; else each is a niche.
void NicheDecider::Stage::enterParts() {
  const OverlapParts& overlap = *request_.overlap;
  bool is_first = true;
  for (std::uint32_t i = 0; i < candidate_count_; ++i) {
    const std::uint32_t part = decider_.judged_[i].candidate.part;
    if (part == MinimumCandidate::kNoPart) continue;
    decider_.part_candidates_[part] = i;
    const OverlapParts::State state = overlap.parts()[part].state;
    if (state == OverlapParts::State::Unknown) set(i, Decision::Undecided);
    if (state == OverlapParts::State::InMaterial) set(i, Decision::Unwanted);
    if (state != OverlapParts::State::Niche) continue;
    decider_.judged_[i].basin = overlap.parts()[part].id;
    deepestLike(i);
    if (is_first || !(request_.rule.margin > 0.0)) set(i, Decision::Niche);
    is_first = false;
  }
  for (std::uint32_t pair = 0; pair < overlap.pairs().size(); ++pair) {
    const MeetingPair& met = overlap.pairs()[pair];
    memory_.enterIfKnown(met.a, met.b, decider_.part_candidates_[overlap.partOf(pair)]);
  }
}

std::uint32_t NicheDecider::Stage::partAround(const MinimumCandidate& candidate) const {
  if (request_.overlap == nullptr || candidate.distance > tolerance_) return kNone;
  const TrianglePair facet_pair = frame_.facetPairOf(candidate.a, candidate.b);
  return request_.overlap->partIn(facet_pair.a, facet_pair.b);
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

}  // namespace concave_distance::detail

#include "decision_stage.h"

#include <algorithm>
#include <cmath>

#include "mesh/surface/connected_pieces.h"

namespace concave_distance::detail {

void NicheDecider::Stage::enter(const std::vector<MinimumCandidate>& seeds) {
  were_long_ = verdicts_.floods_are_long_;
  verdicts_.floods_are_long_ = false;
  for (const MinimumCandidate& seed : seeds) {
    const auto index = static_cast<std::uint32_t>(verdicts_.judged_.size());
    verdicts_.judged_.emplace_back();
    verdicts_.judged_.back().seed = seed;
    const std::uint32_t number = numberOf(seed);
    if (number == kNone) continue;
    memory_.enterSeed(number, index);
  }
  seed_count_ = verdicts_.seed_count_ = static_cast<std::uint32_t>(verdicts_.judged_.size());
}

std::uint32_t NicheDecider::Stage::placeAround(const TrianglePair& pair) {
  const std::uint32_t in_facet_pair = seedAround(pair.a, pair.b);
  if (in_facet_pair != kNone) return in_facet_pair;
  return enterPlace(
      refineWitness(frame_.a, frame_.b, frame_.a_from_b, pair.a, pair.b, verdicts_.refinement_).witness);
}

std::uint32_t NicheDecider::Stage::enterPlace(const WitnessPair& minimum) {
  if (!frame_.areOnSurface(minimum.triangle_a, minimum.triangle_b)) return kNone;
  const MinimumCandidate seed = frame_.candidateOf(minimum);
  const std::uint32_t in_facet_pair = seedAround(minimum.triangle_a, minimum.triangle_b);
  // Given seeds may lie a little above the minimum of their facet pair.
  if (in_facet_pair != kNone &&
      verdicts_.judged_[in_facet_pair].seed.distance <= seed.distance + tolerance_) {
    return in_facet_pair;
  }
  const auto begin = verdicts_.judged_.begin();
  const auto found = begin + seed_count_;
  const auto is_there = [&](const Judged& other) { return isSamePlace(other.seed, seed); };
  const auto is_nearer = [](const Judged& judged, double distance) {
    return judged.seed.distance < distance;
  };
  const auto nearest = std::lower_bound(begin, found, seed.distance - tolerance_, is_nearer);
  const auto farthest = std::lower_bound(nearest, found, seed.distance + 2.0 * tolerance_, is_nearer);
  auto known = std::find_if(nearest, farthest, is_there);
  if (known == farthest) known = std::find_if(found, verdicts_.judged_.end(), is_there);
  if (known != verdicts_.judged_.end()) return static_cast<std::uint32_t>(known - begin);
  if (!request_.through_material && isThroughMaterial(minimum)) return kNone;
  verdicts_.judged_.emplace_back();
  verdicts_.judged_.back().seed = seed;
  verdicts_.judged_.back().was_found = true;
  return static_cast<std::uint32_t>(verdicts_.judged_.size() - 1);
}

void NicheDecider::Stage::decideFar() {
  for (std::uint32_t i = 0; i < verdicts_.judged_.size(); ++i) {
    if (verdicts_.judged_[i].verdict != Verdict::Open) continue;
    const std::uint32_t deepest = deepestLike(i);
    set(i, deepest == i ? Verdict::Niche : Verdict::Ripple, deepest == i ? kNone : deepest);
  }
}

void NicheDecider::Stage::decideByMemory() {
  std::size_t niches = 0;
  for (std::uint32_t& end = verdicts_.end_; end < seed_count_ && niches < request_.most_niches; ++end) {
    if (verdicts_.judged_[end].verdict == Verdict::Open) decideByMemory(end);
    niches += verdicts_.judged_[end].verdict == Verdict::Niche ? 1 : 0;
  }
}

void NicheDecider::Stage::decideByFloods() {
  if (limit_.isTimed()) floodInTurn();
  std::size_t niches = 0;
  for (std::uint32_t& i = verdicts_.next_; i < verdicts_.end_ && niches < request_.most_niches; ++i) {
    if (verdicts_.judged_[i].verdict == Verdict::Open) flood(i);
    niches += verdicts_.judged_[i].verdict == Verdict::Niche ? 1 : 0;
  }
  verdicts_.end_ = verdicts_.next_;
}

void NicheDecider::Stage::decideByMemory(std::uint32_t i) {
  const MinimumCandidate seed = verdicts_.judged_[i].seed;
  deepest_ = deepestLike(i);
  const std::uint32_t number = numberOf(seed);
  if (number == kNone) return set(i, Verdict::Undecided);
  if (const std::uint32_t other = memory_.candidateOf(number);
      other != kNone && other != i && isEarlier(other, i)) {
    return set(i, Verdict::Ripple, other);
  }
  if (i > 0 && i < seed_count_ && isSamePlace(verdicts_.judged_[i - 1].seed, seed))
    return set(i, Verdict::Ripple, i - 1);
  if (followsDown(i, number)) return;
  if (request_.is_wanted && !request_.is_wanted(seed, memory_.facet_pair(number).occluder)) {
    return set(i, Verdict::Unwanted);
  }
  // Only then do seeds lie on both sides of a closed shell (collectConeItems()).
  if (!request_.through_material && frame_.hasJoints() && isThroughMaterial(frame_.witnessOf(seed))) {
    return set(i, Verdict::Unwanted);
  }
  const std::uint32_t known = memory_.regionOf(number, i);
  if (known == kNone) return;
  DecisionCache::Region& region = memory_.region(known);
  region.confirmed = isEnclosed(i, known);
  if (region.confirmed) {
    verdicts_.judged_[i].region = region.id;
    return set(i, Verdict::Niche);
  }
}

bool NicheDecider::Stage::isSamePlace(const MinimumCandidate& l, const MinimumCandidate& r) const {
  return l.is_measured && r.is_measured &&
         (l.point_a - r.point_a).squaredNorm() + (l.point_b - r.point_b).squaredNorm() <=
             tolerance_ * tolerance_;
}

std::uint32_t NicheDecider::Stage::deepestLike(std::uint32_t i) {
  const MinimumCandidate& seed = verdicts_.judged_[i].seed;
  const TriangleIndex piece_a{frame_.pieces_a->piece_of_triangle[seed.a.value]};
  const TriangleIndex piece_b{frame_.pieces_b->piece_of_triangle[seed.b.value]};
  const std::uint32_t known = verdicts_.deepest_.find(piece_a, piece_b);
  if (known != PairTable::kAbsent) return known;
  verdicts_.deepest_.insert(piece_a, piece_b, i);
  return i;
}

}  // namespace concave_distance::detail

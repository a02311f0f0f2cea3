#include "decision_stage.h"

#include <algorithm>
#include <cmath>

#include "distant_components.h"

// These members prove ripples: by paths from facet pair to facet pair to deeper places (doc/proofs.md).

namespace concave_distance::detail {
namespace {

/// Steps of a path that are followed: links of different times may lead in a circle.
constexpr int kLongestPath = 256;

}  // namespace

void NicheDecider::Stage::resolve(std::uint32_t i) {
  while (i != kNone && decider_.judged_[i].decision == Decision::Ripple) {
    if (decider_.judged_[i].into == kNone) descend(i);
    const std::uint32_t into = decider_.judged_[i].into;
    if (into != kNone && decider_.judged_[into].decision == Decision::Open) decide(into);
    i = into;
  }
}

bool NicheDecider::Stage::followsDown(std::uint32_t i, std::uint32_t number) {
  const double distance = decider_.judged_[i].candidate.distance;
  const double level = request_.rule.levelOf(distance);
  const double below = distance - tolerance_;
  const auto settle = [&](std::uint32_t into, std::uint32_t facet_pair) {
    set(i, Decision::Ripple, into);
    decider_.judged_[i].below = {memory_.facet_pair(facet_pair).a, memory_.facet_pair(facet_pair).b};
    ++decider_.counts_.by_path;
    return true;
  };
  for (int step = 0; step < kLongestPath; ++step) {
    const DecisionCache::FacetPair& facet_pair = memory_.facet_pair(number);
    const std::uint32_t other = step > 0 ? memory_.candidateOf(number) : kNone;
    if (other != kNone && other != i && isEarlier(other, i)) return settle(other, number);
    if (below > 0.0 && facet_pair.low != kNone &&
        (squaredLevelOf(memory_.link(facet_pair.low)) < below * below ||
         (facet_pair.link == kNone && aimLow(number) < below * below))) {
      memory_.use(facet_pair.low);
      return settle(kNone, number);
    }
    if (facet_pair.link == kNone) return false;
    double squared_level = squaredLevelOf(memory_.link(facet_pair.link));
    if (!(squared_level < level * level)) squared_level = aim(facet_pair.link);
    if (!(squared_level < level * level)) return false;
    memory_.use(facet_pair.link);
    number = memory_.link(facet_pair.link).next;
    if (below > 0.0 && squared_level < below * below) return settle(kNone, number);
  }
  return false;
}

double NicheDecider::Stage::aim(std::uint32_t link, const TrianglePairDistance& closest) {
  ++decider_.counts_.aimed;
  memory_.aim(link, closest.point_a, frame_.pointInB(closest.point_b));
  return closest.squared_distance;
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
    into = memory_.candidateIn(a, b);
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

void NicheDecider::Stage::keepPath(std::uint32_t start) {
  const std::vector<BasinSearch::FacetPair>& visited = decider_.search_.facet_pairs();
  std::uint32_t at = decider_.search_.last();
  std::uint32_t next = memory_.facetPairOf(visited[at].a, visited[at].b, limit_);
  while (next != kNone && visited[at].parent != BasinSearch::kNone) {
    const BasinSearch::FacetPair& here = visited[at];
    const std::uint32_t before =
        here.parent == 0 ? start
                         : memory_.facetPairOf(visited[here.parent].a, visited[here.parent].b, limit_);
    if (before == kNone ||
        !keepLink(memory_.facet_pair(before).link, closestOver(frame_, here.via), next, here.via))
      return;
    next = before;
    at = here.parent;
  }
}

void NicheDecider::Stage::keepLow(TriangleIndex a, TriangleIndex b) {
  const std::uint32_t number = memory_.facetPairOf(a, b, limit_);
  if (number == kNone) return;
  keepLink(memory_.facet_pair(number).low, frame_.closestIn({a, b}).second, number, {});
}

bool NicheDecider::Stage::keepLink(std::uint32_t& link, const TrianglePairDistance& closest,
                                   std::uint32_t next, const SharedElement& via) {
  return memory_.keepLink(link, {closest.point_a, frame_.pointInB(closest.point_b), next, via}, limit_);
}

}  // namespace concave_distance::detail

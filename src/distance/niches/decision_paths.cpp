#include "decision_stage.h"

#include <algorithm>
#include <cmath>

#include "distant_components.h"

// Ripples: ways from facet pair to facet pair down to deeper places (doc/proofs.md).

namespace concave_distance::detail {
namespace {

/// Steps of a path that are followed: links of different times may lead in a circle.
constexpr int kLongestPath = 256;

}  // namespace

void NicheDecider::Stage::resolve(std::uint32_t i) {
  while (i != kNone && verdicts_.judged_[i].verdict == Verdict::Ripple) {
    if (verdicts_.judged_[i].into == kNone) descend(i);
    const std::uint32_t into = verdicts_.judged_[i].into;
    if (into != kNone && verdicts_.judged_[into].verdict == Verdict::Open) decide(into);
    i = into;
  }
}

bool NicheDecider::Stage::followsDown(std::uint32_t i, std::uint32_t number) {
  const double distance = verdicts_.judged_[i].seed.distance;
  const double level = levelOf(distance);
  const double below = distance - tolerance_;
  const auto settle = [&](std::uint32_t into, std::uint32_t facet_pair) {
    set(i, Verdict::Ripple, into);
    verdicts_.judged_[i].below = {memory_.facet_pair(facet_pair).a, memory_.facet_pair(facet_pair).b};
    ++verdicts_.counts_.by_path;
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
  ++verdicts_.counts_.aimed;
  memory_.aim(link, closest.point_a, frame_.pointInB(closest.point_b));
  return closest.squared_distance;
}

void NicheDecider::Stage::descend(std::uint32_t i) {
  const TrianglePair from = frame_.closestIn(verdicts_.judged_[i].below).first;
  const WitnessPair bottom =
      refineWitness(frame_.a, frame_.b, frame_.a_from_b, from.a, from.b, verdicts_.refinement_).witness;
  const std::uint32_t place = enterPlace(bottom);
  // Strictly down: no way leads in a circle.
  if (place == kNone || verdicts_.judged_[place].seed.distance >= verdicts_.judged_[i].seed.distance) return;
  verdicts_.judged_[i].into = place;
}

bool NicheDecider::Stage::settlesLong(std::uint32_t i) {
  // Where not all seeds are known, what was found may be deeper than all of them.
  const bool is_deepest = i == deepest_ || !isEarlier(deepest_, i);
  const bool settled = is_deepest ? isNearest(i) : hasPathDown(i);
  verdicts_.floods_are_long_ = verdicts_.floods_are_long_ || settled;
  return settled;
}

bool NicheDecider::Stage::isNearest(std::uint32_t i) {
  const MinimumCandidate seed = verdicts_.judged_[i].seed;
  const WitnessPair minimum =
      refineWitness(frame_.a, frame_.b, frame_.a_from_b, seed.a, seed.b, verdicts_.refinement_).witness;
  if (!isNearestOfItsPieces(frame_, minimum)) {
    const TrianglePair pair{seed.a, seed.b};
    CertificateRequest certificate;
    certificate.limit = &limit_;
    if (certifyDistance(frame_.a, frame_.b, frame_.a_from_b, &pair, 1, certificate, proof_).lower_bound <
        seed.distance - tolerance_) {
      return false;
    }
  }
  set(i, Verdict::Niche);
  return true;
}

bool NicheDecider::Stage::hasPathDown(std::uint32_t i) {
  std::uint32_t into = kNone;
  const auto has_arrived = [&](TriangleIndex a, TriangleIndex b) {
    into = memory_.seedIn(a, b);
    return into != kNone && into != i && isEarlier(into, i);
  };
  const MinimumCandidate& from = verdicts_.judged_[i].seed;
  const MinimumCandidate& to = verdicts_.judged_[deepest_].seed;
  for (const int first_moves : {0, 1}) {
    if (BoundedPath(frame_, verdicts_.path_, limit_)
            .find(frame_.facetPairOf(from.a, from.b), frame_.facetPairOf(to.a, to.b), levelOf(from.distance),
                  first_moves, has_arrived)) {
      set(i, Verdict::Ripple, into != kNone && into != i ? into : deepest_);
      return true;
    }
  }
  return false;
}

void NicheDecider::Stage::keepPath(std::uint32_t start) {
  const std::vector<BasinSearch::FacetPair>& visited = verdicts_.flood_.facet_pairs();
  std::uint32_t at = verdicts_.flood_.last();
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

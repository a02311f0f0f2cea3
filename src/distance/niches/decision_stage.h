#pragma once

#include "niche_decider.h"

namespace concave_distance::detail {

/// One call of judge().
class NicheDecider::Stage {
 public:
  Stage(NicheDecider& verdicts, const PairFrame& frame, const Request& request, WorkLimit& limit)
      : verdicts_(verdicts),
        memory_(verdicts.memory_),
        frame_(frame),
        request_(request),
        limit_(limit),
        tolerance_(8.0 * frame.rounding) {}

  /// Every seed with its facet pair, and every region with the deepest seed in it.
  void enter(const std::vector<MinimumCandidate>& seeds);

  /// Goes on with what enter() of an earlier stage at this pose has left.
  void resume() {
    seed_count_ = verdicts_.seed_count_;
    were_long_ = verdicts_.floods_are_long_;
  }

  std::uint32_t placeAround(const TrianglePair& pair);

  /// The minimum among the judged: the seed at its place, or an entry of its own; kNone through or in
  /// material.
  std::uint32_t enterPlace(const WitnessPair& minimum);

  void decideFar();

  /// The next ones that are known, until there are as many niches as wanted.
  void decideByMemory();

  /// Those that it has left open, in ascending order until there are as many niches as wanted.
  void decideByFloods();

  /// Where time may be short, others come first in every cycle.
  void floodInTurn();

  void decide(std::uint32_t i) {
    decideByMemory(i);
    if (verdicts_.judged_[i].verdict == Verdict::Open) flood(i);
  }

  /// The next deeper minimum of a ripple of which only a deeper place is known.
  void resolve(std::uint32_t i);

 private:
  /// Leaves open what is not known.
  void decideByMemory(std::uint32_t i);

  bool isThroughMaterial(const WitnessPair& minimum) const {
    return classifyOutwardness(frame_.a, frame_.b, frame_.a_from_b, minimum) == Outwardness::ThroughMaterial;
  }

  /// The index of the seed's facet pair; kNone without memory.
  std::uint32_t numberOf(const MinimumCandidate& seed) {
    const TrianglePair facet_pair = frame_.facetPairOf(seed.a, seed.b);
    return memory_.facetPairOf(facet_pair.a, facet_pair.b, limit_);
  }

  /// The seed in the facet pair of a triangle pair.
  std::uint32_t seedAround(TriangleIndex a, TriangleIndex b) const {
    const TrianglePair facet_pair = frame_.facetPairOf(a, b);
    return memory_.seedIn(facet_pair.a, facet_pair.b);
  }

  /// Up to here nothing deeper may be reached.
  double levelOf(double distance) const { return (1.0 + request_.least_prominence) * distance; }

  void set(std::uint32_t i, Verdict verdict, std::uint32_t into = kNone) {
    verdicts_.judged_[i].verdict = verdict;
    verdicts_.judged_[i].into = into;
  }

  /// Seeds are in ascending order; what is no seed belongs to one as deep as itself.
  bool isEarlier(std::uint32_t other, std::uint32_t i) const {
    if (i < seed_count_) return other < i;
    return verdicts_.judged_[other].seed.distance <= verdicts_.judged_[i].seed.distance + tolerance_;
  }

  /// Where shells of one body lie on each other, both have the minimum.
  bool isSamePlace(const MinimumCandidate& l, const MinimumCandidate& r) const;

  std::uint32_t deepestLike(std::uint32_t i);

  double squaredLevelOf(const DecisionCache::Link& link) const {
    return (frame_.rotation * link.point_b + frame_.offset - link.point_a).squaredNorm();
  }

  /// Whether known links lead below the start or to an earlier seed without rising to its level.
  bool followsDown(std::uint32_t i, std::uint32_t number);

  /// Gives a link the points at which the facet pairs are closest over what they have in common, and their
  /// squared distance.
  double aim(std::uint32_t link) { return aim(link, closestOver(frame_, memory_.link(link).via)); }

  /// The same for the points in a facet pair.
  double aimLow(std::uint32_t number) {
    const DecisionCache::FacetPair& facet_pair = memory_.facet_pair(number);
    return aim(facet_pair.low, frame_.closestIn({facet_pair.a, facet_pair.b}).second);
  }

  double aim(std::uint32_t link, const TrianglePairDistance& closest);

  BasinSearch::Levels levelsOf(double distance) const {
    return {distance - tolerance_, distance + tolerance_, levelOf(distance) + tolerance_};
  }

  /// Whether the border around a region holds, or does so again with the facet pairs beyond where it does
  /// not. The border is whole afterwards in either case, because a region may be asked for again at this pose
  /// or the next one; the region is dropped where memory does not suffice for that.
  bool isEnclosed(std::uint32_t i, std::uint32_t index);
  /// Floods the facet pairs beyond the elements that have left the region's border.
  BasinSearch::End floodBeyond(std::uint32_t i, std::uint32_t index, const BasinSearch::Levels& levels);
  /// Puts these elements back.
  void restoreBorder(std::uint32_t index);

  /// Whether a facet pair is that of a minimum that i would belong to.
  bool isOfEarlier(TriangleIndex a, TriangleIndex b, std::uint32_t i) const {
    const std::uint32_t other = memory_.seedIn(a, b);
    return other != kNone && other != i && isEarlier(other, i);
  }

  void flood(std::uint32_t i);

  /// From the place below a ripple to the minimum under it.
  void descend(std::uint32_t i);

  /// Replaces a long flood: the deepest of its pieces is a niche if it is their nearest place; another one is
  /// none if a path leads from it to one that is deeper.
  bool settlesLong(std::uint32_t i);

  /// Seeds may leave out minima through material, so the deepest seed need not be the nearest place.
  bool isNearest(std::uint32_t i);

  bool hasPathDown(std::uint32_t i);

  /// The links of the way from the start of the last flood to its end.
  void keepPath(std::uint32_t start);

  void keepLow(TriangleIndex a, TriangleIndex b);

  bool keepLink(std::uint32_t& link, const TrianglePairDistance& closest, std::uint32_t next,
                const SharedElement& via);

  /// What the last flood has visited.
  void keepRegion(std::uint32_t i, std::uint64_t id);

  /// By what the last flood has visited. False without memory.
  bool extend(std::uint32_t index);

  NicheDecider& verdicts_;
  DecisionCache& memory_;
  const PairFrame& frame_;
  const Request& request_;
  WorkLimit& limit_;
  CertificateWorkspace proof_;
  double tolerance_;
  bool were_long_ = false;  ///< floods, the last time
  std::uint32_t seed_count_ = 0;
  std::uint32_t deepest_ = kNone;  ///< of the pieces of the one that is decided
};

}  // namespace concave_distance::detail

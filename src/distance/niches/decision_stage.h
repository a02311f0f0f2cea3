#pragma once

#include "decision_basins.h"
#include "decision_paths.h"

namespace concave_distance::detail {

/// Decides candidates at one pose; a stage lives for one call of its decider.
class NicheDecider::Stage {
 public:
  Stage(NicheDecider& decider, const PairFrame& frame, const Request& request, WorkLimit& limit)
      : decider_(decider),
        memory_(decider.memory_),
        frame_(frame),
        request_(request),
        limit_(limit),
        paths_(memory_, frame, decider.counts_, limit),
        basins_(memory_, decider.search_, frame, decider.counts_, limit),
        tolerance_(meetingTolerance(frame)) {}

  /// Enters the candidates into their facet pairs and the deepest of each kept basin into the basin. Decides
  /// those of parts of the overlap.
  void enter(const std::vector<MinimumCandidate>& candidates);

  /// Goes on with what enter() of an earlier stage at this pose has left.
  void resume() {
    candidate_count_ = decider_.candidate_count_;
    were_long_ = decider_.searches_are_long_;
  }

  /// Returns the place of the local minimum around a triangle pair.
  std::uint32_t placeAround(const TrianglePair& pair);

  /// Returns the judged candidate at a minimum's place, entered where there is none; kNone when the minimum
  /// lies in material or its segment runs through it.
  std::uint32_t enterPlace(const WitnessPair& minimum);

  /// Decides all candidates of bodies that are far apart: the nearest of each pair of components is a niche.
  void decideFar();

  /// Decides the next candidates that kept evidence settles, until there are as many niches as wanted.
  void decideByMemory();

  /// Searches the basins of those left open, in ascending order, until there are as many niches as wanted.
  void decideBySearches();

  /// Searches the basins of those left open, beginning with others in every cycle: time may end it.
  void searchInTurn();

  void decide(std::uint32_t i) {
    decideByMemory(i);
    if (decider_.judged_[i].decision == Decision::Open) search(i);
  }

  /// Follows a ripple to the niche it leads to, through minima of which only a deeper place was known.
  void resolve(std::uint32_t i);

  /// Implements NicheDecider::passOf().
  double passOf(std::uint32_t i, double highest) const;

 private:
  /// Returns whether no path can lead to a nearer place: the distance is the proven one, but for errors.
  bool isNearestOfAll(double distance) const {
    return request_.certain_distance > 4.0 * tolerance_ &&
           distance <= request_.certain_distance + 4.0 * tolerance_;
  }

  /// Decides a candidate by kept evidence, or leaves it open.
  void decideByMemory(std::uint32_t i);

  bool isThroughMaterial(const WitnessPair& minimum) const {
    return classifyOutwardness(frame_.a, frame_.b, frame_.a_from_b, minimum) == Outwardness::ThroughMaterial;
  }

  /// Returns the number of the candidate's facet pair in the cache; kNone without memory.
  std::uint32_t indexOf(const MinimumCandidate& candidate) {
    const TrianglePair facet_pair = frame_.facetPairOf(candidate.a, candidate.b);
    return memory_.facetPairOf(facet_pair.a, facet_pair.b, limit_);
  }

  /// Enters the candidates of the overlap's parts into all facet pairs of each.
  void enterParts();
  /// Returns the part of the overlap of which a candidate is, though it does not stand for it; or kNone.
  std::uint32_t partAround(const MinimumCandidate& candidate) const;

  /// Returns the candidate in a facet pair, that of its part where the bodies meet there; or kNone.
  std::uint32_t candidateIn(TriangleIndex a, TriangleIndex b) const {
    if (request_.overlap != nullptr) {
      const std::uint32_t part = request_.overlap->partIn(a, b);
      if (part != OverlapParts::kNone) return decider_.part_candidates_[part];
    }
    return memory_.candidateIn(a, b);
  }
  /// Returns the candidate in the facet pair of a triangle pair, or kNone.
  std::uint32_t candidateAround(TriangleIndex a, TriangleIndex b) const {
    const TrianglePair facet_pair = frame_.facetPairOf(a, b);
    return candidateIn(facet_pair.a, facet_pair.b);
  }

  void set(std::uint32_t i, Decision decision, std::uint32_t into = kNone) {
    decider_.judged_[i].decision = decision;
    decider_.judged_[i].into = into;
  }

  /// True when `other` precedes i in depth. Candidates ascend; a place found by a search ranks by distance.
  bool isEarlier(std::uint32_t other, std::uint32_t i) const {
    if (i < candidate_count_) return other < i;
    return decider_.judged_[other].candidate.distance <= decider_.judged_[i].candidate.distance + tolerance_;
  }

  /// True for one minimum that two shells of a body have, because they lie on each other.
  bool isSamePlace(const MinimumCandidate& l, const MinimumCandidate& r) const {
    return l.is_measured && r.is_measured &&
           (l.point_a - r.point_a).squaredNorm() + (l.point_b - r.point_b).squaredNorm() <=
               tolerance_ * tolerance_;
  }

  /// Returns the deepest candidate of the components that i lies on.
  std::uint32_t deepestLike(std::uint32_t i) {
    const MinimumCandidate& candidate = decider_.judged_[i].candidate;
    const TriangleIndex piece_a{frame_.pieces_a->piece_of_triangle[candidate.a.value]};
    const TriangleIndex piece_b{frame_.pieces_b->piece_of_triangle[candidate.b.value]};
    const std::uint32_t known = decider_.deepest_.find(piece_a, piece_b);
    if (known != PairTable::kAbsent) return known;
    decider_.deepest_.insert(piece_a, piece_b, i);
    return i;
  }

  /// Follows kept links; true when they lead below i or to an earlier candidate and stay below i's level.
  bool followsDown(std::uint32_t i, std::uint32_t number);

  BasinSearch::Levels levelsOf(double distance) const {
    return {distance - tolerance_, distance + tolerance_, request_.rule.levelOf(distance) + tolerance_};
  }

  /// True when a facet pair holds a minimum that i would belong to.
  bool isOfEarlier(TriangleIndex a, TriangleIndex b, std::uint32_t i) const {
    const std::uint32_t other = candidateIn(a, b);
    return other != kNone && other != i && isEarlier(other, i);
  }

  /// Decides a candidate by a search of its basin and keeps what proves the decision.
  void search(std::uint32_t i);
  /// Begins a search at all facet pairs where a candidate is. Returns false without memory.
  bool beginSearch(std::uint32_t i, const TrianglePair& start);

  /// Goes on with a search for candidate i at most so far, ending where it meets a place of an earlier one.
  BasinSearch::End proceed(BasinSearch& search, std::size_t most, std::uint32_t i) const;

  /// Descends from the place below a ripple to the minimum under it.
  void descend(std::uint32_t i);

  /// Replaces a long search: the deepest candidate of two components is a niche if it is their nearest place;
  /// another one is none if a path leads from it to one that is deeper.
  bool settlesLong(std::uint32_t i);

  /// True when no place of its components is nearer, which minima through material may be.
  bool isNearest(std::uint32_t i);

  bool hasPathDown(std::uint32_t i);

  NicheDecider& decider_;
  DecisionCache& memory_;
  const PairFrame& frame_;
  const Request& request_;
  WorkLimit& limit_;
  DecisionPaths paths_;
  DecisionBasins basins_;
  CertificateWorkspace proof_;
  double tolerance_;
  bool were_long_ = false;  ///< searches, the last time
  std::uint32_t candidate_count_ = 0;
  std::uint32_t deepest_ = kNone;  ///< of the pieces of the one that is decided
};

}  // namespace concave_distance::detail

#pragma once

#include "niche_decider.h"

namespace concave_distance::detail {

/// Proves ripples at one pose: keeps paths from facet pair to facet pair that lead to deeper places, and
/// follows them at later poses (doc/proofs.md).
class DecisionPaths {
 public:
  static constexpr std::uint32_t kNone = DecisionCache::kNone;

  /// The end of a path that leads down.
  struct End {
    std::uint32_t into = kNone;  ///< an earlier candidate, if the path has met one
    TrianglePair facet_pair;
  };

  DecisionPaths(DecisionCache& memory, const PairFrame& frame, NicheDecider::Counts& counts, WorkLimit& limit)
      : memory_(memory), frame_(frame), counts_(counts), limit_(limit) {}

  /// Follows kept links from a facet pair while they stay below `level` (m).
  /// @param is_earlier (candidate) whether the path may end at it
  /// @return true when the path leads to such a candidate or to a distance below `below` (m)
  template <typename IsEarlier>
  bool followDown(std::uint32_t number, double level, double below, const IsEarlier& is_earlier, End& end) {
    const auto arrive = [&](std::uint32_t into) {
      end = {into, {memory_.facet_pair(number).a, memory_.facet_pair(number).b}};
      return true;
    };
    for (int step = 0; step < kLongestPath; ++step) {
      const std::uint32_t other = step > 0 ? memory_.candidateOf(number) : kNone;
      if (other != kNone && is_earlier(other)) return arrive(other);
      if (below > 0.0 && comesBelow(number, below)) return arrive(kNone);
      const std::uint32_t link = memory_.facet_pair(number).link;
      if (link == kNone) return false;
      double squared_level = squaredLevelOf(memory_.link(link));
      if (!(squared_level < level * level)) squared_level = aim(link);
      if (!(squared_level < level * level)) return false;
      memory_.use(link);
      number = memory_.link(link).next;
      if (below > 0.0 && squared_level < below * below) return arrive(kNone);
    }
    return false;
  }

  /// Keeps the path from the facet pair `start` to the end of the search that began there.
  void keepPath(const BasinSearch& search, std::uint32_t start);
  /// Keeps the closest points in a facet pair.
  void keepLow(const TrianglePair& facet_pair);

 private:
  /// The number of links followed is limited: links of different poses may lead in a circle.
  static constexpr int kLongestPath = 256;

  /// True when the kept points in a facet pair are closer than `below` (m); uses them.
  bool comesBelow(std::uint32_t number, double below);

  double squaredLevelOf(const DecisionCache::Link& link) const {
    return (frame_.rotation * link.point_b + frame_.offset - link.point_a).squaredNorm();
  }

  /// Moves a link to the closest points over what its facet pairs share. Returns their squared distance
  /// (m^2).
  double aim(std::uint32_t link) { return aim(link, closestOver(frame_, memory_.link(link).via)); }
  double aim(std::uint32_t link, const TrianglePairDistance& closest);

  void keepLink(std::uint32_t& link, const TrianglePairDistance& closest, std::uint32_t next,
                const SharedElement& via);

  DecisionCache& memory_;
  const PairFrame& frame_;
  NicheDecider::Counts& counts_;
  WorkLimit& limit_;
};

}  // namespace concave_distance::detail

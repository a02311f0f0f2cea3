#pragma once

#include <cstdint>
#include <vector>

#include "meeting_pairs.h"
#include "overlap_sets.h"

namespace concave_distance::detail {

/// Finds the connected parts of the bodies' overlap that have places where the surfaces meet, each one niche
/// at distance 0 (doc/proofs.md, "Connected parts of an overlap"). Belongs to one pair of bodies: it keeps
/// which pairs of facets met in which part, so that a part goes on from pose to pose.
class OverlapParts {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  enum class State : std::uint8_t {
    Niche,
    InMaterial,  ///< its surfaces meet only in the material of other shells: none of it is seen
    Unknown      ///< the limit was reached: it may be a part of another one
  };
  struct Part {
    State state = State::Niche;
    TrianglePair triangles;   ///< that meet there: the niche's place
    double distance = 0.0;    ///< metres, of them; above 0 only by rounding
    std::uint64_t id = 0;     ///< if tracked: the same from pose to pose
    std::uint32_t first = 0;  ///< of its pairs in order_
    std::uint32_t last = 0;
  };

  /// Finds the parts at a pose. The frame's facets are open.
  /// @return false when the limit was reached: parts are missing or unknown
  bool find(const PairFrame& frame, bool is_tracked, LocalMinimaCost& cost, WorkLimit& limit);
  /// Says that the surfaces are apart at this pose.
  void findNone();

  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<MeetingPair>& pairs() const { return met_.pairs(); }
  /// The part of each of pairs().
  std::uint32_t partOf(std::uint32_t pair) const { return part_of_pair_[pair]; }
  /// Returns the part that holds a facet pair, or kNone.
  std::uint32_t partIn(TriangleIndex a, TriangleIndex b) const {
    const std::uint32_t pair = met_.find(a, b);
    return pair == MeetingPairs::kNone ? kNone : part_of_pair_[pair];
  }

  /// Tells the ids of parts from other numbers.
  static bool isPartId(std::uint64_t id) { return (id & kIdBit) != 0; }
  /// Returns the part that a part of the last pose has become, or kNone where no pair of facets of it meets
  /// any more.
  std::uint32_t heirOf(std::uint64_t id) const;
  /// Calls visit(facet pair) for some of the pairs of a part of the last pose, until it returns true.
  template <typename Visit>
  void forSomePairsOf(std::uint64_t id, const Visit& visit) const {
    for (const Earlier& part : earlier_) {
      if (part.id != id) continue;
      const std::uint32_t step = 1 + (part.last - part.first) / kMostSamples;
      for (std::uint32_t k = part.first; k < part.last; k += step) {
        if (visit(earlier_pairs_[k])) return;
      }
    }
  }

 private:
  static constexpr std::uint64_t kIdBit = std::uint64_t{1} << 63U;
  static constexpr std::uint32_t kMostSamples = 8;
  /// A part of the last pose, its pairs in earlier_pairs_, that of its niche first.
  struct Earlier {
    std::uint64_t id;
    std::uint32_t first;
    std::uint32_t last;
    std::uint32_t heir;
  };

  void keepEarlier();
  bool findSets(const PairFrame& frame, LocalMinimaCost& cost, WorkLimit& limit);
  void numberParts();
  bool choosePlaces(const PairFrame& frame, WorkLimit& limit);
  void inherit();

  MeetingPairs met_;
  OverlapSets sets_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> part_of_pair_;
  std::vector<std::uint32_t> order_;  ///< of pairs, by part
  std::vector<Earlier> earlier_;
  std::vector<TrianglePair> earlier_pairs_;
  std::uint64_t parts_made_ = 0;
};

}  // namespace concave_distance::detail

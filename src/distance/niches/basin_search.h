#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/pair_table.h"
#include "concave_distance/base/work_limit.h"
#include "facet_pair_neighbours.h"

namespace concave_distance::detail {

/// Visits facet pairs (a facet of each body) from the one that holds a local minimum, lowest levels first.
/// The distance is convex on a facet pair, and facet pairs meet at the least distance over what they share: a
/// graph with the very basins and passes of the surfaces. Buffers of one thread, kept from search to search.
class BasinSearch {
 public:
  /// Metres.
  struct Levels {
    double below;    ///< ends at a facet pair with less
    double equal;    ///< facet pairs with at most this may be those of another minimum
    double highest;  ///< goes no higher
  };
  /// Says what the search is for: to decide, it takes any path below the highest level; to measure a pass,
  /// the lowest path to each facet pair, which costs more.
  enum class Purpose : std::uint8_t { Decide, MeasurePass };
  enum class End : std::uint8_t {
    Enclosed,  ///< all that is connected below the level has been visited
    Below,     ///< last() comes closer than `below`
    Met,       ///< last() is the facet pair of another minimum
    Long,      ///< as many facet pairs as asked for were visited; proceed() goes on
    Cut        ///< the limit was reached
  };
  static constexpr std::uint32_t kNone = 0xffffffffU;
  struct FacetPair {
    TriangleIndex a;  ///< facets, as all below
    TriangleIndex b;
    std::uint32_t parent;  ///< where it was reached from; kNone for the first
    SharedElement via;     ///< what it has in common with its parent
  };
  /// An element that parts the facet pairs visited from one beyond the level.
  struct BoundaryStep {
    TriangleIndex beyond_a;
    TriangleIndex beyond_b;
    double squared_level;  ///< m^2, over the element
    SharedElement element;
  };

  /// From the facet pair of a minimum.
  void begin(TriangleIndex a, TriangleIndex b, const Levels& levels, Purpose purpose = Purpose::Decide) {
    beginBeyond(levels);
    measures_pass_ = purpose == Purpose::MeasurePass;
    enter(a, b, 0.0, kNone, {});
    has_own_start_ = true;
  }
  /// From facet pairs beyond a boundary, given by enterBeyond().
  void beginBeyond(const Levels& levels) {
    levels_ = levels;
    table_.clear();
    facet_pairs_.clear();
    reached_.clear();
    boundary_.clear();
    looked_at_ = 0;
    highest_ = 0.0;
    has_own_start_ = false;
    measures_pass_ = false;
    is_visited_.clear();
  }
  /// False when the limit admits no more facet pairs.
  bool enterBeyond(TriangleIndex a, TriangleIndex b, double squared_level, WorkLimit& limit) {
    if (table_.find(a, b) != PairTable::kAbsent) return true;
    if (!limit.admits(facet_pairs_.size() + 1)) return false;
    enter(a, b, squared_level, kNone, {});
    return true;
  }

  /// @param meets (facet of A, facet of B) whether a facet pair as deep as the start is another minimum's
  /// @param is_inside (the same) whether a facet pair needs no visit
  template <typename Meets, typename IsInside>
  End proceed(const PairFrame& frame, std::size_t most_facet_pairs, const Meets& meets,
              const IsInside& is_inside, WorkLimit& limit) {
    while (!reached_.empty()) {
      if (limit.isOverNow()) return End::Cut;
      if (looked_at_ == most_facet_pairs) return End::Long;
      std::pop_heap(reached_.begin(), reached_.end(), isHigher);
      const Reached next = reached_.back();
      reached_.pop_back();
      if (measures_pass_) {
        if (is_visited_[next.facet_pair] != 0) continue;
        is_visited_[next.facet_pair] = 1;
        highest_ = std::max(highest_, next.squared_level);
      }
      last_ = next.facet_pair;
      ++looked_at_;
      const TriangleIndex a = facet_pairs_[last_].a;
      const TriangleIndex b = facet_pairs_[last_].b;
      const FacetPoints points_a = frame.facetOfA(a);
      const FacetPoints points_b = frame.facetOfB(b);
      const FacetPairLevels levels = facetPairLevels(points_a, points_b);
      const double least = levels.least();
      if (levels_.below > 0.0 && least < levels_.below * levels_.below) return End::Below;
      const bool is_own = has_own_start_ && last_ == 0;
      if (!is_own && least <= levels_.equal * levels_.equal && meets(a, b)) return End::Met;
      if (!expand(frame, a, b, points_a, points_b, levels, is_inside, limit)) return End::Cut;
    }
    return End::Enclosed;
  }

  const std::vector<FacetPair>& facet_pairs() const { return facet_pairs_; }
  std::uint32_t last() const { return last_; }
  std::size_t lookedAt() const { return looked_at_; }
  /// The level (metres) to which a search for a pass has risen.
  double highestLevel() const { return std::sqrt(highest_); }

  /// Returns the index of a facet pair in facet_pairs(), or kNone.
  std::uint32_t indexOf(TriangleIndex a, TriangleIndex b) const { return table_.find(a, b); }
  /// Says of each of facet_pairs() whether it was only reached: the search was cut before it looked at it.
  void findReached(std::vector<char>& is_reached) const {
    is_reached.assign(facet_pairs_.size(), 0);
    for (const Reached& reached : reached_) is_reached[reached.facet_pair] = 1;
  }

  /// Returns the steps beyond the level, of which isBeyond() says whether they enclose the facet pairs
  /// visited: some lead to one that was reached by another step.
  const std::vector<BoundaryStep>& boundarySteps() const { return boundary_; }
  bool isBeyond(const BoundaryStep& step) const {
    return table_.find(step.beyond_a, step.beyond_b) == PairTable::kAbsent;
  }

 private:
  struct Reached {
    double squared_level;
    std::uint32_t facet_pair;
  };
  static bool isHigher(const Reached& l, const Reached& r) {
    if (l.squared_level != r.squared_level) return l.squared_level > r.squared_level;
    return l.facet_pair > r.facet_pair;  // any order will do, as long as it is always the same
  }

  void enter(TriangleIndex a, TriangleIndex b, double squared_level, std::uint32_t parent,
             const SharedElement& via) {
    const auto facet_pair = static_cast<std::uint32_t>(facet_pairs_.size());
    table_.insert(a, b, facet_pair);
    facet_pairs_.push_back({a, b, parent, via});
    if (measures_pass_) is_visited_.push_back(0);
    reach(facet_pair, squared_level);
  }

  void reach(std::uint32_t facet_pair, double squared_level) {
    reached_.push_back({squared_level, facet_pair});
    std::push_heap(reached_.begin(), reached_.end(), isHigher);
  }

  /// False when the limit admits no more facet pairs.
  template <typename IsInside>
  bool expand(const PairFrame& frame, TriangleIndex a, TriangleIndex b, const FacetPoints& points_a,
              const FacetPoints& points_b, const FacetPairLevels& levels, const IsInside& is_inside,
              WorkLimit& limit) {
    const double highest = levels_.highest * levels_.highest;
    bool has_room = true;
    forEachNeighbour(
        frame, a, b, points_a, points_b, levels,
        [&](TriangleIndex to_a, TriangleIndex to_b, double squared_level, const SharedElement& element) {
          if (!has_room) return;
          if (squared_level > highest) {
            boundary_.push_back({to_a, to_b, squared_level, element});
            return;
          }
          const std::uint32_t known = table_.find(to_a, to_b);
          if (known != PairTable::kAbsent) {
            // This way may be lower than the one by which it was reached before.
            if (measures_pass_ && is_visited_[known] == 0) reach(known, squared_level);
            return;
          }
          if (is_inside(to_a, to_b)) return;
          has_room = limit.admits(facet_pairs_.size() + 1);
          if (has_room) enter(to_a, to_b, squared_level, last_, element);
        });
    return has_room;
  }

  Levels levels_{};
  PairTable table_{8};
  std::vector<FacetPair> facet_pairs_;
  std::vector<Reached> reached_;
  std::vector<BoundaryStep> boundary_;
  std::uint32_t last_ = 0;
  std::size_t looked_at_ = 0;
  double highest_ = 0.0;  ///< m^2
  bool has_own_start_ = true;
  bool measures_pass_ = false;
  std::vector<char> is_visited_;  ///< for each of facet_pairs(), only where a pass is measured
};

}  // namespace concave_distance::detail

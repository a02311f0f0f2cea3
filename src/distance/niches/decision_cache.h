#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/pair_table.h"
#include "basin_boundary.h"
#include "niche_properties.h"

namespace concave_distance::detail {

/// Says what has been put into a basin that is kept step by step.
struct BasinProgress {
  std::uint32_t basin = 0xffffffffU;  ///< in the cache, or none
  std::size_t facet_pairs = 0;
  std::size_t boundary_steps = 0;
  bool is_over = false;  ///< nothing is left to do, or the limit admitted no more
};

/// Keeps from pose to pose what proves decisions: facet pairs (a facet of each body), links of the paths that
/// lead on from them, and basins, sets of facet pairs with a boundary around each. Belongs to one pair of
/// bodies.
class DecisionCache {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// A facet pair and what is known of it.
  struct FacetPair {
    TriangleIndex a;
    TriangleIndex b;
    std::uint32_t link = kNone;       ///< link(): the path on
    std::uint32_t low = kNone;        ///< link(): a point pair in it
    std::uint32_t basins = kNone;     ///< first of its memberships
    std::uint32_t candidate = kNone;  ///< of this cycle, if `cycle` is this one
    Occluder occluder;
    std::uint64_t cycle = 0;
  };
  /// A point of each body, own axes in the frame's centre, in a facet pair and in the next one.
  struct Link {
    Eigen::Vector3d point_a;
    Eigen::Vector3d point_b;
    std::uint32_t next;
    SharedElement
        via;  ///< what the facet pairs have in common; of a point pair in a facet pair without meaning
    std::uint64_t used = 0;  ///< the last cycle
  };
  /// Facet pairs that are connected and enclosed.
  struct KeptBasin {
    std::uint64_t id = 0;         ///< 0: free; else its place in the list is the lower half
    std::uint32_t first = kNone;  ///< candidate of this cycle
    bool confirmed = false;       ///< in this cycle
    bool is_whole = false;        ///< all its facet pairs and its whole boundary are in it
    std::uint64_t used = 0;       ///< the last cycle that confirmed it
    BasinBoundary boundary;
    std::uint32_t members = kNone;  ///< first of its memberships
    std::size_t facet_pairs = 0;
    std::size_t facet_pairs_at_begin = 0;
  };

  void clear();
  /// Drops what was of no use at the last pose and forgets its candidates.
  void beginCycle(bool is_tracked);
  /// Says that the time of this cycle did not suffice to use all that is kept: the next one drops only basins
  /// that many cycles have not used.
  void endCut() { was_cut_ = true; }

  /// Returns the number of a facet pair, made where there is none; kNone when the limit admits no more.
  std::uint32_t facetPairOf(TriangleIndex a, TriangleIndex b, WorkLimit& limit);
  FacetPair& facet_pair(std::uint32_t number) { return facet_pairs_[number]; }
  const FacetPair& facet_pair(std::uint32_t number) const { return facet_pairs_[number]; }

  /// Puts a candidate into a facet pair, where that is known, and its basins.
  void enterIfKnown(TriangleIndex a, TriangleIndex b, std::uint32_t candidate) {
    const std::uint32_t number = table_.find(a, b);
    if (number != PairTable::kAbsent) enterCandidate(number, candidate);
  }
  /// Puts a candidate into a facet pair and its basins, unless an earlier one is there.
  void enterCandidate(std::uint32_t number, std::uint32_t candidate);
  /// Returns the candidate of this cycle in a facet pair, or kNone.
  std::uint32_t candidateOf(std::uint32_t number) const {
    return facet_pairs_[number].cycle == cycle_ ? facet_pairs_[number].candidate : kNone;
  }
  std::uint32_t candidateIn(TriangleIndex a, TriangleIndex b) const {
    const std::uint32_t number = table_.find(a, b);
    return number != PairTable::kAbsent ? candidateOf(number) : kNone;
  }

  const Link& link(std::uint32_t number) const { return links_[number]; }
  void use(std::uint32_t link) { links_[link].used = cycle_; }
  /// Makes a link or replaces it.
  void keepLink(std::uint32_t& number, const Link& link);
  /// Gives a link other points.
  void aim(std::uint32_t link, const Eigen::Vector3d& point_a, const Eigen::Vector3d& point_b) {
    links_[link].point_a = point_a;
    links_[link].point_b = point_b;
  }

  KeptBasin& basin(std::uint32_t index) { return basins_[index]; }
  const KeptBasin& basin(std::uint32_t index) const { return basins_[index]; }
  /// Returns the basin of a facet pair whose deepest candidate is `first`, or kNone.
  std::uint32_t basinOf(std::uint32_t number, std::uint32_t first) const;
  /// Returns the basin with this id, or kNone where it is no longer kept.
  std::uint32_t basinWith(std::uint64_t id) const;
  bool isIn(TriangleIndex a, TriangleIndex b, std::uint32_t basin) const;
  /// Returns a basin without facet pairs; for an id of 0 it chooses one.
  std::uint32_t takeBasin(std::uint64_t id);
  /// Adds a facet pair to a basin. Returns false when the limit admits no more.
  bool join(std::uint32_t number, std::uint32_t basin, WorkLimit& limit);
  /// Lets a basin go, a large one over some cycles. Returns whether its place is free at once.
  bool drop(std::uint32_t basin);
  BoundaryPool& boundaries() { return boundaries_; }

 private:
  bool unlink(std::uint32_t basin);
  struct Membership {
    std::uint32_t basin;
    std::uint32_t facet_pair;
    std::uint32_t next;  ///< of the facet pair
    std::uint32_t next_of_basin;
  };

  void compact();
  bool isUsed(std::uint32_t link) const;

  PairTable table_{8};
  std::vector<FacetPair> facet_pairs_;
  std::vector<Link> links_;
  std::vector<Membership> memberships_;
  std::uint32_t free_membership_ = kNone;
  std::vector<KeptBasin> basins_;
  BoundaryPool boundaries_;
  std::vector<std::uint32_t> free_basins_;
  std::uint64_t basins_made_ = 0;
  std::uint64_t cycle_ = 0;
  bool was_cut_ = false;              ///< the last cycle
  std::size_t live_facet_pairs_ = 0;  ///< after the last compaction
  // Buffers of a compaction.
  std::vector<char> live_;
  std::vector<std::uint32_t> places_;
  std::vector<Link> spare_links_;
};

}  // namespace concave_distance::detail

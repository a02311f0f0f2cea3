#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/pair_table.h"
#include "basin_boundary.h"
#include "niche_properties.h"

namespace concave_distance::detail {

/// Keeps from pose to pose what proves verdicts: facet pairs (a facet of each body), links of the paths that
/// lead on from them, and regions, sets of facet pairs with a border around each. Belongs to one pair of
/// bodies.
class DecisionCache {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// A facet pair and what is known of it.
  struct FacetPair {
    TriangleIndex a;
    TriangleIndex b;
    std::uint32_t link = kNone;     ///< link(): the path on
    std::uint32_t low = kNone;      ///< link(): a point pair in it
    std::uint32_t regions = kNone;  ///< first of its memberships
    std::uint32_t seed = kNone;     ///< of this cycle, if `cycle` is this one
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
  struct Region {
    std::uint64_t id = 0;         ///< 0: free; else its place in the list is the lower half
    std::uint32_t first = kNone;  ///< seed of this cycle
    bool confirmed = false;       ///< in this cycle
    BasinBoundary border;
    std::uint32_t members = kNone;  ///< first of its memberships
    std::size_t facet_pairs = 0;
    std::size_t facet_pairs_at_begin = 0;
  };

  void clear();
  /// At a new pose: what was of no use at the last one goes; no seed is known.
  void beginCycle(bool is_tracked);

  /// The number of a facet pair, which is made where there is none; kNone without memory.
  std::uint32_t facetPairOf(TriangleIndex a, TriangleIndex b, WorkLimit& limit);
  FacetPair& facet_pair(std::uint32_t number) { return facet_pairs_[number]; }
  const FacetPair& facet_pair(std::uint32_t number) const { return facet_pairs_[number]; }

  /// Puts a seed into a facet pair and its regions, unless an earlier one is there.
  void enterSeed(std::uint32_t number, std::uint32_t seed);
  /// kNone where there is none.
  std::uint32_t candidateOf(std::uint32_t number) const {
    return facet_pairs_[number].cycle == cycle_ ? facet_pairs_[number].seed : kNone;
  }
  std::uint32_t seedIn(TriangleIndex a, TriangleIndex b) const {
    const std::uint32_t number = table_.find(a, b);
    return number != PairTable::kAbsent ? candidateOf(number) : kNone;
  }

  const Link& link(std::uint32_t number) const { return links_[number]; }
  void use(std::uint32_t link) { links_[link].used = cycle_; }
  /// Makes a link or puts another one in its place. False without memory.
  bool keepLink(std::uint32_t& number, const Link& link, WorkLimit& limit);
  /// Other points for a link.
  void aim(std::uint32_t link, const Eigen::Vector3d& point_a, const Eigen::Vector3d& point_b) {
    links_[link].point_a = point_a;
    links_[link].point_b = point_b;
  }

  Region& region(std::uint32_t index) { return regions_[index]; }
  const Region& region(std::uint32_t index) const { return regions_[index]; }
  /// The region of a facet pair whose deepest seed is this one; kNone where there is none.
  std::uint32_t regionOf(std::uint32_t number, std::uint32_t first) const;
  /// The region with this id; kNone where there is none any more.
  std::uint32_t regionWith(std::uint64_t id) const;
  bool isIn(TriangleIndex a, TriangleIndex b, std::uint32_t region) const;
  /// A region without facet pairs; an id of 0 is chosen. kNone without memory.
  std::uint32_t takeRegion(std::uint64_t id, WorkLimit& limit);
  /// Adds a facet pair to a region. False without memory.
  bool join(std::uint32_t number, std::uint32_t region, WorkLimit& limit);
  void drop(std::uint32_t region);
  BorderPool& borders() { return borders_; }

  std::size_t memoryBytes() const;

 private:
  struct Membership {
    std::uint32_t region;
    std::uint32_t facet_pair;
    std::uint32_t next;  ///< of the facet pair
    std::uint32_t next_of_region;
  };

  void compact();
  bool isUsed(std::uint32_t link) const;

  PairTable table_{8};
  std::vector<FacetPair> facet_pairs_;
  std::vector<Link> links_;
  std::vector<Membership> memberships_;
  std::uint32_t free_membership_ = kNone;
  std::vector<Region> regions_;
  BorderPool borders_;
  std::vector<std::uint32_t> free_regions_;
  std::uint64_t regions_made_ = 0;
  std::uint64_t cycle_ = 0;
  std::size_t live_facet_pairs_ = 0;  ///< after the last compaction
  // Buffers of a compaction.
  std::vector<char> live_;
  std::vector<std::uint32_t> places_;
  std::vector<Link> spare_links_;
};

}  // namespace concave_distance::detail

#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/contact/friction.h"
#include "concave_distance/tracking/pair_effects.h"
#include "contact/contact_patch.h"

namespace concave_distance {

/// What is kept of a region from cycle to cycle.
struct RegionMemory {
  std::uint64_t id = 0;
  Eigen::Vector3d point_in_a = Eigen::Vector3d::Zero();
  double reach = 0.0;     ///< metres: how wide the region was
  BristleState bristles;  ///< of a lumped force
  PatchMemory patch;      ///< of a pressure
};

/// Tells which of the last cycle's regions each region is, and which niche it has come from.
class RegionIdentity {
 public:
  /// Sets the ids of `regions` and the order of memory() to theirs. A region is the last cycle's nearest one
  /// within both their widths and `displacement` (how far B can have moved, metres); its id goes on while the
  /// tracker has that niche. Otherwise it takes the id of the nearest niche at distance 0, each only once,
  /// and of no niche farther from it than its curves are.
  void update(const std::vector<TrackedNiche>& niches, double displacement,
              std::vector<ContactRegion>& regions);
  void clear() { memory_.clear(); }

  /// Of the regions of the last update(), in their order.
  std::vector<RegionMemory>& memory() { return memory_; }

 private:
  struct Match {
    double squared_distance;
    std::size_t region;
    std::size_t other;
  };
  template <typename Accept>
  void takeNearest(std::size_t regions, std::size_t others, const Accept& accept);

  std::vector<RegionMemory> memory_;
  std::vector<RegionMemory> before_;
  std::vector<Match> matches_;
  std::vector<char> region_taken_;
  std::vector<char> other_taken_;
};

}  // namespace concave_distance

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "concave_distance/contact/friction.h"
#include "concave_distance/tracking/pair_effects.h"
#include "contact/contact_patch.h"
#include "contact/turning_friction.h"

namespace concave_distance {

/// Holds what is kept of a region from cycle to cycle.
struct RegionMemory {
  std::uint64_t id = 0;
  Eigen::Vector3d point_in_a = Eigen::Vector3d::Zero();
  double reach = 0.0;                                     ///< metres: how wide the region was
  Eigen::Vector3d normal_in_a = Eigen::Vector3d::Zero();  ///< zero: not known yet
  BristleState bristles;                                  ///< of a lumped force
  TurningBristles turning;
  PatchMemory patch;  ///< of a pressure
};

/// Finds which of the last cycle's regions each region is, and which niche it has come from.
class RegionIdentity {
 public:
  /// Sets the ids of `regions` and the order of memory() to theirs. A region is the last cycle's nearest one
  /// within both their widths and `displacement` (how far B can have moved, metres). Its id goes on while
  /// that niche lies on it; otherwise it takes that of the nearest niche at distance 0, each only once and of
  /// none farther from it than its curves are, and keeps its own where there is none while the tracker has
  /// it.
  void update(const std::vector<TrackedNiche>& niches, double displacement,
              std::vector<ContactRegion>& regions);
  void clear() { memory_.clear(); }
  /// Keeps the regions for the next cycle, once their forces are known.
  void keepNormals(const std::vector<ContactRegion>& regions);

  /// Returns those of the regions of the last update(), in their order.
  std::vector<RegionMemory>& memory() { return memory_; }
  /// Where in the last update() a region came, went, split or took another in: all bristles that there were.
  const std::vector<UnmatchedBristles>& loose() const { return loose_; }

 private:
  struct Match {
    double squared_distance;
    std::size_t region;
    std::size_t other;
  };
  template <typename Accept>
  void takeNearest(std::size_t regions, std::size_t others, const Accept& accept);
  void inherit();
  void takeIds(const std::vector<TrackedNiche>& niches, double displacement);
  void splitOff();
  void loosen(const PatchMemory& patch);

  std::vector<RegionMemory> memory_;
  std::vector<RegionMemory> before_;
  std::vector<UnmatchedBristles> loose_;
  std::vector<Match> matches_;
  std::vector<Match> found_;  ///< regions and niches that touch
  std::vector<char> region_taken_;
  std::vector<char> other_taken_;
};

}  // namespace concave_distance

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "partition_tracker.h"

namespace concave_distance {

/// Where a search says that the bodies may be nearest: a point of each, e.g. the two nodes of a trial point
/// or the witnesses of a niche. Each in its own body's frame, metres.
struct PlacePair {
  Eigen::Vector3d on_a;
  Eigen::Vector3d on_b;
};

struct HybridOptions {
  PartitionTrackerOptions tracker;
  /// A piece is at a place when it is no farther from it than this fraction of the piece's radius: nodes lie
  /// on the surface up to rounding only.
  double reach = 1e-6;
  /// Every sub-pair that no place leads to is shown to be farther than the nearest of the places (its
  /// spheres, its shadows), or solved: the distance is then the bodies', whatever the search has missed. Else
  /// only the places are finished.
  bool prove = true;
};

/// The hybrid of the thesis's conclusions (Carretero, ch. 7 and sec. 6.3.4): the search selects the
/// sub-pairs, the quadratic program finishes them. From each place's pieces the solve goes on to the pieces
/// that touch where the nearest points lie, until none of them is nearer. Where the search has found the
/// right place the other sub-pairs need bounds only ("a sophisticated pruning strategy"). Not thread-safe.
class HybridDistance {
 public:
  /// @throws Error when a partition has no piece
  HybridDistance(std::shared_ptr<const ConvexPartition> a, std::shared_ptr<const ConvexPartition> b,
                 const HybridOptions& options = {});
  ~HybridDistance();
  HybridDistance(HybridDistance&&) noexcept;
  HybridDistance& operator=(HybridDistance&&) noexcept;

  /// The bodies' distance; without `prove` the nearest local minimum of the places', each exact, and nothing
  /// without places. A place in no piece is taken to the nearest piece; the nearest places had better come
  /// first. Never throws.
  PartitionSolution update(const Eigen::Isometry3d& a_from_b, const std::vector<PlacePair>& places);

  void reset();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace concave_distance

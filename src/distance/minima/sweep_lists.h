#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "distance/kernels/minimum_candidate.h"
#include "mesh/trees/normal_cone_tree.h"

namespace concave_distance::detail {

using SlotPair = std::pair<NormalConeTree::Slot, NormalConeTree::Slot>;  ///< of A and of B

/// A pair of features that holds a minimum, and stays one until its expiry.
struct LiveMinimum {
  SlotPair pair;
  std::uint32_t moved_distance;  ///< index in MovedDistances
  std::uint64_t expiry;
  MinimumCandidate candidate;
};

/// A pair that holds no minimum until its moved distance reaches its expiry.
struct KeptPair {
  SlotPair pair;
  std::uint32_t moved_distance;  ///< index in MovedDistances
  std::uint64_t expiry;
};

/// Holds the pairs that sweeps work off and those that they leave.
struct SweepLists {
  std::vector<SlotPair> open;  ///< to be opened
  std::vector<LiveMinimum> minima;
  std::vector<SlotPair> undecided;  ///< pairs of features that hold no minimum, without slack
  std::vector<MinimumCandidate> candidates;
  std::vector<KeptPair> kept;  ///< of a sweep without queues
  std::uint32_t groups = 0;    ///< comparisons of a group with four others
  std::uint32_t features = 0;  ///< pairs of features that were asked whether they hold a minimum
  std::uint32_t measured = 0;  ///< minima that have stayed

  /// Returns how many pairs a sweep with queues holds besides what these keep.
  std::size_t size() const { return open.size() + minima.size() + undecided.size() + candidates.size(); }
};

/// Holds expired pairs that are compared before any of them is opened.
struct ExpiredPairs {
  const SlotPair* next;
  const SlotPair* end;

  bool empty() const { return next == end; }
};

}  // namespace concave_distance::detail

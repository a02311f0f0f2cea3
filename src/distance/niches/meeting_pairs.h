#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/pair_table.h"
#include "concave_distance/base/work_limit.h"
#include "distance/kernels/pair_frame.h"
#include "distance/minima/local_minima_cost.h"

namespace concave_distance::detail {

/// Nodes of A's and of B's TriangleTree.
using TreeNodePair = std::pair<std::uint32_t, std::uint32_t>;

/// Metres: facets no farther apart hang together where the bodies meet.
inline double meetingTolerance(const PairFrame& frame) {
  return 2.0 * frame.touchingDistance();
}

/// Two facets that meet, up to rounding.
struct MeetingPair {
  TriangleIndex a;
  TriangleIndex b;
  double distance;  ///< metres; 0 where an edge of one clearly runs through the other
  /// Bit k, for the facet of A and that of B: edge k is within the tolerance of the other facet.
  std::array<std::uint8_t, 2> met_edges;
};

/// Every facet pair that meets at one pose, in the order in which the trees bring them.
class MeetingPairs {
 public:
  static constexpr std::uint32_t kNone = PairTable::kAbsent;

  /// The frame's facets are open. @return false when the limit was reached: pairs are missing
  bool collect(const PairFrame& frame, LocalMinimaCost& cost, WorkLimit& limit);
  void clear() {
    pairs_.clear();
    table_.clear();
  }

  const std::vector<MeetingPair>& pairs() const { return pairs_; }
  /// Returns the index in pairs() of a facet pair, or kNone.
  std::uint32_t find(TriangleIndex a, TriangleIndex b) const { return table_.find(a, b); }

 private:
  bool look(const PairFrame& frame, TriangleIndex a, TriangleIndex b, double tolerance, WorkLimit& limit);

  std::vector<MeetingPair> pairs_;
  PairTable table_{4};
  std::vector<TreeNodePair> open_;
};

}  // namespace concave_distance::detail

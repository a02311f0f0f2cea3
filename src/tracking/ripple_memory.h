#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/pair_key.h"
#include "distance/witness_refinement.h"

namespace concave_distance {

/// Local minima that are no niches of their own: their prominence is below the least, so that they belong to
/// a deeper niche. Tessellated valleys are full of them and searches meet them again and again within a
/// cycle; a verdict holds for its cycle, then the bodies have moved. A fixed number; a new one takes the
/// place of another.
class RippleMemory {
 public:
  /// Allocates the memory; otherwise the first remember() does.
  void allocate() { ripples_.resize(std::size_t{1} << kCapacityLog2); }
  void clear() { std::fill(ripples_.begin(), ripples_.end(), Ripple{}); }

  /// Id of the niche that the minimum on this triangle pair belongs to, if this cycle knows it.
  std::optional<std::uint64_t> ownerOf(TriangleIndex a, TriangleIndex b, std::uint64_t cycle) const {
    if (ripples_.empty()) {
      return std::nullopt;
    }
    const Ripple& ripple = ripples_[slotOf(a, b)];
    if (ripple.owner == 0 || ripple.a != a || ripple.b != b || ripple.judged != cycle) {
      return std::nullopt;
    }
    return ripple.owner;
  }

  void remember(TriangleIndex a, TriangleIndex b, std::uint64_t owner, std::uint64_t cycle) {
    if (ripples_.empty()) {
      allocate();
    }
    ripples_[slotOf(a, b)] = {a, b, owner, cycle};
  }

 private:
  struct Ripple {
    TriangleIndex a;
    TriangleIndex b;
    std::uint64_t owner = 0;
    std::uint64_t judged = 0;  ///< cycle
  };
  static constexpr std::uint32_t kCapacityLog2 = 10;

  static std::size_t slotOf(TriangleIndex a, TriangleIndex b) {
    return slotOfKey(pairKey(a, b), 64 - kCapacityLog2);
  }

  std::vector<Ripple> ripples_;  ///< none or 2^kCapacityLog2
};

}  // namespace concave_distance

#pragma once

#include <array>
#include <cstdint>

#include "concave_distance/base/cost_counter.h"

namespace concave_distance {

/// Counts what a proof cost. A new counter is a field, a line in the sum and, for the diagnostics, a row of
/// counters().
struct CertificateCost {
  std::uint32_t box_bounds = 0;      ///< pairs of boxes bounded
  std::uint32_t leaf_pairs = 0;      ///< pairs of up to four triangles each looked at
  std::uint32_t triangle_pairs = 0;  ///< distances of triangles computed

  CertificateCost& operator+=(const CertificateCost& more) {
    box_bounds += more.box_bounds;
    leaf_pairs += more.leaf_pairs;
    triangle_pairs += more.triangle_pairs;
    return *this;
  }

  /// Lists what the diagnostics report of a sum, by key.
  static const auto& counters() {
    static constexpr std::array<CostCounter<CertificateCost>, 2> kCounters{{
        {"proof box bounds", [](const CertificateCost& cost) -> std::uint64_t { return cost.box_bounds; }},
        {"proof triangle pairs",
         [](const CertificateCost& cost) -> std::uint64_t { return cost.triangle_pairs; }},
    }};
    return kCounters;
  }
};

}  // namespace concave_distance

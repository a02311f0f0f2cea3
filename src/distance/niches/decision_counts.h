#pragma once

#include <cstdint>

namespace concave_distance::detail {

/// Says how the niches of one pose were decided.
struct DecisionCounts {
  std::uint32_t by_path = 0;      ///< ripples by known paths
  std::uint32_t aimed = 0;        ///< links of paths that have got other points
  std::uint32_t by_boundary = 0;  ///< niches by known boundaries
  std::uint32_t mended = 0;       ///< niches by boundaries with more facet pairs inside
  std::uint32_t searches = 0;
  std::uint32_t visited_pairs = 0;
  std::uint32_t measured = 0;  ///< elements of boundaries, anew
};

}  // namespace concave_distance::detail

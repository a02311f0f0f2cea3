#pragma once

#include <cstddef>
#include <limits>

namespace concave_distance {

/// Largest size of a scene; anything larger is refused with the figure.
struct SceneLimits {
  std::size_t bodies = std::numeric_limits<std::size_t>::max();
  /// Listed pairs, and likewise pairs by rule that are near at one time: those beyond are cut.
  std::size_t pairs = std::numeric_limits<std::size_t>::max();
  std::size_t triangles = std::numeric_limits<std::size_t>::max();  ///< of one body
  std::size_t nodes = 20'000'000;                                   ///< of one body's search grid
};

}  // namespace concave_distance

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracking/warm_start.h"

namespace concave_distance::evaluation {

/// Where a niche of the last instant is looked for now (Carretero, sec. 7.1.3).
enum class Extrapolation : std::uint8_t {
  None,         ///< where it was
  Velocity,     ///< as far on as it has moved since the instant before
  Acceleration  ///< and as much farther as that has grown
};

/// What the population of a search along a motion begins with: trial points of the last instant's niches, the
/// rest random.
struct FirstGuess {
  Inheritance inheritance;
  /// So many trial points of every niche, regardless of its fitness (sec. 6.2.2), in place of `inheritance`;
  /// empty: (6.7), (6.8).
  std::optional<std::uint32_t> fixed_per_niche;
  Extrapolation extrapolation = Extrapolation::None;
  /// The population grows where there are more inherited trial points than it has room for beside so many
  /// random ones; empty: it never does.
  std::optional<std::uint32_t> random_starts;
};

/// `count` copies of every niche, niche by niche.
void inheritFixedCount(const std::vector<TrialPoint>& niches, std::uint32_t count,
                       std::vector<TrialPoint>& population);

}  // namespace concave_distance::evaluation

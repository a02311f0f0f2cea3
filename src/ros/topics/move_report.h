#pragma once

#include <cstdint>
#include <string>

namespace concave_distance {

/// Counts moves of bodies by the topic scene_moves.
struct MoveReport {
  std::uint64_t taken = 0;
  std::uint64_t refused = 0;
  std::uint64_t refused_in_all = 0;  ///< since the start
  std::string last_refusal;          ///< body, reason and remedy; empty when there was none
};

}  // namespace concave_distance

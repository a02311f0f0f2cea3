#pragma once

#include <cstdint>

namespace concave_distance {

/// Says whether a local minimum is one pair of points or a set of them (doc/algorithm.md, section 3).
enum class NicheKind : std::uint8_t { Point, Segment, Patch };

/// Says where the segment between the witness points runs.
enum class Outwardness : std::uint8_t {
  Outward,          ///< leaves both bodies outwards: a possible contact
  ThroughMaterial,  ///< leaves at least one closed shell inwards: its dark side, no possible contact
  Unknown           ///< at least one witness lies on an open shell that it leaves against its winding
};

}  // namespace concave_distance

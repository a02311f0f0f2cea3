#pragma once

#include "concave_distance/mesh/surface/round_shape.h"

namespace concave_distance::detail {

/// Holds what the rules ask about a kind of round solid: all of them are a cylindrical part between two ends.
struct RoundTraits {
  bool has_side;       ///< the cylindrical part has a length; false: only the ends are left
  bool has_flat_ends;  ///< the ends are discs with rims; false: they are half balls
};

/// The one switch over RoundKind. A new kind does not compile before it is answered here; one that these
/// answers do not describe, such as a cone, is a primitive with a mesh alone (primitive_table.h).
constexpr RoundTraits traitsOf(RoundKind kind) {
  switch (kind) {
    case RoundKind::Sphere:
      return {false, false};
    case RoundKind::Capsule:
      return {true, false};
    case RoundKind::Cylinder:
      return {true, true};
  }
  return {};
}

inline bool hasSide(const RoundShape& shape) {
  return traitsOf(shape.kind).has_side;
}

inline bool hasFlatEnds(const RoundShape& shape) {
  return traitsOf(shape.kind).has_flat_ends;
}

}  // namespace concave_distance::detail

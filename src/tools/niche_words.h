#pragma once

#include "concave_distance/distance/niche_kind.h"

namespace concave_distance::tools {

/// The words that files have for what a niche is.
inline const char* kindName(NicheKind kind) {
  switch (kind) {
    case NicheKind::Point:
      return "point";
    case NicheKind::Segment:
      return "segment";
    case NicheKind::Patch:
      return "patch";
  }
  return "";
}

inline const char* outwardName(Outwardness outward) {
  switch (outward) {
    case Outwardness::Outward:
      return "outward";
    case Outwardness::ThroughMaterial:
      return "through_material";
    case Outwardness::Unknown:
      return "unknown";
  }
  return "";
}

}  // namespace concave_distance::tools

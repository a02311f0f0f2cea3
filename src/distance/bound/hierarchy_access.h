#pragma once

#include "mesh/trees/bounding_volume_hierarchy.h"

namespace concave_distance::detail {

inline bool isLeaf(std::uint32_t child) {
  return (child & BoundingVolumeHierarchy::kLeafFlag) != 0;
}

inline const BoundingVolumeHierarchy::Leaf& leafOf(const BoundingVolumeHierarchy& hierarchy,
                                                   std::uint32_t child) {
  return hierarchy.leaves()[child & ~BoundingVolumeHierarchy::kLeafFlag];
}

/// Returns the squared half diagonal of a slot's box, relative to the squared reach.
inline float squaredSize(const BoundingVolumeHierarchy& hierarchy, BoundingVolumeHierarchy::Slot slot) {
  return hierarchy.singleNodes()[slot / BoundingVolumeHierarchy::kWidth]
      .squared_size[slot % BoundingVolumeHierarchy::kWidth];
}

inline BoundingVolumeHierarchy::Slot slotOf(std::uint32_t node, std::uint32_t lane) {
  return node * static_cast<BoundingVolumeHierarchy::Slot>(BoundingVolumeHierarchy::kWidth) + lane;
}

}  // namespace concave_distance::detail

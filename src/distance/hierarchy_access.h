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

/// Squared half diagonal of a slot's box.
inline double squaredSize(const BoundingVolumeHierarchy& hierarchy, BoundingVolumeHierarchy::Slot slot) {
  const BoundingVolumeHierarchy::Node& node = hierarchy.nodes()[slot / BoundingVolumeHierarchy::kWidth];
  const std::size_t lane = slot % BoundingVolumeHierarchy::kWidth;
  return node.half[0][lane] * node.half[0][lane] + node.half[1][lane] * node.half[1][lane] +
         node.half[2][lane] * node.half[2][lane];
}

inline BoundingVolumeHierarchy::Slot slotOf(std::uint32_t node, std::uint32_t lane) {
  return node * static_cast<BoundingVolumeHierarchy::Slot>(BoundingVolumeHierarchy::kWidth) + lane;
}

}  // namespace concave_distance::detail

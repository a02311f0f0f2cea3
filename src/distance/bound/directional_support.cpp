#include "directional_support.h"

#include <algorithm>
#include <limits>

#include "box_pair_bounds.h"
#include "hierarchy_access.h"
#include "leaf_pair.h"

namespace concave_distance::detail {

DirectionalSupport::DirectionalSupport(const Hierarchy& hierarchy, SupportCache& cache)
    : hierarchy_(hierarchy), cache_(cache) {
  const std::size_t slots = hierarchy.nodes().size() * Hierarchy::kWidth;
  if (cache_.values.size() < slots) {
    cache_.values.resize(slots);
    cache_.stamps.resize(slots, 0);
  }
}

void DirectionalSupport::setDirection(const Eigen::Vector3d& direction, double limit) {
  direction_ = direction;
  limit_ = limit;
  if (++cache_.stamp == 0) {  // stamps have come round
    std::fill(cache_.stamps.begin(), cache_.stamps.end(), 0U);
    cache_.stamp = 1;
  }
}

double DirectionalSupport::of(Hierarchy::Slot slot) {
  if (cache_.stamps[slot] == cache_.stamp) return cache_.values[slot];
  const OrientedBox box = hierarchy_.box(slot);
  return refine(slot, direction_.dot(box.centre) + reachAlong(direction_, box));
}

double DirectionalSupport::refine(Hierarchy::Slot slot, double box_support) {
  if (cache_.stamps[slot] == cache_.stamp) return cache_.values[slot];
  double support = box_support;
  if (box_support > limit_) {
    const std::uint32_t child = hierarchy_.child(slot);
    support = std::min(support, isLeaf(child) ? mostAlong(leafOf(hierarchy_, child), direction_).maxCoeff()
                                              : mostOfChildren(child));
  }
  cache_.values[slot] = support;
  cache_.stamps[slot] = cache_.stamp;
  return support;
}

// Infinite where it lies beyond the limit: then the box itself says as much.
double DirectionalSupport::mostOfChildren(std::uint32_t child) {
  constexpr double kBeyond = std::numeric_limits<double>::infinity();
  const Hierarchy::Node& node = hierarchy_.nodes()[child];
  const Lanes centres = along(direction_, node.centre);
  // Something of a box lies beyond a plane that its centre lies beyond: nothing is to be gained.
  if (centres.maxCoeff() > limit_) return kBeyond;
  const Lanes box_supports = centres + reachAlong(direction_, node);
  double most = -kBeyond;
  for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
    if (node.child[lane] == Hierarchy::kNoChild) break;
    most = std::max(most, refine(slotOf(child, lane), box_supports[lane]));
    if (most > limit_) return kBeyond;
  }
  return most;
}

}  // namespace concave_distance::detail

#include "directional_support.h"

#include <algorithm>

#include "box_pair_bounds.h"
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
  const double support =
      direction_.dot(box.centre) + (box.axes.transpose() * direction_).cwiseAbs().dot(box.half);
  return refine(slot, support);
}

double DirectionalSupport::refine(Hierarchy::Slot slot, double box_support) {
  if (cache_.stamps[slot] == cache_.stamp) return cache_.values[slot];
  double support = box_support;
  if (box_support > limit_) {
    const std::uint32_t child = hierarchy_.child(slot);
    if ((child & Hierarchy::kLeafFlag) != 0) {
      support = std::min(
          support, mostAlong(hierarchy_.leaves()[child & ~Hierarchy::kLeafFlag], direction_).maxCoeff());
    } else {
      const Hierarchy::Node& node = hierarchy_.nodes()[child];
      const Lanes centres = direction_.x() * lanes(node.centre[0]) + direction_.y() * lanes(node.centre[1]) +
                            direction_.z() * lanes(node.centre[2]);
      // Something of a box lies beyond a plane that its centre lies beyond: nothing is to be gained.
      if (centres.maxCoeff() <= limit_) {
        Lanes reach = centres;
        for (int i = 0; i < 3; ++i) {
          reach += lanes(node.half[i]) *
                   (direction_.x() * lanes(node.axes[i][0]) + direction_.y() * lanes(node.axes[i][1]) +
                    direction_.z() * lanes(node.axes[i][2]))
                       .abs();
        }
        double most = -std::numeric_limits<double>::infinity();
        for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
          if (node.child[lane] == Hierarchy::kNoChild) break;
          most = std::max(
              most, refine(child * static_cast<Hierarchy::Slot>(Hierarchy::kWidth) + lane, reach[lane]));
          if (most > limit_) break;
        }
        // Left early: what was not looked at reaches no farther than the box.
        if (most <= limit_) support = std::min(support, most);
      }
    }
  }
  cache_.values[slot] = support;
  cache_.stamps[slot] = cache_.stamp;
  return support;
}

}  // namespace concave_distance::detail

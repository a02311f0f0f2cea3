#include "bound_cache.h"

#include <algorithm>

#include "distance/kernels/pair_motion.h"

namespace concave_distance {
namespace {

// A cache that has grown by this factor since it was begun is begun anew: it looks at needlessly small boxes.
constexpr double kLargestGrowth = 2.0;
constexpr double kSmallGrowth = 8.0;  // of the smallest, entries
// When this share of what a fresh proof opens is opened again, the cache was not worth keeping.
constexpr double kWorthless = 0.6;
constexpr std::uint32_t kLongestWait = 32;

}  // namespace

void BoundCache::advance(const BoundingVolumeHierarchy& b, const Eigen::Matrix3d& rotation,
                         const Eigen::Vector3d& offset, double rounding) {
  const detail::PairMotion motion(rotation_, offset_, rotation, offset, rounding);
  rotation_ = rotation;
  offset_ = offset;
  if (motion.isStill()) return;
  for (std::size_t subtree = 0; subtree < moved_distances_.size(); ++subtree) {
    const OrientedBox box = b.box(b.subtrees()[subtree]);
    moved_distances_[subtree] += motion.largestWithin(box.centre, box.half.norm());
  }
}

void BoundCache::begin(const BoundingVolumeHierarchy& b, const Eigen::Matrix3d& rotation,
                       const Eigen::Vector3d& offset) {
  quads_.clear();
  directions_.clear();
  leaf_pairs_.clear();
  moved_distances_.assign(b.subtrees().size(), 0.0);
  rotation_ = rotation;
  offset_ = offset;
}

void BoundCache::decide(bool began_anew, std::uint32_t opened) {
  if (began_anew) {
    opened_at_begin_ = std::max(opened, 1U);
    size_at_begin_ = size();
    valid_ = true;
    return;
  }
  if (opened > kWorthless * opened_at_begin_) {
    valid_ = false;
    wait_ = next_wait_;
    next_wait_ = std::min(2 * next_wait_, kLongestWait);
    return;
  }
  next_wait_ = 1;
  valid_ = static_cast<double>(size()) <= kLargestGrowth * static_cast<double>(size_at_begin_) + kSmallGrowth;
}

}  // namespace concave_distance

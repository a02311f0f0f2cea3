#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "marker_style.h"
#include "ros/messages/published_pair.h"

namespace concave_distance {

/// Where a body of the scene is, in the reference frame.
struct LocatedBody {
  std::size_t index = 0;    ///< into Scene::bodies
  Eigen::AlignedBox3d box;  ///< around it, metres
  Eigen::Isometry3d reference_from_body = Eigen::Isometry3d::Identity();
};

/// The bodies of the pairs that are due and have transforms, each once.
/// @param pairs in the order of scene.pairs
std::vector<LocatedBody> locateBodies(const Scene& scene, const PublishedPairs& pairs);

/// The box around the bodies, metres, without those much larger than the median one (a floor) and those far
/// from all others. Empty without bodies.
Eigen::AlignedBox3d usualRegion(const std::vector<LocatedBody>& bodies);

/// Where and how large markers are drawn. Follows the scene's size in steps, so that sizes stay constant
/// while bodies move.
class MarkerLayout {
 public:
  /// @param style as configured; 0 means automatic
  void update(const std::vector<LocatedBody>& bodies, const MarkerStyle& style);

  /// The style with automatic values replaced (scale > 0, far > near).
  const MarkerStyle& style() const { return style_; }
  double letterHeight() const;  ///< m
  /// Box beside which the legend is placed, metres; empty before the first body was located.
  const Eigen::AlignedBox3d& region() const { return region_; }

 private:
  MarkerStyle style_;
  Eigen::AlignedBox3d region_;
  double size_ = 0.0;  ///< m, diagonal of the region at its last update
};

}  // namespace concave_distance

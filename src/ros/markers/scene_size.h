#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "ros/messages/published_pair.h"

namespace concave_distance {

/// Returns the boxes in the reference frame around the bodies of the pairs that are due and have transforms,
/// one for each body. @param pairs of this scene
std::vector<Eigen::AlignedBox3d> locatedBoxes(const Scene& scene, const PublishedPairs& pairs);

/// Returns the box around the boxes, without those that reach much farther from the middle than the median
/// one: a floor, a hall, a body that got lost. Empty without boxes.
Eigen::AlignedBox3d usualRegion(const std::vector<Eigen::AlignedBox3d>& boxes);

/// Returns the size of the scene in metres, to which markers are scaled: the diagonal of usualRegion().
/// @param before the size of the last picture, which stays until the scene's has changed noticeably, so that
///        letters do not pulsate while bodies move; 0: none
double sceneSize(const std::vector<Eigen::AlignedBox3d>& boxes, double before);

}  // namespace concave_distance

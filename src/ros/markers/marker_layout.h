#pragma once

#include <Eigen/Geometry>
#include <cstddef>
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
/// @param pairs of this scene
std::vector<LocatedBody> locateBodies(const Scene& scene, const PublishedPairs& pairs);

/// The box around the bodies, metres, without those that reach much farther from the middle than the median
/// one: a floor, a hall, a body that got lost. Empty without bodies.
Eigen::AlignedBox3d usualRegion(const std::vector<LocatedBody>& bodies);

/// How large markers are and where the list stands, metres in the reference frame.
struct MarkerLayout {
  MarkerStyle style;           ///< as configured, automatic values replaced: scale > 0, far > near
  Eigen::AlignedBox3d region;  ///< around the scene; empty before the first body was located
  double letter_height = 0.0;
  Eigen::Vector3d list_bottom = Eigen::Vector3d::Zero();  ///< middle of the lower edge of the list
};

/// @param style as configured; 0 means automatic
/// @param before region of the last picture, which stays until the scene's has changed noticeably: so letters
///        do not pulsate while bodies move
MarkerLayout layOut(const std::vector<LocatedBody>& bodies, const MarkerStyle& style,
                    const Eigen::AlignedBox3d& before);

}  // namespace concave_distance

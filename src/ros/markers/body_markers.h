#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <cstddef>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Bodies with more triangles than this are drawn as their bounding box: rviz holds no larger list
/// gracefully.
inline constexpr std::size_t kLargestShownBody = 200'000;

/// Gives the marker the surface's triangles, moved outwards by `offset` metres; its bounding box,
/// translucent, when there are too many triangles.
void drawSurface(const SurfaceMesh& surface, double offset, visualization_msgs::Marker& marker);

/// The body of a pair that is looked through to see the pressure on the other one's surface, an index into
/// Scene::bodies: rather one that is drawn here than one of a robot model, the more translucent, the smaller.
std::size_t seenThrough(const Scene& scene, const ScenePair& pair);

/// The bodies that rviz cannot draw from a robot model, as triangle lists fixed to their tf frames. Begins
/// with a DELETEALL, so that one latched message always says everything. A body that is looked through, where
/// two press on each other, is at most half opaque.
/// @param with_collision adds the geometry that is computed with of the links that rviz does draw:
/// translucent
///        blue, namespace `collision`
visualization_msgs::MarkerArray bodyMarkers(const Scene& scene, bool with_collision = false);

}  // namespace concave_distance

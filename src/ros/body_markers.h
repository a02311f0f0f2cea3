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

/// The bodies that rviz cannot draw from a robot model, as triangle lists fixed to their tf frames. Begins
/// with a DELETEALL, so that one latched message always says everything.
visualization_msgs::MarkerArray bodyMarkers(const Scene& scene);

}  // namespace concave_distance

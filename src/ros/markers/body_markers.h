#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <cstddef>
#include <optional>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Bodies with more triangles than this are drawn as their bounding box: rviz holds no larger list
/// gracefully.
inline constexpr std::size_t kLargestShownBody = 200'000;

/// The body of a pair that is looked through to see the pressure on the other one's surface, an index into
/// Scene::bodies: rather one that is drawn here than one of a robot model, the more translucent, the smaller.
std::size_t seenThrough(const Scene& scene, const ScenePair& pair);

/// The bodies that rviz cannot draw from a robot model, as triangle lists fixed to their tf frames. Begins
/// with a DELETEALL, so that one latched message always says everything. A body that is looked through, where
/// two press on each other, is at most half opaque.
/// @param with_collision adds the geometry that distances are computed with of the links that rviz does draw:
///        translucent blue, namespace `collision`
visualization_msgs::MarkerArray bodyMarkers(const Scene& scene, bool with_collision = false);

/// Returns the markers of those bodies alone that edits have placed elsewhere since `shown`, whose markers
/// were sent; nullopt when more than that has changed, so that all have to be sent.
std::optional<visualization_msgs::MarkerArray> movedBodyMarkers(const Scene& shown, const Scene& now,
                                                                bool with_collision = false);

/// A translucent red copy of a body that is too close: namespace `warning`, the body's number as marker id,
/// fixed to its tf frame.
/// @param offset m, of the copy in front of the body's surface
visualization_msgs::Marker warningMarker(const Scene& scene, std::size_t body, double offset);

}  // namespace concave_distance

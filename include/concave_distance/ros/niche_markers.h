#pragma once

#include <concave_distance/PairNiches.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/ros/node_parameters.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// 2 % of the median diameter of the scene's bodies, metres: points that can be seen and hide nothing.
double automaticMarkerScale(const Scene& scene);

/// Colour of a niche by its distance: orange at `near`, over yellow to green at `far`; opaque.
std_msgs::ColorRGBA distanceColor(double distance, const MarkerStyle& style);

/// What is drawn for one pair: per niche its witness points and the line between them, for the nearest one
/// thicker, opaque and with the distance as text; red when the pair is in warning. Namespaces
/// `<pair>/points`,
/// `<pair>/line`, `<pair>/text`; the marker id is the niche's id (its low 31 bits). A pair with a distance
/// but no niche (one body inside the other) is drawn from its closest points under id 0.
/// @param style with a resolved scale (> 0)
/// @param lifetime seconds after which rviz drops a marker that is not renewed
std::vector<visualization_msgs::Marker> nicheMarkers(const PairNiches& pair, const MarkerStyle& style,
                                                     double lifetime);

/// Namespaces and ids that rviz shows at present.
using ShownMarkers = std::set<std::pair<std::string, std::int32_t>>;

/// Completes a message to be sent: a DELETE for all that was shown and is not in `markers` any more.
/// `shown` becomes what the message leaves on the screen.
visualization_msgs::MarkerArray withDeletions(std::vector<visualization_msgs::Marker> markers,
                                              const std_msgs::Header& header, ShownMarkers& shown);

}  // namespace concave_distance

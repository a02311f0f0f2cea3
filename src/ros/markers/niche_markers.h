#pragma once

#include <concave_distance/PairNiches.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "marker_labels.h"
#include "marker_selection.h"
#include "marker_style.h"

namespace concave_distance {

/// Colour of a niche by its distance: orange at `near`, over yellow to green at `far`; opaque.
/// @param style with far > near
std_msgs::ColorRGBA distanceColor(double distance, const MarkerStyle& style);
/// Red; colours of distances are never red.
std_msgs::ColorRGBA warningColor();

/// The markers for one pair: for each niche its witness points and the line between them, thick and opaque
/// for the nearest (red when the pair is in warning), thin and faint for the others; around a segment or
/// patch, circles as wide as it is. Namespaces `<pair>/points`, `<pair>/line`, `<pair>/extent`; the marker id
/// is the niche's (its low 31 bits). For a pair with a distance but no niche (one body inside the other) its
/// closest points are drawn under id 0.
/// @param style with scale > 0 and far > near
/// @param lifetime seconds after which rviz drops a marker that is not renewed
std::vector<visualization_msgs::Marker> nicheMarkers(const DrawnPair& drawn, const MarkerStyle& style,
                                                     double lifetime);

/// The label with the distance of the pair's nearest niche and, if wanted, the bodies' names: namespace
/// `<pair>/text`.
/// @param pair with hasMarkers()
Label nicheLabel(const PairNiches& pair, bool with_names, const MarkerStyle& style, double lifetime);

/// Namespaces and ids that rviz shows at present.
using ShownMarkers = std::set<std::pair<std::string, std::int32_t>>;

/// Completes a message to be sent: a DELETE for all that was shown and is not in `markers` any more.
/// `shown` becomes what the message leaves on the screen.
visualization_msgs::MarkerArray withDeletions(std::vector<visualization_msgs::Marker> markers,
                                              const std_msgs::Header& header, ShownMarkers& shown);

}  // namespace concave_distance

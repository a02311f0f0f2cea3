#pragma once

#include <concave_distance/PairNiches.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "marker_parts.h"
#include "marker_selection.h"
#include "marker_style.h"

namespace concave_distance {

/// Colour of a niche by its distance: orange at `near`, over yellow to green at `far`; opaque.
/// @param style with far > near
std_msgs::ColorRGBA distanceColor(double distance, const MarkerStyle& style);
/// Red; colours of distances are never red.
std_msgs::ColorRGBA warningColor();
/// Whether the line of the shortest distance is dashed: it is not certain, or its transforms are stale.
bool isDashed(const PairNiches& pair);
/// Grey, of a distance whose transforms are stale and of the legend's text.
std_msgs::ColorRGBA greyColor();

/// The markers for one pair: for each niche its witness points and the line between them, thick and opaque
/// for the nearest (red when the pair is in warning), thin and faint for the others; around a segment or
/// patch, circles as wide as it is. Namespaces `<pair>/points`, `<pair>/line`, `<pair>/extent`; the marker id
/// is the niche's (its low 31 bits). For a pair whose niches are not known its closest points are
/// drawn under id 0. The line of the nearest is dashed when the distance is not certain (its proof ended at
/// the budget, the memory limit or a tolerance) or the pair's transforms are stale; then it is grey.
/// @param style with scale > 0 and far > near
std::vector<visualization_msgs::Marker> nicheMarkers(const DrawnPair& drawn, const MarkerStyle& style);

/// The label with the bodies' names and their distance: namespace `<pair>/text`, id 0. Where the distance is
/// not certain it adds the proven bound, where the transforms are stale it says so. Its place is the middle
/// of the nearest line.
/// @param pair with hasMarkers()
Label nicheLabel(const PairNiches& pair, const MarkerStyle& style);

/// Namespaces and ids that rviz shows at present.
using ShownMarkers = std::set<std::pair<std::string, std::int32_t>>;

/// Completes a message to be sent: a DELETE for all that was shown and is neither in `markers` nor in `kept`
/// any more. `shown` becomes what the message leaves on the screen.
visualization_msgs::MarkerArray withDeletions(std::vector<visualization_msgs::Marker> markers,
                                              const std_msgs::Header& header, ShownMarkers& shown,
                                              ShownMarkers kept = {});

}  // namespace concave_distance

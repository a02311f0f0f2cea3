#pragma once

#include <concave_distance/PairNiches.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "marker_selection.h"
#include "marker_style.h"

namespace concave_distance {

/// Colour of a niche by its distance: orange at `near`, over yellow to green at `far`; opaque.
/// @param style with far > near
std_msgs::ColorRGBA distanceColor(double distance, const MarkerStyle& style);
/// Red; colours of distances are never red.
std_msgs::ColorRGBA warningColor();

/// The markers for one pair: for each niche its witness points and the line between them, opaque for the
/// nearest (red when the pair is in warning), faint for the others, thick for the nearest of all pairs;
/// around a segment or patch, circles as wide as it is. Namespaces `<pair>/points`, `<pair>/line`,
/// `<pair>/extent`; the marker id is the niche's (its low 31 bits). For a pair whose niches are not known its
/// closest points are drawn under id 0. The line of the nearest is dashed when the distance is not certain
/// (its proof ended at the budget, the memory limit or a tolerance) or the pair's transforms are stale; then
/// it is grey.
/// @param style with scale > 0 and far > near
std::vector<visualization_msgs::Marker> nicheMarkers(const DrawnPair& drawn, const MarkerStyle& style);

/// The label with the bodies' names and their distance at the middle of the nearest line: namespace
/// `<pair>/text`, id 0. Where the distance is not certain it adds the proven bound, where the transforms are
/// stale it says so. @param pair with hasMarkers()
visualization_msgs::Marker nicheLabel(const PairNiches& pair, const MarkerStyle& style);

/// Namespaces and ids that rviz shows at present.
using ShownMarkers = std::set<std::pair<std::string, std::int32_t>>;

/// Completes a message to be sent: a DELETE for all that was shown and is neither in `markers` nor in `kept`
/// any more. `shown` becomes what the message leaves on the screen.
visualization_msgs::MarkerArray withDeletions(std::vector<visualization_msgs::Marker> markers,
                                              const std_msgs::Header& header, ShownMarkers& shown,
                                              ShownMarkers kept = {});

}  // namespace concave_distance

#pragma once

#include <concave_distance/PairContactState.h>
#include <visualization_msgs/Marker.h>

#include <cstddef>
#include <vector>

#include "marker_parts.h"
#include "marker_style.h"

namespace concave_distance {

std_msgs::ColorRGBA normalForceColor();
std_msgs::ColorRGBA frictionColor();
std_msgs::ColorRGBA contactTextColor();

/// A marker of the pair's contact `index`, without a type: namespace `<pair>/<kind>`; its id is the contact's
/// (its low 31 bits), that of a contact without one -1 minus its place.
visualization_msgs::Marker emptyContactMarker(const PairContactState& pair, const char* kind,
                                              std::size_t index);

/// The markers for the contacts of one pair. Namespaces `<pair>/contact_area`: a translucent disc of the
/// contact's area at its centroid, across the normal; `<pair>/contact_depth`: the line along which the depth
/// is attained; `<pair>/normal_force` and `<pair>/friction`: arrows of the forces on B, style.force_scale
/// newtons a metre.
/// @param without_disc by contact: those whose pressure is drawn
/// @param style with a resolved scale (> 0)
std::vector<visualization_msgs::Marker> contactMarkers(const PairContactState& pair,
                                                       const std::vector<bool>& without_disc,
                                                       const MarkerStyle& style);

/// Names the bodies, the depth, the force and the largest pressure of each contact: namespace
/// `<pair>/contact_text`. The place of each is its centroid.
std::vector<Label> contactLabels(const PairContactState& pair);

}  // namespace concave_distance

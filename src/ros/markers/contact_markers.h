#pragma once

#include <concave_distance/PairContactState.h>
#include <visualization_msgs/Marker.h>

#include <cstddef>
#include <vector>

#include "marker_style.h"

namespace concave_distance {

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

/// Names the bodies, the depth, the force and the largest pressure of the deepest contacts of all pairs, at
/// the centroid of each: namespace `<pair>/contact_text`. @param most labels; 0: all
std::vector<visualization_msgs::Marker> contactLabels(const std::vector<PairContactState>& pairs,
                                                      std::size_t most, double scale);

}  // namespace concave_distance

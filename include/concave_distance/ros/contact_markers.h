#pragma once

#include <concave_distance/PairContactState.h>
#include <visualization_msgs/Marker.h>

#include <vector>

#include "concave_distance/ros/marker_style.h"

namespace concave_distance {

std_msgs::ColorRGBA normalForceColor();
std_msgs::ColorRGBA frictionColor();
std_msgs::ColorRGBA contactTextColor();

/// The markers for the contacts of one pair. Namespaces `<pair>/contact_area`: a translucent disc of the
/// contact's area at its centroid, across the normal; `<pair>/contact_depth`: the line along which the depth
/// is attained; `<pair>/normal_force` and `<pair>/friction`: arrows of the forces on B, style.force_scale
/// newtons a metre; `<pair>/contact_text`: depth and force, at the centroid until LabelPlacer moves it. The
/// marker id is the contact's (its low 31 bits); contacts without one have -1, -2 and so on.
/// @param style with a resolved scale (> 0)
/// @param lifetime seconds after which rviz drops a marker that is not renewed
std::vector<visualization_msgs::Marker> contactMarkers(const PairContactState& pair, const MarkerStyle& style,
                                                       double lifetime);

}  // namespace concave_distance

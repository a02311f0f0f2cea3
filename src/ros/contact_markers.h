#pragma once

#include <concave_distance/PairContactState.h>
#include <visualization_msgs/Marker.h>

#include <vector>

#include "marker_labels.h"
#include "marker_style.h"

namespace concave_distance {

std_msgs::ColorRGBA normalForceColor();
std_msgs::ColorRGBA frictionColor();
std_msgs::ColorRGBA contactTextColor();

/// The markers for the contacts of one pair. Namespaces `<pair>/contact_area`: a translucent disc of the
/// contact's area at its centroid, across the normal; `<pair>/contact_depth`: the line along which the depth
/// is attained; `<pair>/normal_force` and `<pair>/friction`: arrows of the forces on B, style.force_scale
/// newtons a metre. The marker id is the contact's (its low 31 bits); one without has -1 minus its place.
/// @param style with a resolved scale (> 0)
/// @param lifetime seconds after which rviz drops a marker that is not renewed
std::vector<visualization_msgs::Marker> contactMarkers(const PairContactState& pair, const MarkerStyle& style,
                                                       double lifetime);

struct ContactLabel {
  double depth = 0.0;  ///< m; 0 where it is not known
  Label label;
};

/// Depth and force of each contact, at its centroid: namespace `<pair>/contact_text`, ids as above.
std::vector<ContactLabel> contactLabels(const PairContactState& pair, double lifetime);

}  // namespace concave_distance

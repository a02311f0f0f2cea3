#pragma once

#include <visualization_msgs/Marker.h>

#include <vector>

#include "marker_layout.h"

namespace concave_distance {

/// Texts that stand beside each other; spaces keep them apart.
using TextRow = std::vector<visualization_msgs::Marker>;

/// Places the rows above the scene, the first one at the top. No camera sees a row cover another or a body
/// in front of them, unless it stands above the list or, in scenes of less than about half a metre, looks
/// down steeply.
std::vector<visualization_msgs::Marker> placeRows(const std::vector<TextRow>& rows,
                                                  const MarkerLayout& layout);

}  // namespace concave_distance

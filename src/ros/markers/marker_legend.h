#pragma once

#include "concave_distance/scene/scene.h"
#include "marker_selection.h"
#include "text_list.h"

namespace concave_distance {

/// The rows that explain what is drawn, each text in the colour that it explains: namespace `legend`.
/// @param style with a resolved scale
/// @param pressure_end Pa, in the last colour; 0: no pressure was drawn
std::vector<TextRow> legendRows(const Scene& scene, const MarkerSelection& selection,
                                const MarkerStyle& style, double pressure_end, const std_msgs::Header& header,
                                double lifetime);

}  // namespace concave_distance

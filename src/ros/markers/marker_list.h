#pragma once

#include "concave_distance/scene/scene.h"
#include "marker_layout.h"
#include "marker_parts.h"
#include "marker_selection.h"

namespace concave_distance {

/// A row of the list above the scene: texts beside each other, which spaces keep apart.
using TextRow = std::vector<visualization_msgs::Marker>;

/// The rows that explain what is drawn, each text in the colour that it explains: namespace `legend`.
/// @param style with a resolved scale
/// @param pressure_end Pa, in the last colour; 0: no pressure was drawn
std::vector<TextRow> legendRows(const Scene& scene, const MarkerSelection& selection,
                                const MarkerStyle& style, double pressure_end,
                                const std_msgs::Header& header);

/// Places the rows above the scene, the first one at the top. No camera sees a row cover another or a body
/// in front of them, unless it stands above the list or, in scenes of less than about half a metre, looks
/// down steeply.
std::vector<visualization_msgs::Marker> placeRows(const std::vector<TextRow>& rows,
                                                  const MarkerLayout& layout);

}  // namespace concave_distance

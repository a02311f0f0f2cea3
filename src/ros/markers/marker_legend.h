#pragma once

#include <visualization_msgs/Marker.h>

#include <cstddef>
#include <string>
#include <vector>

#include "marker_labels.h"
#include "marker_layout.h"

namespace concave_distance {

/// What the legend explains.
struct LegendContents {
  std::size_t drawn_pairs = 0;
  std::size_t pairs = 0;      ///< with a distance
  bool others = false;        ///< thin lines are drawn
  bool dashes = false;        ///< some line is dashed
  bool warnings = false;      ///< some pair has a warning distance
  bool extents = false;       ///< circles are drawn
  bool contacts = false;      ///< some pair has effects
  double pressure_end = 0.0;  ///< Pa, in the last colour; 0: no pressure is drawn
};

/// The legend above the scene: namespace `legend`, one text per row, in the colour that it explains.
/// @param header in the reference frame
std::vector<visualization_msgs::Marker> legendMarkers(const LegendContents& contents,
                                                      const MarkerLayout& layout,
                                                      const std_msgs::Header& header, double lifetime);

/// The space that the legend covers.
LabelSpace spaceOfLegend(const std::vector<visualization_msgs::Marker>& legend);

}  // namespace concave_distance

#pragma once

#include <visualization_msgs/Marker.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "marker_labels.h"
#include "marker_layout.h"

namespace concave_distance {

/// What can hide a label.
struct LabelSurroundings {
  const Scene& scene;
  const std::vector<LocatedBody>& bodies;
};

/// Places each label above its line, as low as none of usualViews() shows it on another label and half of
/// them show it in front of all bodies. A thin line joins a label that stands high to its line. A label keeps
/// its height while that is free, and a lower one is looked for once a second.
class LabelPlacer {
 public:
  /// @param labels the most important first; those beyond the first 50 are left out
  /// @param taken spaces that no label may cover
  /// @param now s
  std::vector<visualization_msgs::Marker> place(std::vector<Label> labels,
                                                const LabelSurroundings& surroundings, double letter_height,
                                                std::vector<LabelSpace> taken, double now);

 private:
  struct Choice {
    int step = 0;       ///< the height, in steps above the line
    double time = 0.0;  ///< s, when it was chosen
  };
  std::map<std::pair<std::string, std::int32_t>, Choice> choices_;  ///< by namespace and id
};

}  // namespace concave_distance

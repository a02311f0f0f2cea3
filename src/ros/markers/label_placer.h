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

/// Places each label beside its line where most of usualViews() see it: not behind a body, a line or another
/// label. A label keeps its place for a while; a better one is looked for once a second.
class LabelPlacer {
 public:
  /// @param labels the most important first: a later one that would cover an earlier one is left out, and so
  ///        are those beyond the first 50
  /// @param taken spaces that no label may cover
  /// @param now s
  std::vector<visualization_msgs::Marker> place(std::vector<Label> labels,
                                                const LabelSurroundings& surroundings, double letter_height,
                                                std::vector<LabelSpace> taken, double now);

 private:
  struct Choice {
    std::size_t place = 0;  ///< see places() in the source
    double time = 0.0;      ///< s, when it was chosen
  };
  std::map<std::pair<std::string, std::int32_t>, Choice> choices_;
};

}  // namespace concave_distance

#pragma once

#include <visualization_msgs/Marker.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "marker_layout.h"
#include "marker_parts.h"

namespace concave_distance {

/// Numbers the labels where there are several: a small number in the scene beside each place, the same before
/// its row of the list. A number stays with its label as long as that is drawn.
class LabelNumbers {
 public:
  /// Adds the numbers to the texts and sorts the labels by them.
  /// @return the numbers in the scene, each straight or aslant above its place and as near to it as no body
  ///         and no other number is in its way; a thin line joins one that stands apart to its place
  std::vector<visualization_msgs::Marker> number(std::vector<Label>& labels, const Scene& scene,
                                                 const std::vector<LocatedBody>& bodies,
                                                 double letter_height);

 private:
  struct Choice {
    int number = 0;
    int place = 0;  ///< of the places tried, the nearest first
  };
  void assign(std::vector<Label>& labels);

  std::map<std::pair<std::string, std::int32_t>, Choice> choices_;  ///< by namespace and id of the text
};

}  // namespace concave_distance

#pragma once

#include <concave_distance/PairContactState.h>
#include <concave_distance/PairNiches.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "label_numbers.h"
#include "marker_demand.h"
#include "marker_layout.h"
#include "niche_markers.h"
#include "pressure_markers.h"
#include "ros/messages/published_pair.h"

namespace concave_distance {

/// Draws a scene: nearest pairs, contacts, their numbers, above the scene the legend and a row for each of
/// them, red bodies, and deletions of earlier markers. One object per topic.
class SceneMarkers {
 public:
  /// @param style as configured; 0 means automatic
  /// @param pairs of this scene
  /// @param niches of the pairs that are due; none: everything is deleted
  /// @param header in the reference frame, stamped now
  /// @param lifetime seconds after which rviz drops a marker that is not renewed
  visualization_msgs::MarkerArray draw(const Scene& scene, const MarkerStyle& style,
                                       const PublishedPairs& pairs, const std::vector<PairNiches>& niches,
                                       const std::vector<PairContactState>& contacts,
                                       const std_msgs::Header& header, double lifetime);
  /// Which niches are needed for it, in which cycle.
  MarkerDemand& demand() { return demand_; }
  /// For when there is no subscriber any more: nothing has to be deleted.
  void forget();
  bool empty() const { return shown_.empty(); }

 private:
  using Markers = std::vector<visualization_msgs::Marker>;
  void drawContacts(const Scene& scene, const PublishedPairs& pairs,
                    const std::vector<PairContactState>& contacts, Markers& markers);
  /// Adds red copies that appear or are due for renewal: they are large. Returns those that stay.
  ShownMarkers drawWarnings(const Scene& scene, const std::vector<DrawnPair>& drawn, ros::Time now,
                            double lifetime, Markers& markers);

  MarkerDemand demand_;
  MarkerLayout layout_;
  LabelNumbers numbers_;
  PressureScale pressures_;
  ShownMarkers shown_;
  /// The red bodies by marker id, as they were drawn: an edit may have moved one.
  std::map<std::int32_t, std::shared_ptr<const SceneBody>> tinted_;
  ros::Time tints_sent_;
};

}  // namespace concave_distance

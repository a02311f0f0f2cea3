#pragma once

#include <concave_distance/PairContactState.h>
#include <concave_distance/PairNiches.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "niche_markers.h"
#include "pressure_markers.h"
#include "ros/messages/published_pair.h"

namespace concave_distance {

/// Draws a scene: nearest pairs, contacts, a label at each of them, red bodies, and deletions of earlier
/// markers. One object per topic.
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
  /// Returns whether the pair was in the last picture: the next one needs its niches.
  bool draws(const std::string& pair) const { return drawn_.count(pair) != 0; }
  /// For when there is no subscriber any more: nothing has to be deleted.
  void forget();
  bool empty() const { return shown_.empty(); }

 private:
  using Markers = std::vector<visualization_msgs::Marker>;
  std::vector<const PairNiches*> withStalePairs(const std::vector<PairNiches>& messages);
  void drawContacts(const Scene& scene, const PublishedPairs& pairs,
                    const std::vector<PairContactState>& contacts, const MarkerStyle& style,
                    Markers& markers);
  /// Adds red copies that appear or are due for renewal: they are large. Returns those that stay.
  ShownMarkers drawWarnings(const Scene& scene, const std::vector<DrawnPair>& drawn, double scale,
                            ros::Time now, double lifetime, Markers& markers);

  double size_ = 0.0;  ///< of the scene in the last picture, m; 0: no body has been located
  std::unordered_map<std::string, PairNiches> drawn_;  ///< by pair, in the last picture
  PressureScale pressures_;
  ShownMarkers shown_;
  /// The red bodies by marker id, as they were drawn: an edit may have moved one.
  std::map<std::int32_t, std::shared_ptr<const SceneBody>> tinted_;
  ros::Time tints_sent_;
};

}  // namespace concave_distance

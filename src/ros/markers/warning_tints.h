#pragma once

#include <visualization_msgs/Marker.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "marker_selection.h"

namespace concave_distance {

/// The bodies to tint, as indices into scene.bodies: of a warning, what is warned of and the nearest link of
/// the robot; of two links or two obstacles, both.
/// @param drawn ascending by distance
/// @param largest diameter of a body (m): a red floor would hide the rest
std::set<std::size_t> warnedBodies(const Scene& scene, const std::vector<DrawnPair>& drawn, double largest);

/// Draws a translucent red copy over each body that is too close: namespace `warning`, the body's number as
/// marker id, fixed to its tf frame. A copy is sent when it appears and then renewed now and then, because
/// meshes are large.
class WarningTints {
 public:
  /// Returns the markers to send: copies that appear or are due for renewal, and deletions.
  /// @param warned indices into scene.bodies
  /// @param offset m, of the copy in front of the body's surface
  /// @param renewal s between two copies of the same body; rviz drops a copy after three times as long
  /// @param header in the reference frame, stamped now
  std::vector<visualization_msgs::Marker> update(const Scene& scene, const std::set<std::size_t>& warned,
                                                 double offset, double renewal,
                                                 const std_msgs::Header& header);
  /// For when there is no subscriber any more: all copies are sent again later.
  void forget() { shown_.clear(); }
  bool empty() const { return shown_.empty(); }

 private:
  std::map<std::int32_t, std::string> shown_;  ///< names of the bodies by marker id
  ros::Time renewed_;
};

}  // namespace concave_distance

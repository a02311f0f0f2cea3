#pragma once

#include <visualization_msgs/Marker.h>

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// A translucent red copy over each body that is too close: namespace `warning`, the marker id is the body's
/// number, fixed to its tf frame. Meshes are large: a copy is sent when it appears and renewed now and then,
/// not in every message.
class WarningTints {
 public:
  /// What has to be sent: copies that appear or are due for renewal, and deletions of the others.
  /// @param warned indices into scene.bodies
  /// @param offset m, of the copy in front of the body's surface
  /// @param renewal s, between two copies of the same body; rviz drops one after three times as long
  std::vector<visualization_msgs::Marker> update(const Scene& scene, const std::set<std::size_t>& warned,
                                                 double offset, double renewal, ros::Time now);
  /// Nobody sees the markers any more: all are sent again.
  void forget() { shown_.clear(); }
  bool empty() const { return shown_.empty(); }

 private:
  struct Tint {
    std::string body;
    std::string frame;
    ros::Time sent;
  };
  std::map<std::int32_t, Tint> shown_;
};

}  // namespace concave_distance

#pragma once

#include <visualization_msgs/Marker.h>

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// A translucent red copy over each body that is too close: namespace `warning`, the body's number as marker
/// id, fixed to its tf frame. A copy is sent when it appears and then renewed now and then, because meshes
/// are large.
class WarningTints {
 public:
  /// The markers to send: copies that appear or are due for renewal, and deletions.
  /// @param warned indices into scene.bodies
  /// @param offset m, of the copy in front of the body's surface
  /// @param renewal s between two copies of the same body; rviz drops a copy after three times as long
  std::vector<visualization_msgs::Marker> update(const Scene& scene, const std::set<std::size_t>& warned,
                                                 double offset, double renewal, ros::Time now);
  /// For when there is no subscriber any more: all copies are sent again later.
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

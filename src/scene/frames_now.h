#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>

namespace concave_distance::detail {

/// One tf frame seen from another at this moment.
struct FrameRelation {
  Eigen::Isometry3d target_from_source = Eigen::Isometry3d::Identity();
  bool is_fixed = false;  ///< only static transforms connect the two
};

/// Tells edits of a scene what tf knows.
struct FramesNow {
  /// Returns nothing when the two frames are not connected.
  using Relation =
      std::function<std::optional<FrameRelation>(const std::string& target, const std::string& source)>;

  std::string reference;  ///< frame in which a body stays that is detached
  Relation relation;      ///< of two different frames
};

}  // namespace concave_distance::detail

#pragma once

#include <ros/time.h>
#include <topic_tools/shape_shifter.h>

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/scene/cloud.h"

namespace concave_distance {

/// Holds what a message says: points of a sensor, or the occupied cells of a map.
struct CloudReading {
  std::string frame;
  ros::Time stamp;                      ///< zero: the message has none
  std::vector<Eigen::Vector3d> points;  ///< finite and within the range, metres, in `frame`
  std::size_t points_in = 0;            ///< of the message
  std::optional<VoxelGrid> map;         ///< instead of points, in `frame`
};

/// A message has a type or a definition that is not known.
class OtherType : public Error {
 public:
  using Error::Error;
};

/// Reads a message of either type. @throws OtherType, or Error naming field or size that is wrong and what is
/// expected
CloudReading readCloud(const topic_tools::ShapeShifter& message, const CloudSettings& settings);

}  // namespace concave_distance

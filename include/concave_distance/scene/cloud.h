#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "concave_distance/mesh/surface/voxels.h"

namespace concave_distance {

/// Says how points that a sensor sees become a body: the voxels that they occupy.
struct CloudSettings {
  std::string topic;        ///< of sensor_msgs/PointCloud2 or octomap_msgs/Octomap; as the node resolves it
  double voxel_size = 0.0;  ///< metres; of a map its own
  double range =
      std::numeric_limits<double>::infinity();  ///< metres from the sensor; farther points are left out
  double rate = 5.0;                            ///< Hz, of rebuilding at most
  double stale_after = 1.0;                     ///< s; an older cloud's pairs have no distance
  /// Metres; points inside or this near to a body that is left out do not count.
  double padding = 0.02;
  /// Bodies, groups and patterns that are left out, besides robots' links and what is attached to them.
  std::vector<std::string> leave_out;
  bool niches = false;  ///< its pairs have niches when these are asked for, else their distance alone
  std::size_t largest_voxel_count = 200'000;  ///< a cloud with more is refused

  bool operator==(const CloudSettings& other) const {
    const auto values = [](const CloudSettings& s) {
      return std::tie(s.topic, s.voxel_size, s.range, s.rate, s.stale_after, s.padding, s.leave_out, s.niches,
                      s.largest_voxel_count);
    };
    return values(*this) == values(other);
  }
};

/// Holds what a body knows of the last cloud.
struct CloudState {
  std::shared_ptr<const CloudSettings> settings;
  std::optional<std::int64_t> stamp;  ///< ns of ROS time; empty: none has come yet
  double voxel_size = 0.0;            ///< metres
  /// Empty although one has come: nothing is there. The body's mesh then means nothing.
  std::shared_ptr<const std::vector<VoxelCell>> cells;

  bool hasVoxels() const { return cells && !cells->empty(); }
};

}  // namespace concave_distance

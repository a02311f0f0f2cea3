#pragma once

#include "cloud_message.h"

namespace concave_distance {

inline constexpr const char* kOctomapType = "octomap_msgs/Octomap";

/// Reads a map, binary or full, whose message need not be known when this package is built: its fields are
/// checked against the definition that the publisher sends. Its bytes are checked before liboctomap gets
/// them. A large leaf becomes as many cells as it covers.
/// @throws Error naming what is wrong: a field of the definition, the tree's type, resolution or bytes, or
///         more cells than settings.largest_voxel_count
CloudReading readOctomap(const topic_tools::ShapeShifter& message, const CloudSettings& settings);

}  // namespace concave_distance

#pragma once

#include <ros/time.h>

#include <optional>

#include "concave_distance/scene/cloud.h"
#include "tf_poses.h"

namespace concave_distance {

/// Says why a cloud cannot be used at a time: none has come, the last is too old, or it is ahead of the clock
/// by more than it may be old (a clock that has jumped back); nothing: it can.
std::optional<FrameTransform> whyUnusable(const std::string& name, const CloudState& cloud, ros::Time now);

}  // namespace concave_distance

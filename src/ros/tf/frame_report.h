#pragma once

#include <tf2/buffer_core.h>

#include <string>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// The frames of bodies that tf does not connect with the reference frame, with a remedy; empty: none.
std::string describeMissingFrames(const tf2::BufferCore& buffer, const Scene& scene,
                                  const std::string& reference_frame);

/// Returns why ROS time is zero, with the remedy; empty when it is not.
std::string missingClock();

}  // namespace concave_distance

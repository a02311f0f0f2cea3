#pragma once

#include <tf2/buffer_core.h>

#include <string>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Says what helps against missing frames, in a running system or where a recording is answered.
struct FrameRemedies {
  const char* unknown = "check that robot_state_publisher runs and that the joint states name every joint";
  const char* apart = "publish the transform between the two";
};

/// The frames of bodies that tf does not connect with the reference frame, with a remedy; empty: none.
std::string describeMissingFrames(const tf2::BufferCore& buffer, const Scene& scene,
                                  const std::string& reference_frame, const FrameRemedies& remedies = {});

/// Returns why ROS time is zero, with the remedy; empty when it is not.
std::string missingClock();

}  // namespace concave_distance

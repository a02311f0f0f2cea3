#pragma once

#include <ros/ros.h>

#include "concave_distance/base/error.h"

namespace concave_distance::demo {

/// Runs `main` of a demo node: an Error ends it with a message.
inline int runNode(int argc, char** argv, const char* name, void (*run)()) {
  ros::init(argc, argv, name);
  try {
    run();
  } catch (const Error& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  return 0;
}

}  // namespace concave_distance::demo

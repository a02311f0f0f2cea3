#pragma once

#include <ros/time.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace concave_distance {

/// Says what became of a cloud's messages.
struct CloudReport {
  std::string name;
  std::string topic;  ///< resolved
  std::uint64_t taken = 0;
  std::uint64_t passed_over = 0;  ///< a newer one came while the one before was made into a body
  std::uint64_t refused = 0;
  std::uint64_t refused_lately = 0;  ///< since the last report
  std::string last_refusal;          ///< reason and remedy; empty when there was none
  std::string remark;                ///< on the last one that was taken: what could not be left out of it
  ros::Time stamp;                   ///< of the last one that was taken: the cloud that is served
  std::size_t points = 0;            ///< of the last one
  std::size_t left_out = 0;          ///< ... on the robot; those in occupied voxels are not looked at
  std::size_t voxels = 0;            ///< ... occupied
  double seconds = 0.0;              ///< ... from its arrival until it was served
};

}  // namespace concave_distance

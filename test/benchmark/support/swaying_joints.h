#pragma once

#include <urdf_model/model.h>

#include <string>
#include <vector>

namespace concave_distance::benchmark {

/// A joint that moves to and fro around a position in its range.
struct SwayingJoint {
  std::string name;
  double centre;     ///< rad or m
  double amplitude;  ///< rad or m; 0: it stands
  double frequency;  ///< Hz

  double at(double time) const;
};

/// The joints of a robot that have one axis and mimic no other, around zero, or the middle of their range
/// where zero is outside.
std::vector<SwayingJoint> swayingJoints(const urdf::ModelInterface& model);

}  // namespace concave_distance::benchmark

#pragma once

#include <map>
#include <string>

namespace concave_distance {

/// Sets of frames that no joint moves relative to each other. A frame that was never joined is alone.
class RigidFrames {
 public:
  void join(const std::string& a, const std::string& b);
  bool areJoined(const std::string& a, const std::string& b) const;
  /// Returns the frame that stands for all that are joined with this one.
  std::string rootOf(std::string frame) const;

 private:
  std::map<std::string, std::string> parent_;
};

}  // namespace concave_distance
